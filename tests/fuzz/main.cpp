// Feeds random and damaged input to the readers and the solvers: no crash, no hang, no rejection
// that is not one line, no verdict that the data do not confirm, and of our own solvers hardly any
// without a verdict. Run it under the sanitizers:
//
//     maxwrench_fuzz [SECONDS [SEED]]

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <stdexcept>

#include "maxwrench/mps.h"
#include "maxwrench/strategies.h"
#include "maxwrench/wrench_program.h"
#include "tests/fuzz/damage.h"
#include "tests/fuzz/damaged_problems.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

using Clock = std::chrono::steady_clock;

/// Longer than any program of this size may take, even under sanitizers.
constexpr double kHang = 60;

/// Our own solvers may leave this share of programs undecided, whose numbers do not hurt.
constexpr double kUndecided = 1e-3;

bool own(std::string_view solver) {
  return solver == "simplex" || solver == "condensed" || solver == "facets";
}

class Fuzzer {
 public:
  explicit Fuzzer(std::uint64_t seed) : random_(seed) {
    for (const LpEntry& entry : lp_solvers()) {
      if (std::string_view(entry.name) == "ipopt") continue;  // milliseconds each, tested elsewhere
      solvers_.emplace_back(entry.name, entry.make());
    }
    const std::filesystem::path folder(MAXWRENCH_SOURCE_DIR "/tests/data/lp");
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      texts_.push_back(read_text(entry.path()));
    }
    std::sort(texts_.begin(), texts_.end());
  }

  /// One input of each kind.
  void step() {
    solve_everywhere(random_program());
    solve_wrench_program();
    read_damaged_file();
    if (steps_ % 8 == 0) read_damaged_problem();
    ++steps_;
  }

  bool failed() const { return failures_ > 0; }

  /// After all steps. A few programs more than the share are chance.
  void judge_own_solvers() {
    for (const auto& [name, count] : asked_) {
      const long undecided = undecided_[name];
      if (static_cast<double>(undecided) > 3 + kUndecided * static_cast<double>(count)) {
        fail(fmt::format("{} left {} of {} programs undecided", name, undecided, count));
      }
    }
  }

  void report() const {
    fmt::print("{} steps, {} failures\n", steps_, failures_);
    for (const auto& [what, count] : tally_) fmt::print("{:<40} {}\n", what, count);
  }

 private:
  int whole(int low, int high) { return maxwrench::whole(random_, low, high); }

  bool chance(double p) { return random_.uniform() < p; }

  /// Mostly small whole numbers, so that ties abound, now and then one that hurts.
  double nasty() {
    static const double kAwkward[] = {0,   -0.0, 1e-300, 1e-15, 1e-9, 1e-6, 1e6,
                                      1e9, 1e15, 1e19,   1e20,  1e30, NAN,  kInfinity};
    if (!awkward_ || chance(0.95)) return whole(-3, 3);
    if (chance(0.8)) return random_.normal() * std::pow(10, whole(-8, 8));
    return kAwkward[whole(0, std::size(kAwkward) - 1)] * (chance(0.5) ? 1 : -1);
  }

  LinearProgram random_program() {
    awkward_ = chance(0.3);
    const int m = whole(0, 8);
    const int n = whole(0, 14);
    LinearProgram p;
    Eigen::MatrixXd A(m, n);
    for (double& a : A.reshaped()) a = chance(0.5) ? 0 : nasty();
    if (m > 1 && chance(0.3)) A.row(whole(0, m - 1)) = A.row(whole(0, m - 1)).eval();
    if (n > 1 && chance(0.3)) A.col(whole(0, n - 1)) = A.col(whole(0, n - 1)).eval();
    p.A = A.sparseView();
    p.b.resize(m);
    p.c.resize(n);
    p.l.resize(n);
    p.u.resize(n);
    for (double& b : p.b) b = nasty();
    for (int j = 0; j < n; ++j) {
      p.c[j] = nasty();
      p.l[j] = chance(0.2) ? -kInfinity : nasty();
      p.u[j] =
          chance(0.2) ? kInfinity : std::max(p.l[j], -3.0) + (chance(0.2) ? 0 : std::abs(nasty()));
    }
    return p;
  }

  void solve_everywhere(const LinearProgram& program) {
    for (auto& [name, solver] : solvers_) {
      LpSolution solution;
      if (chance(0.5)) {
        const int size = chance(0.9) ? program.rows() + program.cols() : whole(0, 5);
        for (int i = 0; i < size; ++i) {
          solution.basis.push_back(static_cast<VariableState>(whole(0, 3)));
        }
      }
      timed(name, [&, &s = solver] { s->solve(program, solution); });
      judge(name, program, solution);
      if (!awkward_ && own(name)) count(name, solution.status);
    }
  }

  void count(const std::string& name, Status status) {
    ++asked_[name];
    undecided_[name] += status == Status::kNumericalError;
  }

  void judge(const std::string& name, const LinearProgram& program, const LpSolution& solution) {
    ++tally_[name + " " + to_string(solution.status)];
    const bool verdict = solution.status == Status::kOptimal ||
                         solution.status == Status::kInfeasible ||
                         solution.status == Status::kUnbounded;
    if (verdict && !verified(program, solution, 1e-6)) {
      fail(fmt::format("{}: {} is not confirmed", name, to_string(solution.status)));
    }
    if (!verdict && solution.reason.empty()) fail(name + ": no verdict and no reason");
  }

  Zonotope random_actuation() {
    const int n = whole(1, 8);
    const int m = whole(1, 10);
    Eigen::MatrixXd B(n, m);
    for (double& b : B.reshaped())
      b = chance(0.4) ? 0 : whole(-2, 2) + (chance(0.3) ? random_.normal() : 0);
    if (chance(0.3)) B.rightCols(std::min(n, m)).bottomRows(std::min(n, m)).setIdentity();
    Eigen::VectorXd u_min(m);
    Eigen::VectorXd u_max(m);
    for (int j = 0; j < m; ++j) {
      u_min[j] = whole(-4, 0);
      u_max[j] = chance(0.1) ? u_min[j] : u_min[j] + whole(0, 5);
    }
    return make_zonotope(B, u_min, u_max);
  }

  /// Every solver that takes the program: what it says must be proved by the program's data.
  void solve_wrench_program() {
    const Zonotope set = random_actuation();
    WrenchProgram program;
    program.actuation = &set;
    const int k = whole(1, 6);
    program.W = Matrix6Xd::Identity(6, k);
    program.c_w = Eigen::VectorXd::Unit(k, whole(0, k - 1));
    program.w_min = Eigen::VectorXd::Constant(k, -kInfinity);
    program.w_max = Eigen::VectorXd::Constant(k, kInfinity);
    for (int j = 0; j < k; ++j) {
      if (chance(0.2)) program.w_min[j] = whole(-2, 0);
      if (chance(0.2)) program.w_max[j] = whole(0, 2);
    }
    program.JtW.resize(set.dimension(), k);
    program.tau_d.resize(set.dimension());
    for (double& x : program.JtW.reshaped()) x = chance(0.3) ? 0 : whole(-2, 2);
    for (double& x : program.tau_d) x = chance(0.2) ? random_.normal() : whole(-3, 3);
    if (chance(0.2)) program.tau_d *= std::pow(10, whole(-9, 3));
    for (const WrenchSolverEntry& entry : wrench_solvers()) {
      if (std::string_view(entry.name) == "ipopt" || (entry.one_column_only && k != 1)) continue;
      judge_wrench(entry, program);
    }
  }

  void judge_wrench(const WrenchSolverEntry& entry, const WrenchProgram& program) {
    const std::string name = fmt::format("wrench, {}", entry.name);
    Capability capability;
    timed(name, [&] { entry.make()->solve(program, true, capability); });
    ++tally_[name + " " + to_string(capability.status)];
    if (own(entry.name)) count(name, capability.status);
    bool holds = true;
    if (capability.status == Status::kOptimal) {
      // Relative to the loads, as the solvers' own checks are.
      const double load = program.tau_d.lpNorm<Eigen::Infinity>();
      holds = recheck(program, capability.u, capability.w, capability.lambda)
                  .within(1e-6 * (1 + std::max(std::abs(capability.beta), load)));
    } else if (capability.status == Status::kInfeasible) {
      holds = proves_infeasible(program, capability.lambda);
    }
    if (!holds) fail(fmt::format("{}: {} is not confirmed", name, to_string(capability.status)));
  }

  /// A shipped file with some of its bytes, words or lines exchanged, doubled or lost.
  void read_damaged_file() {
    static const char* const kWords[] = {"RHS",  "BOUNDS",   "RANGES",  " UP ",  " FX ",
                                         " N ",  "ENDATA",   "1e400",   "-1e30", "nan",
                                         "\n",   "'MARKER'", "COLUMNS", "\t",    "OBJSENSE\n MAX\n",
                                         "NAME", "0x1p3"};
    const auto last = static_cast<int>(texts_.size()) - 1;
    const std::string text =
        damaged(texts_[static_cast<std::size_t>(whole(0, last))], kWords, random_);
    const std::filesystem::path file = folder_.path() / "damaged.mps";
    std::ofstream(file) << text;
    try {
      MpsProgram mps;
      timed("mps", [&] { mps = read_mps(file.string()); });
      ++tally_["mps, read"];
      LpSolution solution;
      timed("mps, simplex", [&] { solvers_.front().second->solve(mps.program, solution); });
      judge("mps, simplex", mps.program, solution);
    } catch (const std::invalid_argument&) {
      ++tally_["mps, rejected"];
    }
  }

  void read_damaged_problem() {
    try {
      timed("problem", [&] { ++tally_[problems_.step(random_)]; });
    } catch (const std::logic_error& error) {
      fail(error.what());
    }
  }

  template <class Body>
  void timed(const std::string& name, Body body) {
    const auto start = Clock::now();
    body();
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    if (seconds > kHang) fail(fmt::format("{} took {:.0f} s", name, seconds));
  }

  void fail(const std::string& what) {
    ++failures_;
    fmt::print("step {}: {}\n", steps_, what);
  }

  Random random_;
  std::vector<std::pair<std::string, std::unique_ptr<LpSolver>>> solvers_;
  std::vector<std::string> texts_;
  TemporaryFolder folder_;
  DamagedProblems problems_;
  bool awkward_ = false;  ///< whether the program may hold numbers that hurt
  long steps_ = 0;
  int failures_ = 0;
  std::map<std::string, long> tally_, asked_, undecided_;
};

}  // namespace
}  // namespace maxwrench

int main(int argc, char** argv) {
  using namespace maxwrench;
  const double seconds = argc > 1 ? std::atof(argv[1]) : 5;
  const std::uint64_t seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
  Fuzzer fuzzer(seed);
  const auto start = Clock::now();
  while (std::chrono::duration<double>(Clock::now() - start).count() < seconds) fuzzer.step();
  fuzzer.judge_own_solvers();
  fuzzer.report();
  return fuzzer.failed() ? 1 : 0;
}
