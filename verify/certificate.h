#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "maxwrench/problem.h"

namespace maxwrench {

/// A proof of how large a capability can be: a tree of boxes of a posture's coordinates x, as in
/// `PostureCoordinates`, each with the reason why no value in it is larger, if there is one yet.
struct CertificateTree {
  enum class Reason : std::uint8_t {
    kNone,
    kMultiplier,  ///< of the measure's program and the equations, [lambda; nu]
    kCollision,
    kNoPosture  ///< nu of the equations: nu'f > 0
  };
  struct Node {
    Reason reason = Reason::kNone;
    int axis = -1;  ///< cut in two along this one; its halves follow. -1: a leaf
    std::optional<double> at = std::nullopt;  ///< where it is cut, unless at its middle
    int pair = -1;                            ///< that collides
    std::size_t multiplier = 0;               ///< where it begins among `multipliers`
  };
  /// How many numbers of `multipliers` a node has.
  std::size_t numbers(const Node& node) const {
    if (node.reason == Reason::kNoPosture) return static_cast<std::size_t>(equations);
    return node.reason == Reason::kMultiplier ? static_cast<std::size_t>(width) : 0;
  }
  int width = 0;      ///< numbers of a multiplier
  int equations = 0;  ///< numbers of a nu, if there is one
  std::vector<double> multipliers;
  std::vector<Node> nodes;  ///< a node, then its lower half, then its upper half
};

struct ProofCertificate {
  std::string version;  ///< of maxwrench, that wrote it
  std::string problem;  ///< as it was named on the command line
  std::string measure;
  Wrench wrench = Wrench::kPure;
  bool collision = true;     ///< postures that collide do not count
  std::uint64_t digest = 0;  ///< of the robot and the task
  double bound = 0;          ///< [N or N m] no posture has more
  double gap = 0;            ///< bound <= value + gap |value|
  // A posture, its value, and for the L-infinity polytope the efforts and the wrench (world axes)
  // with which it is reached.
  Eigen::VectorXd x;
  double value = 0;
  Eigen::VectorXd u;
  Vector6d h = Vector6d::Zero();
  Eigen::VectorXd lower, upper;  ///< the box of the first node
  CertificateTree tree;
};

/// All numbers of robot and task that a proof rests upon, as one number (FNV-1a).
std::uint64_t digest(const Problem& problem);

/// A file: "maxwrench proof 2\n", the CRC-32 of all that follows, the length of the certificate,
/// and that, packed by zlib; little endian.
std::string certificate_text(const ProofCertificate& certificate);

/// Throws std::invalid_argument with one line that names the file for what is no certificate, or a
/// damaged one. What it claims is not looked at.
ProofCertificate read_certificate(const std::string& file);

}  // namespace maxwrench
