#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "maxwrench/problem.h"

namespace maxwrench {

/// A proof of an upper bound of a capability: a tree of boxes of a posture's coordinates x, as in
/// `PostureCoordinates`. A box may have a reason why no value in it exceeds the bound.
struct CertificateTree {
  enum class Reason : std::uint8_t {
    kNone,
    kMultiplier,  ///< of the measure's program and the equations, [lambda; nu]; of a list of
                  ///< scenarios, parts for some of them, and nu
    kCollision,
    kNoPosture  ///< nu of the equations: nu'f > 0
  };
  struct Node {
    Reason reason = Reason::kNone;
    int axis = -1;                            ///< of the cut; its two halves follow. -1: a leaf
    std::optional<double> at = std::nullopt;  ///< position of the cut, unless it is at the middle
    int pair = -1;                            ///< index of the colliding pair
    std::size_t parts = 1;                    ///< of the multiplier
    std::size_t multiplier = 0;               ///< index of its first number in `multipliers`
  };
  /// The number of entries of `multipliers` that a node has.
  std::size_t numbers(const Node& node) const {
    if (node.reason == Reason::kNoPosture) return static_cast<std::size_t>(equations);
    if (node.reason != Reason::kMultiplier) return 0;
    return node.parts * static_cast<std::size_t>(width) + static_cast<std::size_t>(shared);
  }
  bool of_list = false;  ///< of a list of scenarios: a multiplier has any number of parts
  int width = 0;         ///< number of entries of a multiplier, or of each of its parts
  int shared = 0;        ///< number of further entries of a multiplier, which its parts share
  int equations = 0;     ///< number of entries of a nu, if there is one
  std::vector<double> multipliers;
  std::vector<Node> nodes;  ///< in the order: a node, its lower half, its upper half
};

struct ProofCertificate {
  std::string version;  ///< version of maxwrench that wrote it
  std::string problem;  ///< name of the problem on the command line
  std::string measure;
  Wrench wrench = Wrench::kPure;
  bool collision = true;  ///< postures that collide are excluded
  /// The boxes leave out the joint about the base's yaw, see `joint_about_yaw`.
  bool without_yaw_joint = false;
  std::uint64_t digest = 0;  ///< of the robot and the task
  double bound = 0;          ///< [N or N m] no posture exceeds it
  double gap = 0;            ///< bound <= value + gap |value|
  // A posture and its value. For the L-infinity polytope also the efforts and the wrench (world
  // axes) that attain it.
  Eigen::VectorXd x;
  double value = 0;
  Eigen::VectorXd u;
  Vector6d h = Vector6d::Zero();
  /// Of a list, the scenario that decides: [wrench, limits, case of each load, z of the ball].
  std::vector<double> decides = {};
  Eigen::VectorXd lower, upper;  ///< the box of the first node
  CertificateTree tree;
};

/// A hash (FNV-1a) of all numbers of robot and task on which a proof depends.
std::uint64_t digest(const Problem& problem);

/// The contents of a certificate file: "maxwrench proof 2\n", or 3 of a list of scenarios, the
/// CRC-32 of everything after it, the length of the certificate, and the certificate packed by
/// zlib; little endian.
std::string certificate_text(const ProofCertificate& certificate);

/// Throws std::invalid_argument, in one line with the name of the file, if the file is damaged or
/// is not a certificate. Does not check the claims of the certificate.
ProofCertificate read_certificate(const std::string& file);

}  // namespace maxwrench
