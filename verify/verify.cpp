#include "verify/verify.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <optional>
#include <thread>

#include "maxwrench/interruption.h"
#include "verify/collision_proof.h"
#include "verify/equations.h"
#include "verify/incumbent.h"
#include "verify/value_proof.h"

namespace maxwrench {
namespace {

using Node = CertificateTree::Node;
using Reason = CertificateTree::Reason;

/// Larger numbers are rejected, so that no product of them overflows.
constexpr double kLargest = 1e60;

/// [rad or m] The largest width of the first box.
constexpr double kWidest = 1e6;

/// Slightly more than a whole turn.
constexpr double kWholeTurn = 6.2831853071795872;

/// The largest number of cuts above a box. Halving needs far fewer, but parts without postures are
/// cut off in slices.
constexpr int kDeepest = 100'000;

/// A node of the tree, its box, and a number that no value in its parent's box exceeds.
struct OpenBox {
  std::size_t node = 0;
  Eigen::VectorXd lower, upper;
  double high = kInfinity;
  int depth = 0;
};

/// Empty, or the reason why the nodes do not form a tree of boxes: each cut node must be followed
/// by its two halves.
std::string reject_shape(const CertificateTree& tree, Eigen::Index axes, const ValueProof& value,
                         int equations) {
  std::size_t open = 1;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    if (open == 0) return "boxes without a parent";
    if (tree.nodes[i].axis >= axes) return "a box is cut along no joint";
    if (const std::size_t numbers = tree.numbers(tree.nodes[i]);
        numbers > 0 && tree.nodes[i].multiplier + numbers > tree.multipliers.size()) {
      return "multipliers of another length";
    }
    if (tree.nodes[i].reason == Reason::kMultiplier &&
        (tree.width != value.width() || tree.shared != value.shared() ||
         (!tree.of_list && tree.nodes[i].parts != 1))) {
      return "multipliers of another length";
    }
    if (tree.nodes[i].reason == Reason::kNoPosture && tree.equations != equations) {
      return "multipliers of other equations";
    }
    open += tree.nodes[i].axis < 0 ? std::size_t(-1) : 1;
  }
  for (const double x : tree.multipliers) {
    if (!(std::abs(x) <= kLargest)) return "a multiplier is not a number or is too large";
  }
  return open == 0 ? "" : "boxes are missing";
}

/// The index of each node's upper half, which comes after all of its lower half.
std::vector<std::size_t> upper_halves(const CertificateTree& tree) {
  std::vector<std::size_t> size(tree.nodes.size(), 1), second(tree.nodes.size(), 0);
  for (std::size_t i = tree.nodes.size(); i-- > 0;) {
    if (tree.nodes[i].axis < 0) continue;
    second[i] = i + 1 + size[i + 1];
    size[i] += size[i + 1] + size[second[i]];
  }
  return second;
}

/// Walks through parts of the tree. The proof is by induction: no value in a node's box exceeds
/// max(bound, high), where `high` was proven for its parent's box, which contains it (at the root:
/// the ceiling of all postures). With t in [bound, high] the node's own multiplier then proves
/// max(bound, high') with high' <= high, for its halves. A collision, or nu'f > 0, proves that
/// there is no value. The walk takes nothing from the file on trust, neither that a multiplier is
/// valid nor what it proved. A leaf needs high' <= bound. The two halves of a box are cut at the
/// same number, so they cover it.
class TreeWalk {
 public:
  /// `posture`: the model with all coordinates.
  TreeWalk(const Problem& problem, const FormModel& posture, const Equations& equations,
           const ProofCertificate& proof, const std::vector<std::size_t>& second,
           std::unique_ptr<ValueProof> value)
      : proof_(proof),
        second_(second),
        value_(std::move(value)),
        collision_(problem, posture),
        off_postures_(equations) {}

  /// Checks all boxes below a node; stops where the proof fails.
  void walk(OpenBox top) {
    std::vector<OpenBox> open;
    open.push_back(std::move(top));
    while (!open.empty() && done.rejection.empty() && !is_interrupted()) {
      OpenBox box = std::move(open.back());
      open.pop_back();
      if (check(box)) push_halves(box, open);
    }
  }

  /// Checks a node and updates `box.high` with what it proves. True if the box is cut.
  bool check(OpenBox& box) {
    const Node& node = tree().nodes[box.node];
    ++done.boxes;
    const double before = box.high;
    if (node.reason == Reason::kCollision) {
      if (!collision_.collides(box.lower, box.upper, node.pair)) {
        return reject(box, what_is_open(box, node));  // such boxes are not cut
      }
      box.high = -kInfinity;
    } else if (node.reason == Reason::kNoPosture) {
      if (off_postures_.set(box.lower, box.upper) && off_postures_.excluded(multiplier(node))) {
        box.high = -kInfinity;
      }
    } else if (node.reason == Reason::kMultiplier) {
      box.high =
          value_->most(box.lower, box.upper, multiplier(node), node.parts, proof_.bound, before);
    }
    if (node.axis >= 0) return is_cut(box, node);
    if (!(box.high <= proof_.bound)) return reject(box, what_is_open(box, node));
    count(node, before <= proof_.bound);
    return false;
  }

  void push_halves(const OpenBox& box, std::vector<OpenBox>& open) const {
    const Node& node = tree().nodes[box.node];
    const int axis = node.axis;
    const double middle = place_of_cut(box, node);
    OpenBox half = box;
    ++half.depth;
    half.node = second_[box.node];
    half.lower[axis] = middle;
    open.push_back(half);
    half.lower[axis] = box.lower[axis];
    half.upper[axis] = middle;
    half.node = box.node + 1;
    open.push_back(std::move(half));
  }

  Verification done;
  std::size_t failed = std::size_t(-1);  ///< the node where the proof failed

 private:
  const CertificateTree& tree() const { return proof_.tree; }
  const double* multiplier(const Node& node) const {
    return tree().multipliers.data() + node.multiplier;
  }

  bool is_cut(const OpenBox& box, const Node& node) {
    const double at = place_of_cut(box, node);
    if (!(box.lower[node.axis] < at && at < box.upper[node.axis])) {
      return reject(box, "is too narrow to be cut");
    }
    return box.depth < kDeepest || reject(box, "is too deep in the tree");
  }

  static double place_of_cut(const OpenBox& box, const Node& node) {
    return node.at ? *node.at : (box.lower[node.axis] + box.upper[node.axis]) / 2;
  }

  static std::string what_is_open(const OpenBox& box, const Node& node) {
    if (node.reason == Reason::kCollision) return "does not collide throughout";
    if (node.reason == Reason::kNoPosture) return "may have postures";
    return "values up to " + std::to_string(box.high) + " are not excluded";
  }

  void count(const Node& leaf, bool by_parent) {
    if (by_parent) {
      ++done.by_parent;
    } else if (leaf.reason == Reason::kCollision) {
      ++done.by_collision;
    } else if (leaf.reason == Reason::kNoPosture) {
      ++done.by_equations;
    } else {
      ++done.by_multiplier;
    }
  }

  bool reject(const OpenBox& box, const std::string& why) {
    failed = box.node;
    done.rejection = "box " + std::to_string(box.node) + ": " + why;
    return false;
  }

  const ProofCertificate& proof_;
  const std::vector<std::size_t>& second_;
  std::unique_ptr<ValueProof> value_;
  CollisionProof collision_;
  EquationsOverBox off_postures_;
};

void add(const TreeWalk& part, Verification& sum, std::size_t& failed) {
  sum.boxes += part.done.boxes;
  sum.by_multiplier += part.done.by_multiplier;
  sum.by_collision += part.done.by_collision;
  sum.by_equations += part.done.by_equations;
  sum.by_parent += part.done.by_parent;
  if (part.failed >= failed) return;
  failed = part.failed;
  sum.rejection = part.done.rejection;
}

/// Whether the first box contains every posture within the limits, possibly after whole turns of a
/// joint.
bool holds_all(const PostureCoordinates& coordinates, const ProofCertificate& proof) {
  return std::all_of(
      coordinates.variables.begin(), coordinates.variables.end(),
      [&proof](const PostureCoordinates::Variable& each) {
        const double lower = proof.lower[each.coordinate];
        const double upper = proof.upper[each.coordinate];
        return (lower <= each.lower - kLimitTolerance && upper >= each.upper + kLimitTolerance) ||
               (each.turns && upper - lower >= kWholeTurn);
      });
}

bool leaves_out_too_much(const Problem& problem, const ProofCertificate& proof) {
  if (!proof.without_yaw_joint) return false;
  return proof.measure != "linf_polytope" || proof.wrench != Wrench::kPure ||
         !problem.scenarios.empty() || joint_about_yaw(problem) < 0;
}

/// Checks the claims that do not depend on the boxes.
std::string reject_claims(const Problem& problem, const FormModel& model,
                          const Equations& equations, const ProofCertificate& proof) {
  if (proof.digest != digest(problem)) return "it is for another robot or task";
  if (leaves_out_too_much(problem, proof)) {
    return "it leaves out a joint that the base cannot replace";
  }
  if (proof.tree.of_list != !problem.scenarios.empty()) return "it is for another kind of task";
  if (proof.collision != (problem.robot.collision != nullptr)) {
    return "it treats postures that collide differently";
  }
  const int n = model.coordinates().count();
  if (proof.lower.size() != n || proof.upper.size() != n) return "its box has other joints";
  if (!proof.lower.allFinite() || !proof.upper.allFinite() ||
      !holds_all(model.coordinates(), proof)) {
    return "its box does not contain the limits";
  }
  if (!((proof.upper - proof.lower).array() <= kWidest).all()) return "its box is too wide";
  for (const double x : {proof.bound, proof.gap, proof.value, proof.h.lpNorm<Eigen::Infinity>()}) {
    if (!(std::abs(x) <= kLargest)) return "its claim is not a number or is too large";
  }
  if (!(proof.bound >= proof.value)) return "its bound is below its value";
  const double slack = 1e-9 * std::abs(proof.value);
  if (!(proof.bound <= proof.value + proof.gap * std::abs(proof.value) + slack)) {
    return "its gap is larger than it claims";
  }
  return reject_incumbent(problem, model, equations, proof);
}

/// Checks the first boxes one by one, until there are enough for all threads.
std::vector<OpenBox> first_boxes(TreeWalk& walk, OpenBox root) {
  constexpr std::size_t kEnough = 256;
  std::vector<OpenBox> open;
  open.push_back(std::move(root));
  std::size_t next = 0;
  for (; next < open.size() && open.size() - next < kEnough && walk.done.rejection.empty();
       ++next) {
    end_if_interrupted();
    OpenBox box = open[next];
    if (walk.check(box)) walk.push_halves(box, open);
  }
  open.erase(open.begin(), open.begin() + static_cast<std::ptrdiff_t>(next));
  return open;
}

}  // namespace

Verification verify(const Problem& problem, const ProofCertificate& proof, int threads) {
  const FormModel posture(problem, posture_coordinates(problem, proof));
  const Equations all(problem, posture);
  std::optional<FormModel> without;
  std::optional<Equations> fewer;
  if (proof.without_yaw_joint && !leaves_out_too_much(problem, proof)) {
    without.emplace(problem, CoordinateChoice{joint_about_yaw(problem)});
    fewer.emplace(problem, *without);
  }
  const FormModel& model = without ? *without : posture;
  const Equations& equations = fewer ? *fewer : all;
  const auto value = make_value_proof(problem, model, equations, proof.measure, proof.wrench);
  Verification result;
  result.ceiling = value->ceiling();
  result.rejection = reject_claims(problem, posture, all, proof);
  if (result.rejection.empty()) {
    result.rejection = reject_shape(proof.tree, proof.lower.size(), *value, equations.count());
  }
  if (!result.rejection.empty()) return result;
  const std::vector<std::size_t> second = upper_halves(proof.tree);
  TreeWalk first(problem, posture, equations, proof, second, value->clone());
  const std::vector<OpenBox> open =
      first_boxes(first, {0, proof.lower, proof.upper, result.ceiling});
  std::size_t failed = std::size_t(-1);
  add(first, result, failed);
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  const auto work = [&, flag = Interruption::flag()] {
    const Interruption interruption(flag);
    TreeWalk walk(problem, posture, equations, proof, second, value->clone());
    for (std::size_t i = next++; i < open.size() && !is_interrupted(); i = next++) {
      walk.walk(open[i]);
      const std::lock_guard<std::mutex> guard(mutex);
      add(walk, result, failed);
      walk.done = {};
      walk.failed = std::size_t(-1);
    }
  };
  std::vector<std::thread> others;
  for (int i = 1; i < threads; ++i) others.emplace_back(work);
  work();
  for (std::thread& each : others) each.join();
  end_if_interrupted();
  return result;
}

}  // namespace maxwrench
