#include "verify/trajectory/trajectory_certificate.h"

#include <stdexcept>
#include <string_view>

#include "verify/bytes.h"
#include "verify/certificate.h"
#include "verify/sealed.h"

namespace maxwrench {
namespace {

constexpr std::string_view kTrajectoryMagic = "maxwrench trajectory proof 1\n";
constexpr std::string_view kTrajectoryListMagic = "maxwrench trajectory proof 2\n";
constexpr std::string_view kDependentMagic = "maxwrench trajectory proof 3\n";

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
}

void put_claim(ByteWriter& raw, const TrajectoryCertificate& proof) {
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
}

/// Reads what `put_claim` wrote. False if the numbers cannot be those of a certificate.
bool get_claim(ByteReader& from, TrajectoryCertificate& proof) {
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
  put_claim(raw, proof);
  if (proof.dependent.size() == 0) return seal(kTrajectoryMagic, raw.text());
  raw.matrix(proof.dependent);
  return seal(kDependentMagic, raw.text());
}

std::string certificate_text(const std::vector<TrajectoryCertificate>& scenarios) {
  ByteWriter raw;
  raw.count(static_cast<Eigen::Index>(scenarios.size()));
  for (const TrajectoryCertificate& each : scenarios) put_claim(raw, each);
  return seal(kTrajectoryListMagic, raw.text());
}

bool is_trajectory_certificate(const std::string& file) {
  return begins_with(file, kTrajectoryMagic) || begins_with(file, kTrajectoryListMagic) ||
         begins_with(file, kDependentMagic);
}

std::vector<TrajectoryCertificate> read_trajectory_certificates(const std::string& file) {
  const bool list = begins_with(file, kTrajectoryListMagic);
  const bool depends = begins_with(file, kDependentMagic);
  const std::string raw = unseal(file, list      ? kTrajectoryListMagic
                                       : depends ? kDependentMagic
                                                 : kTrajectoryMagic);
  ByteReader from(raw);
  constexpr std::size_t kLeastBytes = 64;  // of a certificate
  const std::size_t count = list ? from.count(kLeastBytes) : 1;
  std::vector<TrajectoryCertificate> all;
  bool good = count > 0;
  while (good && all.size() < count) good = get_claim(from, all.emplace_back());
  if (good && depends) {
    all.back().dependent = from.matrix();
    good = from.good();
  }
  if (!good || !from.at_end()) {
    throw std::invalid_argument(file + ": got a damaged file, expected a whole certificate");
  }
  return all;
}

}  // namespace maxwrench
