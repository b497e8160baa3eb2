#include <glpk.h>

#include <csetjmp>

#include "solvers/lp/elastic.h"
#include "solvers/lp/makers.h"

namespace maxwrench {
namespace {

/// The number of memory blocks in this thread's environment.
int blocks() {
  int count = 0;
  glp_mem_usage(&count, nullptr, nullptr, nullptr);
  return count;
}

/// GLPK has an environment for each thread, which may hold problems of a host program. It is freed
/// only if this class opened it and nothing is left in it except the remains of failed calls of
/// ours.
class Environment {
 public:
  Environment() = default;
  ~Environment() { free(); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

  void open() {
    if (glp_init_env() == 0) ours_ = true;
  }

  /// Call this after a call has failed and left a damaged problem. `before` is the number of blocks
  /// before the call.
  void clean_up(int before) {
    lost_ += blocks() - before;
    if (free()) open();
  }

 private:
  bool free() {
    if (!ours_ || blocks() != lost_) return false;
    glp_free_env();
    ours_ = false;
    lost_ = 0;
    return true;
  }

  bool ours_ = false;
  int lost_ = 0;  ///< blocks that cannot be freed one by one
};

Environment& environment() {
  thread_local Environment environment;
  return environment;
}

/// Reports a message as printed, which suppresses it.
int swallow(void* /*info*/, const char* /*message*/) { return 1; }

/// Keeps GLPK quiet. A failed assertion turns the output on again, so an error hook is needed.
class Quiet {
 public:
  Quiet() : before_(start()) {}
  ~Quiet() {
    glp_term_hook(nullptr, nullptr);
    glp_term_out(before_);
  }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

  /// Call this again after an error and in a new environment. Returns the previous setting.
  static int start() {
    glp_term_hook(swallow, nullptr);
    return glp_term_out(GLP_OFF);
  }

 private:
  int before_;
};

void jump(void* back) { std::longjmp(*static_cast<std::jmp_buf*>(back), 1); }

/// Calls a function of GLPK. For some singular bases GLPK fails an assertion, which would end the
/// process. Then this returns false, and the problem must not be used any more. The jump back
/// crosses only frames of C.
bool guarded(int (*call)(glp_prob*, const glp_smcp*), glp_prob* problem, const glp_smcp* options,
             int& result) {
  std::jmp_buf back;
  if (setjmp(back) != 0) {
    glp_error_hook(nullptr, nullptr);
    return false;
  }
  glp_error_hook(jump, &back);
  result = call(problem, options);
  glp_error_hook(nullptr, nullptr);
  return true;
}

/// With scaling, GLPK rejects factors out of range, also by a failed assertion.
int prepare(glp_prob* problem, const glp_smcp* /*options*/) {
  glp_scale_prob(problem, GLP_SF_AUTO);
  glp_adv_basis(problem, 0);
  return 0;
}

int factorize(glp_prob* problem, const glp_smcp* /*options*/) { return glp_factorize(problem); }

/// Factors the basis if it has no factors.
int refactorize(glp_prob* problem, const glp_smcp* /*options*/) {
  return glp_bf_exists(problem) ? 0 : glp_factorize(problem);
}

struct Delete {
  void operator()(glp_prob* problem) const { glp_delete_prob(problem); }
};
using GlpkProblem = std::unique_ptr<glp_prob, Delete>;

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
  explicit Glpk(bool keep_model) : keep_model_(keep_model) {}

  void solve(const LinearProgram& program, LpSolution& solution) override {
    if (rejected(program, solution)) return;
    environment().open();
    const Quiet quiet;
    // For a small program, scaling costs more than the solution; a failed attempt is repeated with
    // scaling.
    solve_by_attempts(
        program,
        [this](const LinearProgram& other, bool warm, bool careful, LpSolution& answer) {
          const bool verdict = try_once(other, warm, careful, answer);
          if (!keep_model_ || !verdict) problem_.reset();
          return verdict;
        },
        solution);
  }

 private:
  /// Returns false if there is no verdict that the data confirm.
  bool try_once(const LinearProgram& program, bool warm, bool careful, LpSolution& solution) {
    if (careful) problem_.reset();
    load(program);
    const int status = run(program, warm, careful, solution);
    if (status == GLP_OPT) {
      solution.status = Status::kOptimal;
      solution.reason = "";
      return verified(program, solution, careful ? 1e-7 : 1e-9, scratch_);
    }
    solution.status = Status::kInfeasible;
    solution.reason = "no x satisfies the rows within its bounds";
    return status == GLP_NOFEAS && find_farkas(program, solution);
  }

  /// The row of the inverse basis that belongs to the variable that cannot become feasible. GLPK's
  /// system is x_R - A x_S = 0, and any combination of its rows follows from it.
  bool find_farkas(const LinearProgram& program, LpSolution& solution) {
    glp_prob* const problem = problem_.get();
    const int rows = program.rows();
    const int k = glp_get_unbnd_ray(problem);
    int failed = 0;
    if (k == 0) return false;
    if (!guarded(refactorize, problem, nullptr, failed)) return lose() == GLP_OPT;
    if (failed != 0) return false;
    const int position =
        k <= rows ? glp_get_row_bind(problem, k) : glp_get_col_bind(problem, k - rows);
    if (position == 0) return false;
    values_.assign(rows + 1, 0);
    values_[position] = 1;
    glp_btran(problem, values_.data());
    solution.certificate = Eigen::Map<const Eigen::VectorXd>(values_.data() + 1, rows);
    drop_rounding(solution.certificate);
    if (verified(program, solution, 1e-7, scratch_)) return true;
    solution.certificate = -solution.certificate;
    return verified(program, solution, 1e-7, scratch_);
  }

  /// Writes the program into the stored problem, or into a new one.
  void load(const LinearProgram& program) {
    const int rows = program.rows();
    const int cols = program.cols();
    const bool fits = problem_ && glp_get_num_rows(problem_.get()) == rows &&
                      glp_get_num_cols(problem_.get()) == cols;
    if (!fits) {
      problem_.reset();
      blocks_before_ = blocks();
      problem_.reset(glp_create_prob());
      if (rows > 0) glp_add_rows(problem_.get(), rows);
      if (cols > 0) glp_add_cols(problem_.get(), cols);
    }
    glp_prob* const problem = problem_.get();
    glp_set_obj_dir(problem, GLP_MAX);
    for (int i = 0; i < rows; ++i) {
      glp_set_row_bnds(problem, i + 1, GLP_FX, program.b[i], program.b[i]);
    }
    for (int j = 0; j < cols; ++j) {
      glp_set_col_bnds(problem, j + 1, bound_type(program.l[j], program.u[j]), program.l[j],
                       program.u[j]);
      glp_set_obj_coef(problem, j + 1, program.c[j]);
      indices_.assign(1, 0);
      values_.assign(1, 0);
      for (Eigen::SparseMatrix<double>::InnerIterator it(program.A, j); it; ++it) {
        if (it.value() == 0) continue;
        indices_.push_back(static_cast<int>(it.row()) + 1);
        values_.push_back(it.value());
      }
      glp_set_mat_col(problem, j + 1, static_cast<int>(indices_.size()) - 1, indices_.data(),
                      values_.data());
    }
  }

  /// Returns false if GLPK failed an assertion.
  bool start(const LinearProgram& program, bool warm, bool careful, const LpSolution& solution) {
    glp_prob* const problem = problem_.get();
    const int cols = program.cols();
    int failed = 0;
    if (careful) return guarded(prepare, problem, nullptr, failed);
    if (!warm) {
      glp_std_basis(problem);
      return true;
    }
    for (int j = 0; j < cols; ++j) glp_set_col_stat(problem, j + 1, to_glpk(solution.basis[j]));
    for (int i = 0; i < program.rows(); ++i) {
      glp_set_row_stat(problem, i + 1, to_glpk(solution.basis[cols + i]));
    }
    if (!guarded(factorize, problem, nullptr, failed)) return false;
    if (failed != 0) glp_std_basis(problem);
    return true;
  }

  /// Returns the status, or GLP_UNDEF if GLPK failed an assertion; then there is no problem any
  /// more.
  int run(const LinearProgram& program, bool warm, bool careful, LpSolution& solution) {
    if (!start(program, warm, careful, solution)) return lose();
    glp_prob* const problem = problem_.get();
    const int rows = program.rows();
    const int cols = program.cols();
    const int before = glp_get_it_cnt(problem);
    int failed = 0;
    glp_smcp options;
    glp_init_smcp(&options);
    options.msg_lev = GLP_MSG_OFF;
    options.meth = GLP_DUALP;
    options.tol_bnd = options.tol_dj = 1e-9;
    options.it_lim = 5000 + 50 * (rows + cols);
    if (!guarded(glp_simplex, problem, &options, failed)) return lose();
    solution.iterations += glp_get_it_cnt(problem) - before;
    solution.x.resize(cols);
    solution.lambda.resize(rows);
    solution.basis.resize(rows + cols);
    for (int j = 0; j < cols; ++j) {
      solution.x[j] = glp_get_col_prim(problem, j + 1);
      solution.basis[j] = from_glpk(glp_get_col_stat(problem, j + 1));
    }
    for (int i = 0; i < rows; ++i) {
      // The reduced cost of the row's auxiliary variable, which is fixed at b.
      solution.lambda[i] = glp_get_row_dual(problem, i + 1);
      solution.basis[cols + i] = from_glpk(glp_get_row_stat(problem, i + 1));
    }
    solution.objective = program.c.dot(solution.x);
    return failed == 0 ? glp_get_status(problem) : GLP_UNDEF;
  }

  /// Hands a damaged problem over to the environment.
  int lose() {
    static_cast<void>(problem_.release());
    environment().clean_up(blocks_before_);
    Quiet::start();
    return GLP_UNDEF;
  }

  bool keep_model_;
  GlpkProblem problem_;
  int blocks_before_ = 0;  ///< of the environment, without the problem
  std::vector<int> indices_;
  std::vector<double> values_;
  LpScratch scratch_;
};

}  // namespace

std::unique_ptr<LpSolver> make_glpk() { return std::make_unique<Glpk>(false); }
std::unique_ptr<LpSolver> make_glpk_keeping_its_model() { return std::make_unique<Glpk>(true); }

}  // namespace maxwrench
