#pragma once

#include <Eigen/Core>

namespace maxwrench {

struct Forms;
struct PlanProgram;
struct PlanSolution;

/// Reads the answer of a plan program from a point of its forms.
class FormsReader {
 public:
  /// u, w, s, y, value and price at X / tau.
  static void read_primal(const PlanProgram& program, const Forms& forms, const Eigen::VectorXd& X,
                          double tau, PlanSolution& solution);
  /// lambda, mu, pi and nu from the forms' multipliers (positive at hi), divided by tau; with
  /// `proof` as in a proof of infeasibility. What rounding would leave on w, which may have no
  /// limits to pay for it, is taken from lambda.
  void read_dual(const PlanProgram& program, const Forms& forms, const Eigen::VectorXd& multipliers,
                 double tau, bool proof, PlanSolution& solution);

 private:
  static void read_rates(const PlanProgram& program, const Forms& forms,
                         const Eigen::VectorXd& multipliers, double tau, PlanSolution& solution);
  static void read_pi(const PlanProgram& program, const Forms& forms,
                      const Eigen::VectorXd& multipliers, PlanSolution& solution);
  void read_lambda(const PlanProgram& program, const Forms& forms,
                   const Eigen::VectorXd& multipliers, double tau, int i, PlanSolution& solution);
  static void turn_to_proof(Eigen::MatrixXd& all);
  void level(const PlanProgram& program, const Forms& forms, const Eigen::VectorXd& multipliers,
             double tau, int i, PlanSolution& solution);

  Eigen::MatrixXd gram_;
  Eigen::VectorXd slope_;
};

}  // namespace maxwrench
