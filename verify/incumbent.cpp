#include "verify/incumbent.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "verify/box_forms.h"
#include "verify/weighted.h"

namespace maxwrench {
namespace {

constexpr double kIncumbentTolerance = 1e-8;

/// Poses of all links relative to the base.
std::vector<Pose<double>> links_at(const Problem& problem, const Eigen::VectorXd& theta_r) {
  const Robot& robot = problem.robot;
  std::vector<double> q;
  for (const Joint& joint : robot.joints) q.push_back(std::clamp(0.0, joint.q_min, joint.q_max));
  for (std::size_t i = 0; i < problem.redundant.size(); ++i) {
    q[static_cast<std::size_t>(problem.redundant[i])] = theta_r[static_cast<Eigen::Index>(i)];
  }
  std::vector<Pose<double>> links(1);
  for (std::size_t i = 0; i < q.size(); ++i) {
    const Joint& joint = robot.joints[i];
    Pose<double> motion;
    if (joint.type == JointType::kRevolute) {
      motion.R = Eigen::AngleAxisd(q[i], joint.axis).toRotationMatrix();
    } else {
      motion.p = joint.axis * q[i];
    }
    links.push_back(links[static_cast<std::size_t>(joint.parent)] * joint.placement * motion);
  }
  return links;
}

/// tau_d + J'h at theta_r.
std::vector<Narrow> load(const FormModel& model, const Eigen::VectorXd& theta_r,
                         const Vector6d& h) {
  const std::vector<Form> tau_d = model.tau_d(), exerted = model.exerted(h);
  std::vector<Narrow> sum;
  for (std::size_t i = 0; i < tau_d.size(); ++i) {
    sum.push_back(
        BoxForms::at_point(model.shape(), FormRow(tau_d[i] + exerted[i], model.far()), theta_r));
  }
  return sum;
}

std::string refuse_balance(const Problem& problem, const ProofCertificate& proof,
                           const std::vector<Narrow>& tau, double tolerance) {
  const Zonotope& set = problem.robot.actuation;
  if (proof.u.size() != set.actuators()) return "the efforts are not as many as the actuators";
  if (!((set.u_min - proof.u).array() <= tolerance).all() ||
      !((proof.u - set.u_max).array() <= tolerance).all()) {
    return "an effort is beyond its limits";
  }
  for (Eigen::Index i = 0; i < set.dimension(); ++i) {
    Narrow left = tau[static_cast<std::size_t>(i)];
    for (Eigen::Index k = 0; k < set.actuators(); ++k) {
      left -= Narrow(set.B(i, k)) * Narrow(proof.u[k]);
    }
    if (!(left.magnitude() <= tolerance)) return "its efforts do not balance";
  }
  return "";
}

/// B^+ tau, or W_u B^+ tau, at the incumbent.
std::vector<Wide> efforts(const WideRows& K, const std::vector<Narrow>& tau) {
  std::vector<Wide> u(K.size());
  for (std::size_t k = 0; k < K.size(); ++k) {
    for (std::size_t i = 0; i < tau.size(); ++i) u[k] += K[k][i] * wide(tau[i]);
  }
  return u;
}

/// |W_u B^+ tau|^2
Wide square_of_effort(const Zonotope& set, const std::vector<Narrow>& tau) {
  Wide square;
  for (const Wide& x : efforts(weighted_pseudoinverse(set), tau)) square += x * x;
  return square;
}

/// There is a value only where the ellipsoid holds tau_d. Then |W_u B^+ J'h| <= 2, so that a value
/// that is off by a small share takes the square off by at most 4 times that share.
std::string refuse_ellipsoid(const Problem& problem, const FormModel& model,
                             const ProofCertificate& proof, const std::vector<Narrow>& tau) {
  const Zonotope& set = problem.robot.actuation;
  const std::vector<Narrow> tau_d = load(model, proof.theta_r, Vector6d::Zero());
  if (!(square_of_effort(set, tau_d).low <= 1)) return "its posture has no value";
  return square_of_effort(set, tau).low <= 1 + 4 * kIncumbentTolerance
             ? ""
             : "its efforts are outside the ellipsoid";
}

std::string refuse_value(const Problem& problem, const FormModel& model,
                         const ProofCertificate& proof, double tolerance) {
  const Zonotope& set = problem.robot.actuation;
  const bool polytope = proof.measure == "linf_polytope";
  const Vector6d h = proof.wrench == Wrench::kPure ? Vector6d(proof.value * problem.c) : proof.h;
  const Eigen::MatrixXd& W = problem.W_any;
  if (!((h - W * (W.transpose() * h)).norm() <= tolerance)) return "its wrench is not allowed";
  if (!(std::abs(problem.c.dot(h) - proof.value) <= tolerance)) return "its wrench is another one";
  const std::vector<Narrow> tau = load(model, proof.theta_r, h);
  if (polytope) return refuse_balance(problem, proof, tau, tolerance);
  if (proof.measure == "ellipsoid") return refuse_ellipsoid(problem, model, proof, tau);
  const std::vector<Wide> u = efforts(enclose_pseudoinverse(set.B), tau);
  for (std::size_t k = 0; k < u.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(k);
    if (!(u[k].low >= set.u_min[at] - tolerance && u[k].high <= set.u_max[at] + tolerance)) {
      return "an effort is beyond its limits";
    }
  }
  return "";
}

}  // namespace

std::string refuse_incumbent(const Problem& problem, const FormModel& model,
                             const ProofCertificate& proof) {
  const Eigen::VectorXd& theta_r = proof.theta_r;
  if (theta_r.size() != problem.theta_r_min.size()) return "its posture has other joints";
  if (!theta_r.allFinite() || !proof.u.allFinite() || !proof.h.allFinite()) {
    return "its posture is no number";
  }
  if (!((problem.theta_r_min - theta_r).array() <= kLimitTolerance).all() ||
      !((theta_r - problem.theta_r_max).array() <= kLimitTolerance).all()) {
    return "its posture is beyond the limits";
  }
  if (problem.robot.collision && problem.robot.collision->collides(links_at(problem, theta_r))) {
    return "its posture collides";
  }
  return refuse_value(problem, model, proof, kIncumbentTolerance * (1 + std::abs(proof.value)));
}

}  // namespace maxwrench
