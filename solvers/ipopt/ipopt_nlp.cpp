#include "solvers/ipopt/ipopt_nlp.h"

#include <algorithm>
#include <stdexcept>

#include "solvers/ipopt/ipopt_lock.h"

namespace maxwrench {
namespace {

/// Beyond this an Ipopt bound is infinite (its default nlp_*_bound_inf).
constexpr double kIpoptInfinity = 1e19;

void write(const Eigen::VectorXd& from, double* to) { std::copy_n(from.data(), from.size(), to); }

void write_bounds(const Eigen::VectorXd& low, const Eigen::VectorXd& high, double* l, double* u) {
  write(low.cwiseMax(-kIpoptInfinity), l);
  write(high.cwiseMin(kIpoptInfinity), u);
}

}  // namespace

std::vector<std::pair<Ipopt::Index, Ipopt::Index>> entries_of(
    const Eigen::SparseMatrix<double>& matrix) {
  std::vector<std::pair<Ipopt::Index, Ipopt::Index>> entries;
  for (int column = 0; column < matrix.outerSize(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(matrix, column); it; ++it) {
      entries.emplace_back(it.row(), it.col());
    }
  }
  return entries;
}

bool IpoptNlp::get_nlp_info(Index& n, Index& m, Index& nnz_jac, Index& nnz_hessian,
                            IndexStyleEnum& style) {
  n = static_cast<Index>(shape_.start.size());
  m = static_cast<Index>(shape_.row_min.size());
  nnz_jac = static_cast<Index>(shape_.entries.size());
  nnz_hessian = 0;
  style = TNLP::C_STYLE;
  return true;
}

bool IpoptNlp::get_bounds_info(Index, Number* l, Number* u, Index, Number* g_l, Number* g_u) {
  write_bounds(shape_.lower, shape_.upper, l, u);
  write_bounds(shape_.row_min, shape_.row_max, g_l, g_u);
  return true;
}

bool IpoptNlp::get_starting_point(Index, bool, Number* x, bool, Number*, Number*, Index, bool,
                                  Number*) {
  write(shape_.start, x);
  return true;
}

IpoptNlp::Index IpoptNlp::get_number_of_nonlinear_variables() {
  return shape_.nonlinear.empty() ? -1 : static_cast<Index>(shape_.nonlinear.size());
}

bool IpoptNlp::get_list_of_nonlinear_variables(Index, Index* variables) {
  std::copy(shape_.nonlinear.begin(), shape_.nonlinear.end(), variables);
  return true;
}

bool IpoptNlp::eval_f(Index n, const Number* x, bool, Number& f) {
  return caught_.run(false, [&] { return value(Point(x, n), f); });
}

bool IpoptNlp::eval_grad_f(Index n, const Number* x, bool, Number* slopes) {
  return caught_.run(false, [&] { return gradient(Point(x, n), Result(slopes, n)); });
}

bool IpoptNlp::eval_g(Index n, const Number* x, bool, Index m, Number* g) {
  return caught_.run(false, [&] { return rows(Point(x, n), Result(g, m)); });
}

bool IpoptNlp::eval_jac_g(Index n, const Number* x, bool, Index, Index count, Index* rows,
                          Index* cols, Number* values) {
  if (values != nullptr) {
    return caught_.run(false, [&] { return jacobian(Point(x, n), Result(values, count)); });
  }
  for (const auto& [row, column] : shape_.entries) {
    *rows++ = row;
    *cols++ = column;
  }
  return true;
}

bool IpoptNlp::eval_h(Index, const Number*, bool, Number, Index, const Number*, bool, Index, Index*,
                      Index*, Number*) {
  return true;  // of a linear program: it has no curvature
}

bool IpoptNlp::intermediate_callback(Ipopt::AlgorithmMode, Index, Number, Number, Number, Number,
                                     Number, Number, Number, Number, Index, const Ipopt::IpoptData*,
                                     Ipopt::IpoptCalculatedQuantities*) {
  return !caught_.any() && !ended();
}

void IpoptNlp::finalize_solution(Ipopt::SolverReturn, Index n, const Number* x, const Number*,
                                 const Number*, Index m, const Number*, const Number* lambda,
                                 Number, const Ipopt::IpoptData*,
                                 Ipopt::IpoptCalculatedQuantities*) {
  if (Point(x, n).allFinite()) x_ = Point(x, n);
  lambda_ = Point(lambda, m);
}

Ipopt::SmartPtr<Ipopt::IpoptApplication> make_ipopt_application(
    const char* method, int iterations,
    const std::function<void(Ipopt::OptionsList& options)>& more) {
  Ipopt::SmartPtr<Ipopt::IpoptApplication> application = new Ipopt::IpoptApplication(false);
  const auto options = application->Options();
  options->SetIntegerValue("print_level", 0);
  options->SetStringValue("sb", "yes");
  options->SetStringValue("hessian_approximation", "limited-memory");
  options->SetNumericValue("bound_relax_factor", 0);
  options->SetIntegerValue("max_iter", iterations);
  options->SetIntegerValue("mumps_pivot_order", kMumpsOrdering);
  if (more) more(*options);
  if (application->Initialize("") != Ipopt::Solve_Succeeded) {
    throw std::runtime_error(std::string(method) + ": Ipopt rejects its options");
  }
  return application;
}

Ipopt::ApplicationReturnStatus minimize(Ipopt::IpoptApplication& application, IpoptNlp& nlp) {
  const auto status = application.OptimizeTNLP(Ipopt::SmartPtr<Ipopt::TNLP>(&nlp));
  nlp.caught_.rethrow();
  return status;
}

std::string word_of(Ipopt::ApplicationReturnStatus status) {
  switch (status) {
    case Ipopt::Solve_Succeeded:
      return "solved";
    case Ipopt::Solved_To_Acceptable_Level:
      return "acceptable";
    case Ipopt::Search_Direction_Becomes_Too_Small:
      return "small_direction";
    case Ipopt::Maximum_Iterations_Exceeded:
      return "iterations";
    case Ipopt::Restoration_Failed:
      return "restoration_failed";
    case Ipopt::Error_In_Step_Computation:
      return "step_failed";
    case Ipopt::Infeasible_Problem_Detected:
      return "infeasible";
    case Ipopt::User_Requested_Stop:
      return "budget";
    default:
      return "error_" + std::to_string(static_cast<int>(status));
  }
}

}  // namespace maxwrench
