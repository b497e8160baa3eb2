#include "verify/trajectory/motion_clearance.h"

#include <algorithm>
#include <cstdio>

#include "maxwrench/interruption.h"

namespace maxwrench {
namespace {

/// An interval between knots is cut in halves this often at most, and this many times in all.
constexpr int kMostTimeCuts = 30;
constexpr long kMostPlaces = 2'000'000;

/// [m] Rounding of the distances, which are computed in ordinary arithmetic. Axes of capsules that
/// are nearly parallel have the largest.
constexpr double kDistanceRounding = 1e-9;

/// A joint between two bodies, and how far a point of a body can be from it.
struct Lever {
  std::size_t joint;
  double reach;  ///< [m]; 1 for a prismatic joint
};

/// The joints that move a body relative to `ancestor`, which carries it.
void add_levers(const TrajectoryModel& model, int link, int ancestor, double extent,
                std::vector<Lever>& levers) {
  const Robot& robot = model.problem().robot;
  double reach = extent;
  for (; link != ancestor; link = robot.joints[static_cast<std::size_t>(link - 1)].parent) {
    const auto joint = static_cast<std::size_t>(link - 1);
    const Joint& at = robot.joints[joint];
    const bool turns = at.type == JointType::kRevolute;
    if (model.moves(joint)) levers.push_back({joint, turns ? reach : 1});
    reach += at.placement.p.norm();
    if (!turns) {
      reach += model.moves(joint) ? std::max(std::abs(at.q_min), std::abs(at.q_max)) + 1e-6
                                  : std::abs(model.rest()[joint]);
    }
    reach *= 1 + 1e-12;
  }
}

/// [m] The distance of the farthest point of a box from the origin of its link.
double extent(const InnerBody& box) {
  return (box.placement.p.norm() + box.half_sizes.norm()) * (1 + 1e-12);
}

int common_ancestor(const Robot& robot, int a, int b) {
  while (a != b) {  // parents come before children
    int& later = a > b ? a : b;
    later = robot.joints[static_cast<std::size_t>(later - 1)].parent;
  }
  return a;
}

struct TimeSlice {
  int interval;
  double from, to;
  int cuts;
  std::vector<int> pairs;  ///< those that are not yet known to be apart
};

std::string in_metres(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g m", x);
  return text;
}

class ClearanceProof {
 public:
  ClearanceProof(const TrajectoryModel& model, TrajectoryVerification& result)
      : model_(model), checker_(*model.problem().robot.collision), result_(result) {
    const Robot& robot = model.problem().robot;
    for (int pair = 0; pair < checker_.pairs(); ++pair) {
      std::vector<Lever>& levers = levers_.emplace_back();
      InnerBodyPair cores;
      const bool boxes =
          checker_.inner_bodies(pair, cores) && cores.a.points.empty() && cores.b.points.empty();
      known_.push_back(boxes ? 1 : 0);
      if (!known_.back()) continue;
      const int ancestor = common_ancestor(robot, cores.a.link, cores.b.link);
      add_levers(model, cores.a.link, ancestor, extent(cores.a), levers);
      add_levers(model, cores.b.link, ancestor, extent(cores.b), levers);
    }
  }

  MotionFault run() {
    std::vector<int> all(levers_.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
    for (int interval = 0; interval < model_.curve().intervals(); ++interval) {
      std::vector<TimeSlice> open = {{interval, 0, 1, 0, all}};
      while (!open.empty()) {
        end_if_interrupted();
        TimeSlice slice = std::move(open.back());
        open.pop_back();
        MotionFault fault = check(slice);
        if (!fault.reason.empty()) return fault;
        if (slice.pairs.empty()) continue;
        const double middle = (slice.from + slice.to) / 2;
        open.push_back({interval, middle, slice.to, slice.cuts + 1, slice.pairs});
        open.push_back({interval, slice.from, middle, slice.cuts + 1, std::move(slice.pairs)});
      }
    }
    return {};
  }

 private:
  /// Leaves the pairs that are not known to be apart in the slice.
  MotionFault check(TimeSlice& slice) {
    const double middle = (slice.from + slice.to) / 2;
    links_ = model_.links(slice.interval, middle);
    moved_ = model_.moved_from_middle(slice.interval, slice.from, slice.to);
    ++result_.places;
    const bool last = slice.cuts == kMostTimeCuts || result_.places >= kMostPlaces;
    std::vector<int> left;
    for (const int pair : slice.pairs) {
      ClosestPoints near;
      const auto fault = [&](const std::string& reason) {
        return MotionFault{checker_.pair_name(pair) + " " + reason,
                           model_.time(slice.interval, middle)};
      };
      if (!known_[static_cast<std::size_t>(pair)] || !checker_.nearest(links_, pair, near)) {
        return {checker_.pair_name(pair) +
                ": proofs in time know distances of capsules, and of a capsule and a box, only "
                "(--ignore-collision)"};
      }
      if (!(near.clearance >= -kTouching)) {
        return fault("collide: they are closer than their margin by " + in_metres(-near.clearance));
      }
      const double least = near.clearance - kDistanceRounding - approach(pair);
      if (least >= -kTouching) {
        result_.clearance = std::min(result_.clearance, least);
      } else if (last) {
        return fault("may collide");
      } else {
        left.push_back(pair);
      }
    }
    slice.pairs = std::move(left);
    return {};
  }

  /// [m] How much nearer the bodies of a pair may come from the middle of a slice to its ends.
  double approach(int pair) const {
    Narrow distance;
    for (const Lever& lever : levers_[static_cast<std::size_t>(pair)]) {
      if (!(moved_[lever.joint] < kInfinity)) return kInfinity;
      distance += lever.reach * Narrow(moved_[lever.joint]);
    }
    return distance.high;
  }

  const TrajectoryModel& model_;
  const CollisionChecker& checker_;
  TrajectoryVerification& result_;
  std::vector<std::vector<Lever>> levers_;  ///< of each pair
  std::vector<char> known_;                 ///< whether a pair is one of capsules and boxes
  std::vector<Pose<double>> links_;         ///< in the middle of a slice
  std::vector<double> moved_;               ///< how far joints can be from there
};

}  // namespace

MotionFault check_clearance(const TrajectoryModel& model, TrajectoryVerification& result) {
  if (!model.problem().robot.collision) return {};
  return ClearanceProof(model, result).run();
}

}  // namespace maxwrench
