#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "lib/robot/chain.h"
#include "maxwrench/load.h"
#include "maxwrench/posture.h"
#include "maxwrench/solve.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

namespace fs = std::filesystem;

const fs::path kGallery = MAXWRENCH_SOURCE_DIR "/problems/gallery";

struct GalleryRobot {
  const char* name;
  const char* licence;      ///< words of its licence
  Eigen::Vector3d at_zero;  ///< where the end effector is with all joints at zero [m]
  double payload;           ///< that the maker promises [kg]
};

/// Positions are sums of the Denavit-Hartenberg parameters that the makers publish:
/// - Gen3, straight up: z = 0.1564 + 0.1284 + 2 0.2104 + 0.2084 + 2 0.1059 + 0.0615, and to the
/// side
///   0.0054 + 0.0064 + 2 0.0064;
/// - Panda: x = 0.088, z = 0.333 + 0.316 + 0.384 - 0.107 to the flange, less 0.1034 to the grip;
/// - UR10, hanging at 2 m and turned upside down: x = 0.612 + 0.5723, y = -(0.163941 + 0.0922),
///   z = 2 - (0.1273 - 0.1157).
std::vector<GalleryRobot> gallery_robots() {
  return {{"gen3", "Kinova", {0, -0.0246, 1.1873}, 4},
          {"panda", "Apache License", {0.088, 0, 0.8226}, 3},
          {"ur10", "Redistribution and use", {1.1843, -0.256141, 1.9884}, 10}};
}

std::uintmax_t size_of_gallery() {
  std::uintmax_t bytes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(kGallery)) {
    if (entry.is_regular_file()) bytes += entry.file_size();
  }
  return bytes;
}

TEST(Gallery, HasTheLicenceOfEachRobotAndIsSmall) {
  for (const GalleryRobot& robot : gallery_robots()) {
    const std::string text = read_text(kGallery / robot.name / "LICENSE");
    EXPECT_NE(text.find(robot.licence), std::string::npos) << robot.name;
  }
  EXPECT_LE(size_of_gallery(), 5'000'000U);
}

TEST(Gallery, MeshesAreFoundAndNothingIsAmiss) {
  for (const GalleryRobot& robot : gallery_robots()) {
    const Robot read = load_robot((kGallery / robot.name / "robot.toml").string());
    EXPECT_TRUE(read.warnings.empty()) << robot.name << ": " << read.warnings.front();
    EXPECT_TRUE(read.no_dynamics.empty()) << robot.name;
    // Each link that a joint moves has a shape.
    EXPECT_GE(read.convex_bodies.size(), read.joints.size()) << robot.name;
  }
}

TEST(Gallery, EndEffectorsAreWhereTheMakersSay) {
  for (const GalleryRobot& robot : gallery_robots()) {
    const Problem task = load_problem((kGallery / robot.name / "lift.toml").string());
    const Eigen::VectorXd zero =
        Eigen::VectorXd::Zero(static_cast<Eigen::Index>(task.robot.joints.size()));
    const Pose<double> pose = pose_at_mount(task.robot, task.end_effector, zero);
    EXPECT_LT((pose.p - robot.at_zero).norm(), 1e-3) << robot.name << ": " << pose.p.transpose();
  }
}

TEST(Gallery, AnEvaluationWithHullsAllocatesNothing) {
  if (!kAllocationsAreCounted) GTEST_SKIP() << "sanitizers allocate by themselves";
  for (const GalleryRobot& robot : gallery_robots()) {
    const Problem task = load_problem((kGallery / robot.name / "push.toml").string());
    PostureEvaluator model(task);
    Random random(1);
    std::vector<Eigen::VectorXd> places;
    for (int i = 0; i < 20; ++i) {
      places.push_back(random_theta_r(task, random));
      model.evaluate(places.back());
    }
    const long before = allocation_count();
    for (const Eigen::VectorXd& theta_r : places) model.evaluate(theta_r);
    EXPECT_EQ(allocation_count(), before) << robot.name;
  }
}

/// What a maker promises in all postures, the best one lifts, too.
TEST(Gallery, TheBestPosturesLiftThePayload) {
  for (const GalleryRobot& robot : gallery_robots()) {
    Options options;
    options.budget = 500;
    const Answer answer =
        solve(load_problem(std::string("gallery/") + robot.name + "/lift"), options);
    ASSERT_EQ(answer.status, Status::kBestFound) << robot.name;
    EXPECT_GT(answer.beta(), robot.payload * 9.81) << robot.name;
  }
}

}  // namespace
}  // namespace maxwrench
