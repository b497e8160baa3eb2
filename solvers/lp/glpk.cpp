#include "solvers/lp/glpk.h"

#include <glpk.h>

#include <csetjmp>

#include "solvers/lp/elastic.h"

namespace maxwrench {
namespace {

/// GLPK keeps an environment for each thread, which that thread must silence and free.
struct Environment {
  Environment() = default;
  ~Environment() { glp_free_env(); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;
};

/// Claims to have printed a message.
int swallow(void* /*info*/, const char* /*message*/) { return 1; }

void jump(void* back) { std::longjmp(*static_cast<std::jmp_buf*>(back), 1); }

/// Calls a function of GLPK, which answers some singular bases with a failed assertion and would
/// then end the process. False if it did; the environment and all that was in it are gone then.
/// The jump back crosses frames of C only.
bool guarded(int (*call)(glp_prob*, const glp_smcp*), glp_prob* problem, const glp_smcp* options,
             int& result) {
  std::jmp_buf back;
  if (setjmp(back) != 0) {
    glp_free_env();
    return false;
  }
  glp_error_hook(jump, &back);
  result = call(problem, options);
  glp_error_hook(nullptr, nullptr);
  return true;
}

/// With scaling GLPK refuses factors out of range, by a failed assertion too.
int prepare(glp_prob* problem, const glp_smcp* /*options*/) {
  glp_scale_prob(problem, GLP_SF_AUTO);
  glp_adv_basis(problem, 0);
  return 0;
}

int factorize(glp_prob* problem, const glp_smcp* /*options*/) { return glp_factorize(problem); }

struct Delete {
  void operator()(glp_prob* problem) const { glp_delete_prob(problem); }
};
using Problem = std::unique_ptr<glp_prob, Delete>;

int to_glpk(VariableState state) {
  switch (state) {
    case VariableState::kAtLower:
      return GLP_NL;
    case VariableState::kAtUpper:
      return GLP_NU;
    case VariableState::kFree:
      return GLP_NF;
    case VariableState::kBasic:
      break;
  }
  return GLP_BS;
}

VariableState from_glpk(int status) {
  if (status == GLP_BS) return VariableState::kBasic;
  if (status == GLP_NU) return VariableState::kAtUpper;
  return status == GLP_NF ? VariableState::kFree : VariableState::kAtLower;
}

int bound_type(double l, double u) {
  if (l == u) return GLP_FX;
  if (l > -kInfinity) return u < kInfinity ? GLP_DB : GLP_LO;
  return u < kInfinity ? GLP_UP : GLP_FR;
}

class Glpk : public LpSolver {
 public:
  void solve(const LinearProgram& program, LpSolution& solution) override {
    thread_local const Environment kEnvironment;
    if (refused(program, solution)) return;
    const bool warm = static_cast<int>(solution.basis.size()) == program.rows() + program.cols();
    // Scaling costs more than a small program; what fails without it is tried again with it.
    for (const bool careful : {false, true}) {
      if (careful && warm) ++solution.cold_restarts;
      if (try_once(program, warm && !careful, careful, solution)) return;
    }
    prove_no_optimum(
        program,
        [this](const LinearProgram& other, LpSolution& proof) {
          return (try_once(other, false, false, proof) || try_once(other, false, true, proof)) &&
                 proof.status == Status::kOptimal;
        },
        solution);
  }

 private:
  /// False if there is no verdict that the data confirm.
  bool try_once(const LinearProgram& program, bool warm, bool careful, LpSolution& solution) {
    Problem problem = load(program);
    const int status = run(problem, program, warm, careful, solution);
    if (status == GLP_OPT) {
      solution.status = Status::kOptimal;
      solution.reason = "";
      return verified(program, solution, careful ? 1e-7 : 1e-9, scratch_);
    }
    solution.status = Status::kInfeasible;
    solution.reason = "no x satisfies the rows within its bounds";
    return status == GLP_NOFEAS && find_farkas(*problem, program, solution);
  }

  /// The row of the inverse basis that belongs to the variable that cannot become feasible: GLPK's
  /// system is x_R - A x_S = 0, of which any combination of rows is a consequence.
  bool find_farkas(glp_prob& problem, const LinearProgram& program, LpSolution& solution) {
    const int rows = program.rows();
    const int k = glp_get_unbnd_ray(&problem);
    if (k == 0 || (!glp_bf_exists(&problem) && glp_factorize(&problem) != 0)) return false;
    const int position =
        k <= rows ? glp_get_row_bind(&problem, k) : glp_get_col_bind(&problem, k - rows);
    if (position == 0) return false;
    values_.assign(rows + 1, 0);
    values_[position] = 1;
    glp_btran(&problem, values_.data());
    solution.certificate = Eigen::Map<const Eigen::VectorXd>(values_.data() + 1, rows);
    drop_rounding(solution.certificate);
    if (verified(program, solution, 1e-7, scratch_)) return true;
    solution.certificate = -solution.certificate;
    return verified(program, solution, 1e-7, scratch_);
  }

  Problem load(const LinearProgram& program) {
    glp_term_out(GLP_OFF);
    glp_term_hook(swallow, nullptr);  // a failed assertion turns the output on again
    Problem problem(glp_create_prob());
    const int rows = program.rows();
    const int cols = program.cols();
    glp_set_obj_dir(problem.get(), GLP_MAX);
    if (rows > 0) glp_add_rows(problem.get(), rows);
    if (cols > 0) glp_add_cols(problem.get(), cols);
    for (int i = 0; i < rows; ++i) {
      glp_set_row_bnds(problem.get(), i + 1, GLP_FX, program.b[i], program.b[i]);
    }
    for (int j = 0; j < cols; ++j) {
      glp_set_col_bnds(problem.get(), j + 1, bound_type(program.l[j], program.u[j]), program.l[j],
                       program.u[j]);
      glp_set_obj_coef(problem.get(), j + 1, program.c[j]);
      indices_.assign(1, 0);
      values_.assign(1, 0);
      for (Eigen::SparseMatrix<double>::InnerIterator it(program.A, j); it; ++it) {
        if (it.value() == 0) continue;
        indices_.push_back(static_cast<int>(it.row()) + 1);
        values_.push_back(it.value());
      }
      glp_set_mat_col(problem.get(), j + 1, static_cast<int>(indices_.size()) - 1, indices_.data(),
                      values_.data());
    }
    return problem;
  }

  /// The status, GLP_UNDEF if GLPK fell over; `problem` is empty then.
  static int run(Problem& owner, const LinearProgram& program, bool warm, bool careful,
                 LpSolution& solution) {
    glp_prob& problem = *owner;
    int failed = 0;
    const int rows = program.rows();
    const int cols = program.cols();
    if (careful && !guarded(prepare, &problem, nullptr, failed)) return lose(owner);
    if (warm) {
      for (int j = 0; j < cols; ++j) glp_set_col_stat(&problem, j + 1, to_glpk(solution.basis[j]));
      for (int i = 0; i < rows; ++i) {
        glp_set_row_stat(&problem, i + 1, to_glpk(solution.basis[cols + i]));
      }
      if (!guarded(factorize, &problem, nullptr, failed)) return lose(owner);
      if (failed != 0) glp_std_basis(&problem);
    }
    glp_smcp options;
    glp_init_smcp(&options);
    options.msg_lev = GLP_MSG_OFF;
    options.meth = GLP_DUALP;
    options.tol_bnd = options.tol_dj = 1e-9;
    options.it_lim = 5000 + 50 * (rows + cols);
    if (!guarded(glp_simplex, &problem, &options, failed)) return lose(owner);
    solution.iterations += glp_get_it_cnt(&problem);
    solution.x.resize(cols);
    solution.lambda.resize(rows);
    solution.basis.resize(rows + cols);
    for (int j = 0; j < cols; ++j) {
      solution.x[j] = glp_get_col_prim(&problem, j + 1);
      solution.basis[j] = from_glpk(glp_get_col_stat(&problem, j + 1));
    }
    for (int i = 0; i < rows; ++i) {
      // The reduced cost of the row's auxiliary variable, which is fixed at b.
      solution.lambda[i] = glp_get_row_dual(&problem, i + 1);
      solution.basis[cols + i] = from_glpk(glp_get_row_stat(&problem, i + 1));
    }
    solution.objective = program.c.dot(solution.x);
    return failed == 0 ? glp_get_status(&problem) : GLP_UNDEF;
  }

  static int lose(Problem& owner) {
    static_cast<void>(owner.release());  // freed with its environment
    return GLP_UNDEF;
  }

  std::vector<int> indices_;
  std::vector<double> values_;
  LpScratch scratch_;
};

}  // namespace

std::unique_ptr<LpSolver> make_glpk() { return std::make_unique<Glpk>(); }

}  // namespace maxwrench
