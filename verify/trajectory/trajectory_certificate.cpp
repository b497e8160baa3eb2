#include "verify/trajectory/trajectory_certificate.h"

#include <stdexcept>
#include <string_view>

#include "verify/bytes.h"
#include "verify/certificate.h"
#include "verify/sealed.h"

namespace maxwrench {
namespace {

/// How a certificate begins, and what it has.
struct Kind {
  std::string_view magic;
  bool list, depends;  ///< several scenarios; dependent joints
};
constexpr Kind kKinds[] = {{"maxwrench trajectory proof 1\n", false, false},
                           {"maxwrench trajectory proof 2\n", true, false},
                           {"maxwrench trajectory proof 3\n", false, true},
                           {"maxwrench trajectory proof 4\n", true, true}};

std::string_view magic_of(bool list, bool depends) {
  return kKinds[(list ? 1 : 0) + (depends ? 2 : 0)].magic;
}

/// Null if the file is no certificate of a trajectory.
const Kind* find_kind(const std::string& file) {
  for (const Kind& kind : kKinds) {
    if (begins_with(file, kind.magic)) return &kind;
  }
  return nullptr;
}

void put_dynamics(ByteWriter& to, const Robot& robot) {
  for (const Link& link : robot.links) {
    to.matrix(link.inertia);
    to.count(static_cast<Eigen::Index>(link.hydrodynamics.size()));
    for (const HydrodynamicBody& body : link.hydrodynamics) {
      to.matrix(body.frame.R);
      to.matrix(body.frame.p);
      to.matrix(body.added_mass);
      to.matrix(body.damping_linear);
      to.matrix(body.damping_quadratic);
    }
  }
  for (const Joint& joint : robot.joints) {
    to.real(joint.velocity_max);
    if (!joint.gear) continue;
    to.count(joint.gear->leader);
    to.real(joint.gear->ratio);
    to.real(joint.gear->offset);
  }
  to.matrix(robot.u_rate_max);
  if (!robot.current.isZero(0)) to.matrix(robot.current);
}

void put_motion(ByteWriter& to, const MotionTask& task) {
  to.whole((task.impulse ? 1 : 0) + (task.rates ? 2 : 0) + (task.c_turns ? 4 : 0), 1);
  to.real(task.T);
  to.count(task.k);
  to.count(task.t_h);
  to.whole(static_cast<std::uint64_t>(task.start), 1);
  to.matrix(task.theta_0);
  const ScrewPath path = task.path.as_screw().value_or(ScrewPath());
  to.matrix(path.start.R);
  to.matrix(path.start.p);
  to.matrix(path.axis);
  to.matrix(path.centre);
  to.matrix(path.displacement);
  to.real(path.angle);
  to.whole(static_cast<std::uint64_t>(path.timing), 1);
  if (task.thruster_lag > 0) to.real(task.thruster_lag);
}

void put_claim(ByteWriter& raw, const TrajectoryCertificate& proof, bool depends) {
  raw.words(proof.version);
  raw.words(proof.problem);
  raw.whole(proof.collision ? 1 : 0, 1);
  raw.whole(proof.digest, 8);
  raw.real(proof.value);
  raw.count(proof.t_h);
  raw.matrix(proof.knots);
  raw.count(proof.parts);
  raw.matrix(proof.y);
  raw.matrix(proof.w);
  if (depends) raw.matrix(proof.dependent);
}

/// Reads what `put_claim` wrote. False if the numbers cannot be those of a certificate.
bool get_claim(ByteReader& from, bool depends, TrajectoryCertificate& proof) {
  proof.version = from.words();
  proof.problem = from.words();
  proof.collision = from.whole(1) == 1;
  proof.digest = from.whole(8);
  proof.value = from.real();
  constexpr std::uint64_t kMost = 1U << 24U;
  const std::uint64_t t_h = from.whole(8);
  proof.knots = from.matrix();
  const std::uint64_t parts = from.whole(8);
  proof.y = from.matrix();
  const Eigen::MatrixXd w = from.matrix();
  if (depends) proof.dependent = from.matrix();
  const bool plain = fits_in_a_line(proof.version) && fits_in_a_line(proof.problem);
  if (!from.good() || !plain || t_h > kMost || parts > kMost || (w.size() > 0 && w.cols() != 1)) {
    return false;
  }
  proof.t_h = static_cast<int>(t_h);
  proof.parts = static_cast<int>(parts);
  if (w.size() > 0) proof.w = w.col(0);
  return true;
}

}  // namespace

std::uint64_t motion_digest(const Problem& problem) {
  ByteWriter all;
  all.whole(digest(problem), 8);
  put_dynamics(all, problem.robot);
  if (problem.motion) put_motion(all, *problem.motion);
  return digest_of(all.text());
}

std::string certificate_text(const TrajectoryCertificate& proof) {
  ByteWriter raw;
  const bool depends = proof.dependent.size() > 0;
  put_claim(raw, proof, depends);
  return seal(magic_of(false, depends), raw.text());
}

std::string certificate_text(const std::vector<TrajectoryCertificate>& scenarios) {
  ByteWriter raw;
  raw.count(static_cast<Eigen::Index>(scenarios.size()));
  const bool depends = !scenarios.empty() && scenarios.front().dependent.size() > 0;
  for (const TrajectoryCertificate& each : scenarios) put_claim(raw, each, depends);
  return seal(magic_of(true, depends), raw.text());
}

bool is_trajectory_certificate(const std::string& file) { return find_kind(file) != nullptr; }

std::vector<TrajectoryCertificate> read_trajectory_certificates(const std::string& file) {
  const Kind* const found = find_kind(file);
  const auto [magic, list, depends] = found ? *found : kKinds[0];
  const std::string raw = unseal(file, magic);
  ByteReader from(raw);
  constexpr std::size_t kLeastBytes = 64;  // of a certificate
  const std::size_t count = list ? from.count(kLeastBytes) : 1;
  std::vector<TrajectoryCertificate> all;
  bool good = count > 0;
  while (good && all.size() < count) good = get_claim(from, depends, all.emplace_back());
  if (!good || !from.at_end()) {
    throw std::invalid_argument(file + ": got a damaged file, expected a whole certificate");
  }
  return all;
}

}  // namespace maxwrench
