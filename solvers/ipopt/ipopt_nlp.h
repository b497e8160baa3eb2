#pragma once

#include <Eigen/Sparse>
#include <IpIpoptApplication.hpp>
#include <IpTNLP.hpp>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "solvers/caught.h"

namespace maxwrench {

/// What Ipopt has to know of a program before it evaluates anything.
struct NlpShape {
  Eigen::VectorXd start, lower, upper;  ///< n; bounds may be infinite
  Eigen::VectorXd row_min, row_max;     ///< m
  /// Row and column of each entry of the Jacobian that may differ from zero, in the order of
  /// `IpoptNlp::jacobian`.
  std::vector<std::pair<Ipopt::Index, Ipopt::Index>> entries;
  /// The variables in which f or g is not linear; empty: all of them. The limited-memory Hessian is
  /// of these alone.
  std::vector<Ipopt::Index> nonlinear = {};
};

/// The entries of a sparse matrix, in the order of its values.
std::vector<std::pair<Ipopt::Index, Ipopt::Index>> entries_of(
    const Eigen::SparseMatrix<double>& matrix);

/// min f(x) subject to row_min <= g(x) <= row_max, lower <= x <= upper, as Ipopt wants it. A
/// subclass evaluates f, g and their first derivatives; each function returns false where there is
/// no value, so that Ipopt shortens its step. What a subclass throws ends the solve (`minimize`).
class IpoptNlp : public Ipopt::TNLP {
 public:
  using Point = Eigen::Map<const Eigen::VectorXd>;
  using Result = Eigen::Map<Eigen::VectorXd>;

  explicit IpoptNlp(NlpShape shape) : shape_(std::move(shape)), x_(shape_.start) {}

  /// The point at which Ipopt ended; the start if that is not finite.
  const Eigen::VectorXd& x() const { return x_; }
  /// m, the multipliers of f + lambda'(g - limits) there.
  const Eigen::VectorXd& lambda() const { return lambda_; }

 protected:
  virtual bool value(const Point& x, double& f) = 0;
  virtual bool gradient(const Point& x, Result slopes) = 0;
  virtual bool rows(const Point& x, Result g) = 0;
  /// The values of the entries.
  virtual bool jacobian(const Point& x, Result values) = 0;
  /// Whether the solve has to end after this iteration.
  virtual bool ended() { return false; }

 private:
  friend Ipopt::ApplicationReturnStatus minimize(Ipopt::IpoptApplication& application,
                                                 IpoptNlp& nlp);
  using Index = Ipopt::Index;
  using Number = Ipopt::Number;

  bool get_nlp_info(Index& n, Index& m, Index& nnz_jac, Index& nnz_hessian,
                    IndexStyleEnum& style) final;
  bool get_bounds_info(Index n, Number* l, Number* u, Index m, Number* g_l, Number* g_u) final;
  bool get_starting_point(Index n, bool, Number* x, bool, Number*, Number*, Index, bool,
                          Number*) final;
  Index get_number_of_nonlinear_variables() final;
  bool get_list_of_nonlinear_variables(Index count, Index* variables) final;
  bool eval_f(Index n, const Number* x, bool, Number& f) final;
  bool eval_grad_f(Index n, const Number* x, bool, Number* slopes) final;
  bool eval_g(Index n, const Number* x, bool, Index m, Number* g) final;
  bool eval_jac_g(Index n, const Number* x, bool, Index m, Index count, Index* rows, Index* cols,
                  Number* values) final;
  bool eval_h(Index, const Number*, bool, Number, Index, const Number*, bool, Index, Index*, Index*,
              Number*) final;
  bool intermediate_callback(Ipopt::AlgorithmMode, Index, Number, Number, Number, Number, Number,
                             Number, Number, Number, Index, const Ipopt::IpoptData*,
                             Ipopt::IpoptCalculatedQuantities*) final;
  void finalize_solution(Ipopt::SolverReturn, Index n, const Number* x, const Number*,
                         const Number*, Index m, const Number*, const Number* lambda, Number,
                         const Ipopt::IpoptData*, Ipopt::IpoptCalculatedQuantities*) final;

  NlpShape shape_;
  Eigen::VectorXd x_, lambda_;
  Caught caught_;
};

/// A silent Ipopt with a limited-memory Hessian that keeps to its bounds; `more`, if given, sets
/// further options. Throws std::runtime_error, with the method's name, if Ipopt does not take them.
Ipopt::SmartPtr<Ipopt::IpoptApplication> make_ipopt_application(
    const char* method, int iterations,
    const std::function<void(Ipopt::OptionsList& options)>& more = {});

/// Solves the program, which a SmartPtr owns, and throws what its functions threw. The caller holds
/// `ipopt_lock`.
Ipopt::ApplicationReturnStatus minimize(Ipopt::IpoptApplication& application, IpoptNlp& nlp);

/// How Ipopt ended, in one word for a row; "budget" where `IpoptNlp::ended` stopped it.
std::string word_of(Ipopt::ApplicationReturnStatus status);

}  // namespace maxwrench
