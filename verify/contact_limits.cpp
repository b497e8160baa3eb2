#include "verify/contact_limits.h"

#include <Eigen/SVD>
#include <algorithm>
#include <stdexcept>

#include "verify/coordinates.h"
#include "verify/wide_matrix.h"

namespace maxwrench {
namespace {

/// What these limits exceed the exact ones by, as a share: for the rounding of rotations.
constexpr double kSlack = 1e-9;

/// An upper bound of what weight and actuators exert in the base's linear axes.
double most_force(const Robot& robot) {
  Wide weight(-robot.trim.buoyancy_mass);
  for (const Link& link : robot.links) {
    weight += Wide(link.mass) - Wide(robot.water_density) * Wide(link.volume);
  }
  Wide most = Wide(weight.magnitude()) * Wide(std::abs(robot.gravity));
  const Zonotope& set = robot.actuation;
  for (Eigen::Index k = 0; k < set.actuators(); ++k) {
    Wide square;
    for (std::size_t i = 0; i < robot.base_axes.size(); ++i) {
      const Wide entry(robot.base_axes[i] < 3 ? set.B(static_cast<Eigen::Index>(i), k) : 0);
      square += entry * entry;
    }
    most += Wide(std::max(std::abs(set.u_min[k]), std::abs(set.u_max[k]))) *
            Wide(root_above(square.high));
  }
  return narrow(most).high;
}

/// Whether M - s^2 is positive definite, by its pivots.
bool is_above(WideRows M, double s) {
  for (std::size_t i = 0; i < M.size(); ++i) M[i][i] -= Wide(s) * Wide(s);
  for (std::size_t i = 0; i < M.size(); ++i) {
    if (!(M[i][i].low > 0)) return false;
    for (std::size_t j = i + 1; j < M.size(); ++j) {
      const Wide factor = M[j][i] / M[i][i];
      for (std::size_t k = i; k < M.size(); ++k) M[j][k] -= factor * M[i][k];
    }
  }
  return true;
}

/// A double near the middle of each entry.
Eigen::MatrixXd rounded(const WideRows& M) {
  Eigen::MatrixXd middles(static_cast<Eigen::Index>(M.size()),
                          static_cast<Eigen::Index>(M.front().size()));
  for (std::size_t i = 0; i < M.size(); ++i) {
    for (std::size_t j = 0; j < M[i].size(); ++j) {
      middles(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          static_cast<double>((M[i][j].low + M[i][j].high) / 2);
    }
  }
  return middles;
}

/// The smallest singular value of the forces, up to kSlack/4; zero if that is not certain.
double smallest_singular_value(const WideRows& forces) {
  const Eigen::MatrixXd M = rounded(forces);
  if (M.cols() > M.rows()) return 0;
  const double sigma = Eigen::JacobiSVD<Eigen::MatrixXd>(M).singularValues().minCoeff();
  return is_above(transposed(forces) * forces, sigma * (1 - kSlack / 4)) ? sigma : 0;
}

/// The least force along the middle of a cone, up to kSlack/4; zero if that is not certain.
double least_along_middle(const WideRows& forces) {
  const Eigen::MatrixXd M = rounded(forces);
  const Eigen::VectorXd middle = M.rowwise().sum().normalized();
  const double least = (middle.transpose() * M).minCoeff();
  Wide square;
  for (const double x : middle) square += Wide(x) * Wide(x);
  for (std::size_t k = 0; k < forces.front().size(); ++k) {
    Wide along;
    for (std::size_t i = 0; i < forces.size(); ++i) {
      along += Wide(middle[static_cast<Eigen::Index>(i)]) * forces[i][k];
    }
    if (!(along.low >= least * (1 - kSlack / 4) * root_above(square.high))) return 0;
  }
  return least;
}

/// sigma of `ContactLimits`; zero if it is not known. A yaw turns the first two axes only.
double least_force(const Problem& problem) {
  const Robot& robot = problem.robot;
  const Contact& contact = *problem.contact;
  if (!is_free(robot, 0) || !is_free(robot, 1)) return 0;
  WideRows forces = transposed(to_wide(robot.mount.R)) *
                    (to_wide(contact.frame.R) * to_wide(contact.C.topRows<3>()));
  if (!is_free(robot, 2)) {
    if (contact.surface == Surface::kCircle) return 0;
    forces.pop_back();
  }
  const double sigma = smallest_singular_value(forces);
  if (contact.w_min.minCoeff() < 0) return sigma;
  return std::max(sigma, least_along_middle(forces));
}

}  // namespace

ContactLimits::ContactLimits(const Problem& problem)
    : w_min(problem.contact->w_min), w_max(problem.contact->w_max) {
  v_min = v_max = Eigen::VectorXd::Zero(w_min.size());
  if (w_min.allFinite() && w_max.allFinite()) return;
  const double sigma = least_force(problem);
  const double most = most_force(problem.robot) * (1 + kSlack) / sigma;
  if (!(sigma > 1e-6) || !(most < kInfinity)) {
    throw std::invalid_argument(problem.name +
                                ": got forces of a second contact without limits, expected "
                                "limits, or a base whose free axes bear each of them");
  }
  const double by_t = problem.c.head<3>().norm() / sigma;
  for (Eigen::Index k = 0; k < w_min.size(); ++k) {
    if (std::isfinite(w_min[k]) && std::isfinite(w_max[k])) continue;
    const double low = w_min[k] >= 0 ? 0 : -1, high = w_max[k] <= 0 ? 0 : 1;
    w_min[k] = low * most;
    w_max[k] = high * most;
    v_min[k] = low * by_t * (1 + kSlack);
    v_max[k] = high * by_t * (1 + kSlack);
  }
}

}  // namespace maxwrench
