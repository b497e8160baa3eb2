#include "verify/incumbent.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "verify/contact_limits.h"
#include "verify/equations.h"
#include "verify/gain.h"
#include "verify/list_value.h"
#include "verify/model.h"
#include "verify/value_proof.h"
#include "verify/weighted.h"

namespace maxwrench {
namespace {

constexpr double kIncumbentTolerance = 1e-8;

/// [m; 1] Tolerance of the equations. Near a stretched arm, joints with an error of its square root
/// satisfy them.
constexpr double kOffEquations = 1e-10;

/// Poses of all links relative to the base.
std::vector<Pose<double>> links_at(const Problem& problem, const PostureCoordinates& coordinates,
                                   const Eigen::VectorXd& x) {
  const Robot& robot = problem.robot;
  std::vector<double> q;
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    const int at = coordinates.of_joint[i];
    q.push_back(at < 0 ? rest_of(problem, i)
                       : x[coordinates.variables[static_cast<std::size_t>(at)].coordinate]);
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

/// Whether a base whose pose has a closed form is on its free axes.
bool base_gets_there(const Problem& problem, const FormModel& model, const Eigen::VectorXd& x,
                     const std::vector<Pose<double>>& links) {
  const Robot& robot = problem.robot;
  if (!model.coordinates().base_is_dependent || robot.base_axes.size() == 6) return true;
  const auto at = [&](const Form& form) {
    return BoxForms::at_point(model.shape(), FormRow(form, model.far()), x).low;
  };
  const FormVector place = model.pose_place();
  Pose<double> pose;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const auto row = static_cast<std::size_t>(i);
    pose.p[i] = at(place[row]);
    for (Eigen::Index j = 0; j < 3; ++j) {
      pose.R(i, j) = at(model.pose_turn()[row][static_cast<std::size_t>(j)]);
    }
  }
  const EndEffector& tip = robot.end_effectors[static_cast<std::size_t>(problem.end_effector)];
  const Pose<double> own = links[static_cast<std::size_t>(tip.link)] * tip.placement;
  const Pose<double> base = robot.mount.inverse() * (pose * own.inverse());
  Eigen::Vector3d p = base.p;
  bool turns = false;
  for (const int axis : robot.base_axes) {
    if (axis < 3) p[axis] = 0;
    turns = turns || axis == 5;
  }
  Eigen::Matrix3d upright = Eigen::Matrix3d::Identity();
  if (turns) upright.topLeftCorner<2, 2>() = base.R.topLeftCorner<2, 2>();
  const double tilt = (base.R - upright).cwiseAbs().maxCoeff();  // its sine, not its cosine
  return p.norm() <= kIncumbentTolerance && tilt <= kIncumbentTolerance;
}

/// The sum of some rows at x.
std::vector<Narrow> load(const FormModel& model, const Eigen::VectorXd& x,
                         const std::vector<std::vector<Form>>& parts) {
  std::vector<Narrow> sum;
  for (std::size_t i = 0; i < parts.front().size(); ++i) {
    Form row(model.shape());
    for (const std::vector<Form>& part : parts) row += part[i];
    sum.push_back(BoxForms::at_point(model.shape(), FormRow(row, model.far()), x));
  }
  return sum;
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

/// A value exists only if tau_d is in the ellipsoid. Then |W_u B^+ J'h| <= 2, so a small relative
/// error of the value changes the square by at most 4 times that error.
std::string reject_ellipsoid(const Problem& problem, const FormModel& model,
                             const ProofCertificate& proof, const std::vector<Narrow>& tau) {
  const Zonotope& set = problem.robot.actuation;
  const std::vector<Narrow> tau_d = load(model, proof.x, {model.tau_d()});
  if (!(square_of_effort(set, tau_d).low <= 1)) return "its posture has no value";
  return square_of_effort(set, tau).low <= 1 + 4 * kIncumbentTolerance
             ? ""
             : "its efforts are outside the ellipsoid";
}

/// The rows that are left where the force of a second contact follows from the base's linear axes:
/// tau + t a + A B_f u at x, with zeros in place of those axes, whose balance gives the force.
std::vector<Narrow> braced_load(const Problem& problem, const FormModel& model,
                                const ProofCertificate& proof) {
  const BracedRows rows = braced_rows(model, problem.c);
  const Zonotope& set = problem.robot.actuation;
  const auto at = [&](const Form& form) {
    return BoxForms::at_point(model.shape(), FormRow(form, model.far()), proof.x);
  };
  std::vector<Narrow> force(3);
  const auto thrusters = static_cast<Eigen::Index>(problem.robot.thrusters.size());
  for (std::size_t k = 0; k < 3; ++k) {
    for (Eigen::Index i = 0; i < thrusters; ++i) {
      force[k] += Narrow(set.B(static_cast<Eigen::Index>(k), i)) * Narrow(proof.u[i]);
    }
  }
  std::vector<Narrow> sum;
  for (std::size_t i = 0; i < rows.tau.size(); ++i) {
    sum.push_back(at(rows.tau[i]) + Narrow(proof.value) * at(rows.a[i]));
    for (std::size_t k = 0; k < 3; ++k) sum[i] += at(rows.levers[i][k]) * force[k];
  }
  return sum;
}

/// Empty, or why the shares of the posture are no forces of the second contact.
std::string reject_contact_forces(const Problem& problem, const ProofCertificate& proof,
                                  const Eigen::VectorXd& low, const Eigen::VectorXd& high,
                                  double tolerance) {
  const Contact& contact = *problem.contact;
  const Eigen::VectorXd w = low + proof.x.tail(low.size()).cwiseProduct(high - low);
  const bool within = ((contact.w_min - w).array() <= tolerance).all() &&
                      ((w - contact.w_max).array() <= tolerance).all();
  return within ? "" : "a force of the second contact is beyond its limits";
}

std::string reject_value(const Problem& problem, const FormModel& model,
                         const ProofCertificate& proof, double tolerance) {
  const Zonotope& set = problem.robot.actuation;
  const bool polytope = proof.measure == "linf_polytope";
  const Vector6d h = proof.wrench == Wrench::kPure ? Vector6d(proof.value * problem.c) : proof.h;
  const Eigen::MatrixXd& W = problem.W_any;
  if (!((h - W * (W.transpose() * h)).norm() <= tolerance)) return "its wrench is not allowed";
  if (!(std::abs(problem.c.dot(h) - proof.value) <= tolerance))
    return "its wrench has another value along c";
  if (proof.u.size() != set.actuators()) {
    return "the number of efforts differs from that of the actuators";
  }
  std::vector<std::vector<Form>> parts = {model.tau_d(), model.exerted(h)};
  if (model.coordinates().has_shares()) {
    const ContactLimits limits(problem);
    const Eigen::VectorXd low = limits.w_min + proof.value * limits.v_min;
    const Eigen::VectorXd high = limits.w_max + proof.value * limits.v_max;
    if (std::string why = reject_contact_forces(problem, proof, low, high, tolerance);
        !why.empty()) {
      return why;
    }
    parts.push_back(model.contact_load(low, high));
  }
  const bool braced = problem.contact_columns() > 0 && parts.size() == 2;
  const std::vector<Narrow> tau =
      braced ? braced_load(problem, model, proof) : load(model, proof.x, parts);
  if (polytope) return reject_balance(set.B, set, proof.u, tau, tolerance);
  if (proof.measure == "ellipsoid") return reject_ellipsoid(problem, model, proof, tau);
  const std::vector<Wide> u = efforts(enclose_pseudoinverse(set.B), tau);
  for (std::size_t k = 0; k < u.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(k);
    if (!(u[k].low >= set.u_min[at] - tolerance && u[k].high <= set.u_max[at] + tolerance)) {
      return "an effort is beyond its limits";
    }
  }
  return "";
}

bool is_within(const PostureCoordinates& coordinates, const Eigen::VectorXd& x) {
  return std::all_of(coordinates.variables.begin(), coordinates.variables.end(),
                     [&x](const PostureCoordinates::Variable& each) {
                       return x[each.coordinate] >= each.lower - kLimitTolerance &&
                              x[each.coordinate] <= each.upper + kLimitTolerance;
                     });
}

}  // namespace

std::string reject_balance(const Eigen::MatrixXd& B, const Zonotope& limits,
                           const Eigen::VectorXd& u, const std::vector<Narrow>& tau,
                           double tolerance) {
  if (u.size() != B.cols()) return "the number of efforts differs from that of the actuators";
  if (!((limits.u_min - u).array() <= tolerance).all() ||
      !((u - limits.u_max).array() <= tolerance).all()) {
    return "an effort is beyond its limits";
  }
  for (Eigen::Index i = 0; i < B.rows(); ++i) {
    Narrow left = tau[static_cast<std::size_t>(i)];
    for (Eigen::Index k = 0; k < B.cols(); ++k) left -= Narrow(B(i, k)) * Narrow(u[k]);
    if (!(left.magnitude() <= tolerance)) return "its efforts do not balance";
  }
  return "";
}

CoordinateChoice posture_coordinates(const Problem& problem, const ProofCertificate& proof) {
  CoordinateChoice choice;
  if (problem.contact_columns() == 0) return choice;
  choice.contact_shares = proof.measure != "linf_polytope" || !forces_follow_from_base(problem) ||
                          proof.x.size() != PostureCoordinates(problem).count();
  return choice;
}

std::string reject_incumbent(const Problem& problem, const FormModel& model,
                             const Equations& equations, const ProofCertificate& proof) {
  const Eigen::VectorXd& x = proof.x;
  if (x.size() != model.coordinates().count()) return "its posture has other joints";
  if (!x.allFinite() || !proof.u.allFinite() || !proof.h.allFinite()) {
    return "its posture is not finite";
  }
  if (!is_within(model.coordinates(), x)) return "its posture is beyond the limits";
  if (!(equations.residual(x) <= kOffEquations)) return "its joints do not reach the pose";
  const std::vector<Pose<double>> links = links_at(problem, model.coordinates(), x);
  if (!base_gets_there(problem, model, x, links)) return "its base is off its free axes";
  if (problem.contact &&
      !(contact_gain(problem, links) >= problem.contact->sigma_min * (1 - kIncumbentTolerance))) {
    return "its posture is singular";
  }
  if (problem.robot.collision && problem.robot.collision->collides(links)) {
    return "its posture collides";
  }
  const double tolerance = kIncumbentTolerance * (1 + std::abs(proof.value));
  return problem.scenarios.empty() ? reject_value(problem, model, proof, tolerance)
                                   : reject_list_value(problem, model, proof, tolerance);
}

}  // namespace maxwrench
