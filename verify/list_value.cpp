#include "verify/list_value.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "verify/incumbent.h"
#include "verify/list_forms.h"

namespace maxwrench {
namespace {

using Real = long double;
using RealVector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

/// Columns whose part across others is shorter than this depend on them.
constexpr Real kDependent = 1e-11L;
/// Slopes of infinite limits below this count as zero.
constexpr double kNoSlope = 1e-12;
/// More sets of columns than this take too long.
constexpr double kMostSets = 2e6;

/// Unit vectors that are orthogonal to each other.
struct Orthogonal {
  std::vector<RealVector> all;
  /// The part of x across them, computed twice for the sake of its digits.
  RealVector across(RealVector x) const {
    for (int pass = 0; pass < 2; ++pass) {
      for (const RealVector& each : all) x -= each.dot(x) * each;
    }
    return x;
  }
  /// Adds the direction of x; false if x depends on the others.
  bool add(const RealVector& x) {
    const Real size = x.norm();
    if (size == 0) return false;
    const RealVector rest = across(x / size);
    if (rest.norm() < kDependent) return false;
    all.push_back(rest.normalized());
    return true;
  }
};

/// The normals of all facets of {B u}, and of all directions that B does not reach.
class ListNormals {
 public:
  explicit ListNormals(const Eigen::MatrixXd& B) : B_(B.cast<Real>()) {
    for (Eigen::Index k = 0; k < B_.cols(); ++k) range_.add(B_.col(k));
    const std::size_t rank = range_.all.size();
    Orthogonal all = range_;
    for (Eigen::Index i = 0; i < B_.rows(); ++i) all.add(RealVector::Unit(B_.rows(), i));
    normals.assign(all.all.begin() + static_cast<std::ptrdiff_t>(rank), all.all.end());
    double sets = 1;
    for (std::size_t i = 0; i + 1 < rank; ++i) {
      sets *= static_cast<double>(B_.cols() - static_cast<Eigen::Index>(i)) /
              static_cast<double>(i + 1);
    }
    complete = sets <= kMostSets;
    if (complete && rank > 0) extend({}, 0, rank - 1);
  }

  bool complete = true;  ///< false: there are too many
  std::vector<RealVector> normals;

 private:
  /// Adds `more` columns to independent ones, from number `from` on.
  void extend(const Orthogonal& chosen, Eigen::Index from, std::size_t more) {
    if (more == 0) return add_across(chosen);
    for (Eigen::Index k = from; k + static_cast<Eigen::Index>(more) <= B_.cols(); ++k) {
      Orthogonal next = chosen;
      if (next.add(B_.col(k))) extend(next, k + 1, more - 1);
    }
  }
  /// The direction within the range of B across the chosen columns: that of the vector of an
  /// orthogonal basis with the longest part.
  void add_across(const Orthogonal& chosen) {
    RealVector longest = RealVector::Zero(B_.rows());
    for (const RealVector& each : range_.all) {
      const RealVector rest = chosen.across(each);
      if (rest.norm() > longest.norm()) longest = rest;
    }
    normals.push_back(longest.normalized());
  }

  const Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic> B_;
  Orthogonal range_;
};

/// The rows of a list at one posture.
class ListAtPosture {
 public:
  ListAtPosture(const Problem& problem, const FormModel& model, const ListForms& forms,
                const Eigen::VectorXd& x)
      : list_(problem.scenarios) {
    const auto at = [&](const std::vector<FormRow>& rows) {
      std::vector<Narrow> values;
      for (const FormRow& row : rows) {
        values.push_back(BoxForms::at_point(model.shape(), row, x));
      }
      return values;
    };
    nominal = at(forms.nominal());
    for (std::size_t load = 0; load < list_.loads.size(); ++load) {
      auto& values = cases.emplace_back();
      for (std::size_t i = 0; i < list_.loads[load].size(); ++i) {
        values.push_back(at(forms.of_case(load, i)));
      }
    }
    for (std::size_t k = 0; k < 6; ++k) along[k] = at(forms.along(k));
  }

  /// tau_s + t J'c_s.
  std::vector<Narrow> load(const ListForms& forms, const ListScenario& of, double t) const {
    std::vector<Narrow> sum = nominal;
    const std::array<Narrow, 6> c = forms.wrench(of);
    for (std::size_t i = 0; i < sum.size(); ++i) {
      for (std::size_t load = 0; load < of.cases.size(); ++load) {
        sum[i] += cases[load][static_cast<std::size_t>(of.cases[load])][i];
      }
      for (std::size_t k = 0; k < c.size(); ++k) {
        if (!c[k].is_zero()) sum[i] += t * (c[k] * along[k][i]);
      }
    }
    return sum;
  }

  /// The largest n'(tau_s + t J'c_s) over all cases of loads and all z of the ball, t >= 0 if there
  /// is one.
  Narrow most(const std::vector<double>& normal, std::size_t wrench, double t) const {
    Narrow sum = dot(normal, nominal);
    for (const auto& values : cases) {
      Narrow worst(-kInfinity);
      for (const auto& value : values) {
        const Narrow each = dot(normal, value);
        worst = {std::max(worst.low, each.low), std::max(worst.high, each.high)};
      }
      sum += worst;
    }
    const ScenarioWrench& of = list_.wrenches[wrench];
    std::array<Narrow, 6> slopes;
    for (std::size_t k = 0; k < 6; ++k) slopes[k] = dot(normal, along[k]);
    for (std::size_t k = 0; k < 6; ++k) {
      sum += t * (of.c[static_cast<Eigen::Index>(k)] * slopes[k]);
    }
    if (!list_.ball || of.hold) return sum;
    Narrow square;
    for (const auto& axis : list_.ball->E.colwise()) {
      Narrow slope;
      for (std::size_t k = 0; k < 6; ++k) slope += axis[static_cast<Eigen::Index>(k)] * slopes[k];
      square += Narrow(slope.magnitude()) * Narrow(slope.magnitude());
    }
    return sum + Narrow(t) * Narrow(list_.ball->radius) * Narrow(root_above(square.high));
  }

  std::vector<Narrow> nominal;
  std::vector<std::vector<std::vector<Narrow>>> cases;
  std::array<std::vector<Narrow>, 6> along;

 private:
  static Narrow dot(const std::vector<double>& normal, const std::vector<Narrow>& x) {
    Narrow sum;
    for (std::size_t i = 0; i < x.size(); ++i) sum += normal[i] * x[i];
    return sum;
  }

  const ScenarioList& list_;
};

/// A lower bound of the support of {B u}.
double support_below(const std::vector<double>& normal, const Zonotope& limits,
                     const Eigen::MatrixXd& B) {
  Narrow sum;
  for (Eigen::Index k = 0; k < B.cols(); ++k) {
    Narrow slope;
    for (Eigen::Index i = 0; i < B.rows(); ++i) {
      slope += Narrow(normal[static_cast<std::size_t>(i)]) * Narrow(B(i, k));
    }
    const double limit = slope.low > 0 ? limits.u_max[k] : limits.u_min[k];
    if (!std::isfinite(limit)) {
      if (slope.magnitude() <= kNoSlope * B.col(k).norm()) continue;
      return kInfinity;
    }
    sum += Narrow(limit) * slope;
  }
  return sum.low;
}

std::string reject_efforts(const Problem& problem, const ProofCertificate& proof,
                           const ListForms& forms, const ListAtPosture& at, double tolerance) {
  constexpr double kOffBall = 1e-9;
  if (proof.decides.size() != forms.entries()) return "it names no scenario that decides";
  const auto scenario = forms.read(proof.decides.data());
  if (!scenario) return "the scenario that decides is not in the list";
  const double length2 =
      std::inner_product(scenario->z.begin(), scenario->z.end(), scenario->z.begin(), 0.0);
  if (!(length2 <= 1 + kOffBall)) return "the wrench that decides is not in the ball";
  const Zonotope& limits =
      problem.scenarios.limits[static_cast<std::size_t>(scenario->limits)].actuation;
  const std::vector<Narrow> tau = at.load(forms, *scenario, proof.value);
  return reject_balance(problem.robot.actuation.B, limits, proof.u, tau, tolerance);
}

}  // namespace

std::string reject_list_value(const Problem& problem, const FormModel& model,
                              const ProofCertificate& proof, double tolerance) {
  const ScenarioList& list = problem.scenarios;
  for (const LoadGroup& group : list.loads) {
    for (const LoadCase& load : group) {
      if (!load.current.isZero(0)) return "currents are not supported";
    }
  }
  if (list.payload && problem.free.count() > 0) {
    return "a payload at a pose that is partly free is not supported";
  }
  if (list.non_negative && !(proof.value >= -tolerance)) return "its value is negative";
  const ListForms forms(problem, model);
  const ListAtPosture at(problem, model, forms, proof.x);
  const ListNormals facets(problem.robot.actuation.B);
  if (!facets.complete) return "there are too many facets to check its value";
  const double t = list.non_negative ? std::max(proof.value, 0.0) : proof.value;
  for (const RealVector& normal : facets.normals) {
    for (const double side : {1.0, -1.0}) {
      std::vector<double> n;
      for (const Real x : normal) n.push_back(side * static_cast<double>(x));
      std::vector<double> supports;
      for (const ScenarioLimits& limits : list.limits) {
        supports.push_back(support_below(n, limits.actuation, problem.robot.actuation.B));
      }
      const double least = *std::min_element(supports.begin(), supports.end());
      for (std::size_t wrench = 0; wrench < list.wrenches.size(); ++wrench) {
        if (!(at.most(n, wrench, t).high <= least + tolerance)) {
          return "its value is not held in a scenario: " + (list.wrenches[wrench].name.empty()
                                                                ? "of its wrench"
                                                                : list.wrenches[wrench].name);
        }
      }
    }
  }
  return reject_efforts(problem, proof, forms, at, tolerance);
}

}  // namespace maxwrench
