#include "problems/make/touching_bodies.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <set>

#include "lib/math/random.h"
#include "lib/robot/chain.h"
#include "lib/robot/kinematics.h"
#include "problems/collision/collision.h"

namespace maxwrench {
namespace {

using Names = std::pair<std::string, std::string>;

/// Two bodies on different links, with the test of each pair of their shapes.
struct BodyPair {
  Names names;
  std::vector<std::shared_ptr<const CollisionChecker>> tests;

  bool touch(const std::vector<Pose<double>>& links) const {
    return std::any_of(tests.begin(), tests.end(),
                       [&links](const auto& test) { return test->collides(links); });
  }
};

/// The link before each that has shapes, or -1.
std::vector<int> shaped_parents(const Robot& robot, const std::vector<Shape>& shapes) {
  std::vector<char> shaped(robot.links.size(), 0);
  for (const Shape& shape : shapes) shaped[static_cast<std::size_t>(shape.link)] = 1;
  std::vector<int> parents(robot.links.size(), -1);
  for (std::size_t link = 1; link < robot.links.size(); ++link) {
    const int parent = robot.joints[link - 1].parent;
    const auto at = static_cast<std::size_t>(parent);
    parents[link] = shaped[at] ? parent : parents[at];
  }
  return parents;
}

void add_note(Robot& robot, const char* why, const std::vector<Names>& pairs) {
  if (pairs.empty()) return;
  std::vector<std::string> texts;
  for (const auto& [a, b] : pairs) texts.push_back(fmt::format("{} and {}", a, b));
  robot.notes.push_back(fmt::format("collisions left out, {}: {}", why, fmt::join(texts, "; ")));
}

}  // namespace

std::vector<Names> touching_bodies(Robot& robot, const std::vector<Shape>& shapes,
                                   const std::vector<Names>& ignored, double margin) {
  constexpr int kTouchSamples = 200;
  constexpr double kFacesMeet = 1e-6;  // m; rounding must not decide whether closed fingers touch
  std::set<Names> known;
  for (const auto& [a, b] : ignored) known.insert({std::min(a, b), std::max(a, b)});
  const std::vector<int> parents = shaped_parents(robot, shapes);
  std::vector<Names> connected, at_rest, always;
  std::vector<BodyPair> pairs;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    for (std::size_t j = i + 1; j < shapes.size(); ++j) {
      const Shape &a = shapes[i], &b = shapes[j];
      const Names names = {std::min(a.body, b.body), std::max(a.body, b.body)};
      if (a.link == b.link || known.contains(names)) continue;
      if (parents[static_cast<std::size_t>(a.link)] == b.link ||
          parents[static_cast<std::size_t>(b.link)] == a.link) {
        known.insert(names);
        connected.push_back(names);
        continue;
      }
      auto at = std::find_if(pairs.begin(), pairs.end(),
                             [&names](const BodyPair& pair) { return pair.names == names; });
      if (at == pairs.end()) at = pairs.insert(pairs.end(), BodyPair{names, {}});
      at->tests.push_back(make_collision_checker({a, b}, {}, margin + kFacesMeet));
    }
  }
  Kinematics<double> kinematics(robot);
  Eigen::VectorXd q = resting_joints(robot);
  kinematics.set_joints(q);
  std::erase_if(pairs, [&](const BodyPair& pair) {
    if (!pair.touch(kinematics.links())) return false;
    at_rest.push_back(pair.names);
    return true;
  });
  Random random(1);
  for (int posture = 0; posture < kTouchSamples && !pairs.empty(); ++posture) {
    draw_joints(robot, random, q);
    kinematics.set_joints(q);
    std::erase_if(pairs, [&](const BodyPair& pair) { return !pair.touch(kinematics.links()); });
  }
  for (const BodyPair& pair : pairs) always.push_back(pair.names);
  add_note(robot, "as a joint connects them", connected);
  add_note(robot, "as they touch at rest", at_rest);
  add_note(robot, "as they touch in all of 200 postures", always);
  std::vector<Names> all = std::move(connected);
  all.insert(all.end(), at_rest.begin(), at_rest.end());
  all.insert(all.end(), always.begin(), always.end());
  return all;
}

}  // namespace maxwrench
