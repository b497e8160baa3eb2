#include "solvers/search/row_sqp.h"

#include <nlopt.h>

#include <memory>
#include <vector>

#include "maxwrench/types.h"
#include "solvers/caught.h"
#include "solvers/search/nlopt_run.h"

namespace maxwrench {
namespace {

using RowOptimizer = std::unique_ptr<std::remove_pointer_t<nlopt_opt>, decltype(&nlopt_destroy)>;

/// Tolerances of rows, as shares of half their width, and of y.
constexpr double kRowTolerance = 1e-9, kYTolerance = 1e-9;
/// How far each row appears violated at a point without values, and how much value such a point
/// appears to lose.
constexpr double kMiss = 10;

/// A side of a row: sign row <= limit.
struct Bounded {
  Eigen::Index row;
  double sign, limit;
};

/// A local solve of the program, as the data of NLopt's functions.
struct RowSession {
  RowProgram& program;
  nlopt_opt opt;
  Eigen::VectorXd y, gradient;
  std::vector<Bounded> wide;       ///< sides of rows with some width that have a bound
  std::vector<Eigen::Index> flat;  ///< rows without width
  Caught caught;

  /// Whether the rows have values at the point.
  bool look(unsigned n, const double* point) {
    y = Eigen::Map<const Eigen::VectorXd>(point, n);
    const bool seen = caught.run(false, [&] { return program.look(y); });
    if (caught.any() || (!seen && program.ended())) nlopt_force_stop(opt);
    return seen;
  }
  /// The signed derivative of a row; zero where there is none.
  void slope(bool seen, Eigen::Index row, double sign, double* to) {
    Eigen::Map<Eigen::RowVectorXd> into(to, y.size());
    into.setZero();
    if (seen) caught.run(0, [&] { return into = sign * program.jacobian().row(row), 0; });
  }
};

double row_objective(unsigned n, const double* point, double* slope, void* data) {
  RowSession& s = *static_cast<RowSession*>(data);
  const bool seen = s.look(n, point);
  if (slope) Eigen::Map<Eigen::VectorXd>(slope, n) = s.program.c_y();
  return s.program.c_y().dot(s.y) - (seen ? 0 : kMiss);
}

/// By how much the sides of rows with some width are violated.
void limits(unsigned, double* result, unsigned n, const double* point, double* slope, void* data) {
  RowSession& s = *static_cast<RowSession*>(data);
  const bool seen = s.look(n, point);
  for (const Bounded& side : s.wide) {
    *result++ = seen ? side.sign * s.program.rows()[side.row] - side.limit : kMiss;
    if (!slope) continue;
    s.slope(seen, side.row, side.sign, slope);
    slope += n;
  }
}

/// rows - row_max of the rows without width.
void balance(unsigned, double* result, unsigned n, const double* point, double* slope, void* data) {
  RowSession& s = *static_cast<RowSession*>(data);
  const bool seen = s.look(n, point);
  for (const Eigen::Index row : s.flat) {
    *result++ = seen ? s.program.rows()[row] - s.program.row_max()[row] : kMiss;
    if (!slope) continue;
    s.slope(seen, row, 1, slope);
    slope += n;
  }
}

}  // namespace

RowEnd solve_rows_by_slsqp(RowProgram& program, int points) {
  Eigen::VectorXd y = program.start();
  const RowOptimizer opt(nlopt_create(NLOPT_LD_SLSQP, static_cast<unsigned>(y.size())),
                         nlopt_destroy);
  RowSession session{program, opt.get(), y, {}, {}, {}, {}};
  for (Eigen::Index j = 0; j < program.row_min().size(); ++j) {
    const double low = program.row_min()[j], high = program.row_max()[j];
    if (low == high) {
      session.flat.push_back(j);
      continue;
    }
    if (high < kInfinity) session.wide.push_back({j, 1, high});
    if (low > -kInfinity) session.wide.push_back({j, -1, -low});
  }
  // SLSQP accepts no more equations than unknowns. With more, there is nothing to choose, and the
  // start is the result.
  if (static_cast<Eigen::Index>(session.flat.size()) > y.size()) return {y, "too_many_equations"};
  const auto take = [](nlopt_result result) { require_taken(result, "slsqp"); };
  take(nlopt_set_lower_bounds(opt.get(), program.lower().data()));
  take(nlopt_set_upper_bounds(opt.get(), program.upper().data()));
  take(nlopt_set_max_objective(opt.get(), row_objective, &session));
  const std::vector<double> tolerance(session.wide.size() + session.flat.size(), kRowTolerance);
  take(nlopt_add_inequality_mconstraint(opt.get(), static_cast<unsigned>(session.wide.size()),
                                        limits, &session, tolerance.data()));
  take(nlopt_add_equality_mconstraint(opt.get(), static_cast<unsigned>(session.flat.size()),
                                      balance, &session, tolerance.data()));
  take(nlopt_set_xtol_abs1(opt.get(), kYTolerance));
  take(nlopt_set_maxeval(opt.get(), points));
  double value = 0;
  const nlopt_result result = nlopt_optimize(opt.get(), y.data(), &value);
  session.caught.rethrow();
  return {y.allFinite() ? y : program.start(), word_of(result)};
}

}  // namespace maxwrench
