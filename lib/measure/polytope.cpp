#include "lib/measure/closed_form.h"
#include "maxwrench/posture.h"
#include "maxwrench/wrench_program.h"
#include "maxwrench/wrench_solver.h"

namespace maxwrench {
namespace {

/// Rejects a verdict of infeasibility that the data do not confirm.
void confirm_infeasible(const WrenchProgram& program, const Eigen::VectorXd& y,
                        Capability& capability) {
  if (capability.status != Status::kInfeasible || proves_infeasible(program, y)) return;
  capability.status = Status::kNumericalError;
  capability.reason = "no proof that the program is infeasible holds";
}

class LinfPolytope : public Measure {
 public:
  explicit LinfPolytope(std::unique_ptr<WrenchSolver> solver) : solver_(std::move(solver)) {}

  void evaluate_well_formed(const Posture& posture, const WrenchProgram& program, bool efforts,
                            Capability& capability) override {
    solver_->solve_well_formed(program, efforts, capability);
    if (efforts) confirm_infeasible(program, capability.lambda, capability);
    if (capability.status != Status::kOptimal) return clear_value(capability);
    fill_wrenches(posture, program, capability);
    if (efforts) {
      capability.residual = recheck(program, capability.u, capability.w, capability.lambda);
    } else {
      capability.u.setZero();
      capability.residual = {};
    }
  }
  bool solves_program() const override { return true; }

 private:
  /// Clears the numbers of earlier results, except for a proof in lambda.
  void clear_value(Capability& capability) {
    const Verdict verdict = capability;
    const int iterations = capability.iterations;
    capability.lambda.swap(proof_);
    capability.clear();
    if (verdict.status == Status::kInfeasible) capability.lambda.swap(proof_);
    capability.conclude(verdict.status, verdict.reason.c_str());
    capability.iterations = iterations;
  }

  std::unique_ptr<WrenchSolver> solver_;
  Eigen::VectorXd proof_;
};

/// The same program with (B, J, tau_d) replaced by (I, J (B^+)', B^+ tau_d). lambda = (B^+)'
/// lambda_L2.
class L2Polytope : public Measure {
 public:
  L2Polytope(const Zonotope& actuation, std::unique_ptr<WrenchSolver> solver)
      : B_pinv_(actuation.B_pinv),
        box_(make_zonotope(Eigen::MatrixXd::Identity(actuation.actuators(), actuation.actuators()),
                           actuation.u_min, actuation.u_max)),
        solver_(std::move(solver)) {}

  void evaluate_well_formed(const Posture& posture, const WrenchProgram& program, bool efforts,
                            Capability& capability) override {
    program_.actuation = &box_;
    program_.W = program.W;
    program_.C_2 = program.C_2;
    program_.c_w = program.c_w;
    program_.w_min = program.w_min;
    program_.w_max = program.w_max;
    program_.JtW.noalias() = B_pinv_.lazyProduct(program.JtW);
    program_.tau_d.noalias() = B_pinv_.lazyProduct(program.tau_d);
    capability.lambda.swap(lambda_);  // m numbers there, n numbers here: both stay allocated
    solver_->solve(program_, efforts, capability);
    capability.lambda.swap(lambda_);
    if (efforts) confirm_infeasible(program_, lambda_, capability);
    if (capability.status != Status::kOptimal) return;
    capability.lambda.noalias() = B_pinv_.transpose().lazyProduct(lambda_);
    fill_wrenches(posture, program, capability);
    if (!efforts) return;
    // The balance in the robot's own rows; optimality in the rows of the program that was solved.
    capability.residual = recheck(program_, capability.u, capability.w, lambda_);
    capability.residual.balance =
        recheck(program, capability.u, capability.w, capability.lambda).balance;
  }

 private:
  Eigen::MatrixXd B_pinv_;
  Zonotope box_;
  std::unique_ptr<WrenchSolver> solver_;
  WrenchProgram program_;
  Eigen::VectorXd lambda_;
};

}  // namespace

std::unique_ptr<Measure> make_linf_polytope(const Robot& /*robot*/,
                                            std::unique_ptr<WrenchSolver> solver) {
  return std::make_unique<LinfPolytope>(std::move(solver));
}

std::unique_ptr<Measure> make_l2_polytope(const Robot& robot,
                                          std::unique_ptr<WrenchSolver> solver) {
  require_full_row_rank(robot, "l2_polytope");
  return std::make_unique<L2Polytope>(robot.actuation, std::move(solver));
}

}  // namespace maxwrench
