#include "solvers/certify/good_postures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "maxwrench/load.h"
#include "maxwrench/solve.h"
#include "tests/support/support.h"
#include "view/base64.h"
#include "view/scene/scene.h"

namespace maxwrench {
namespace {

using Json = nlohmann::ordered_json;

/// The boxes of a scene, as a page reads them.
struct DrawnBoxes {
  explicit DrawnBoxes(const Json& within) {
    const auto low = within["low"].get<std::vector<double>>();
    const auto extent = within["extent"].get<std::vector<double>>();
    const auto ends = [&](const char* key) {
      const std::string bytes = from_base64(within[key].get<std::string>());
      std::vector<Eigen::VectorXd> list(bytes.size() / 2 / low.size(), Eigen::VectorXd(low.size()));
      for (std::size_t k = 0; k < bytes.size() / 2; ++k) {
        const int share = static_cast<std::uint8_t>(bytes[2 * k]) +
                          256 * static_cast<std::uint8_t>(bytes[2 * k + 1]);
        const std::size_t i = k % low.size();
        list[k / low.size()][static_cast<Eigen::Index>(i)] = low[i] + share / 65535.0 * extent[i];
      }
      return list;
    };
    lower = ends("lower");
    upper = ends("upper");
    cluster = from_base64(within["cluster"].get<std::string>());
  }

  bool hold(const Eigen::VectorXd& from, const Eigen::VectorXd& to) const {
    for (std::size_t k = 0; k < lower.size(); ++k) {
      if (((from - lower[k]).array() >= -1e-9).all() && ((upper[k] - to).array() >= -1e-9).all()) {
        return true;
      }
    }
    return false;
  }

  std::vector<Eigen::VectorXd> lower, upper;
  std::string cluster;
};

Json scene_in(const std::string& page) {
  const std::string begin = "<script type=\"application/json\" id=\"scene\">";
  const std::size_t from = page.find(begin) + begin.size();
  return Json::parse(page.substr(from, page.find("</script>", from) - from));
}

/// Every good posture of a grid is in a box of the page, and some posture of the grid is not good.
TEST(SceneGoodPostures, NoGoodPostureIsOutsideTheBoxesOfThePage) {
  const CommandResult result = run_maxwrench("view planar/force --within 5% --resolution 0.1");
  ASSERT_EQ(result.exit_status, 0) << result.err;
  const Json scene = scene_in(result.out), within = scene["within"];
  const DrawnBoxes boxes(within);
  ASSERT_EQ(boxes.lower.size(), within["drawn"].get<std::size_t>());
  ASSERT_EQ(boxes.cluster.size(), boxes.lower.size());
  const double least = within["least"];
  EXPECT_NEAR(least, 0.95 * scene["shown"][0]["beta"].get<double>(), 1e-3 * least);
  const Problem problem = load_problem("planar/force");
  int good = 0;
  const int n = kSanitized ? 25 : 50;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      Eigen::VectorXd theta_r = problem.theta_r_min;
      theta_r[0] += i * (problem.theta_r_max[0] - theta_r[0]) / n;
      theta_r[1] += j * (problem.theta_r_max[1] - theta_r[1]) / n;
      const Answer answer = evaluate(problem, theta_r);
      if (!answer.has_value() || answer.beta() < least) continue;
      ++good;
      EXPECT_TRUE(boxes.hold(theta_r, theta_r)) << theta_r.transpose();
    }
  }
  EXPECT_GT(good, 0);
  EXPECT_LT(good, n * n / 4);
  for (const Json& cluster : within["clusters"]) {
    if (cluster["theta_r"].is_null()) continue;
    const auto numbers = cluster["theta_r"].get<std::vector<double>>();
    const Eigen::VectorXd theta_r = Eigen::Map<const Eigen::VectorXd>(numbers.data(), 2);
    EXPECT_TRUE(boxes.hold(theta_r, theta_r));
    EXPECT_NEAR(evaluate(problem, theta_r).beta(), cluster["beta"].get<double>(), 1e-9);
  }
}

/// 60,000 small boxes in 60 clusters.
TEST(SceneGoodPostures, ManyBoxesAreJoinedAndNoneIsLost) {
  const Problem problem = load_problem("uvms/valve");
  GoodPostures good;
  good.conclude(Status::kProven);
  Random random(11);
  const Eigen::VectorXd extent = problem.theta_r_max - problem.theta_r_min;
  for (int i = 0; i < 60'000; ++i) {
    GoodBox box;
    box.lower = problem.theta_r_min;
    for (Eigen::Index k = 0; k < 4; ++k) box.lower[k] += 0.98 * random.uniform() * extent[k];
    box.upper = box.lower + 0.02 * extent;
    box.high = random.uniform();
    box.cluster = i % 60;
    good.boxes.push_back(box);
  }
  for (int i = 0; i < 60; ++i) {
    Cluster cluster;
    cluster.best.value = -kInfinity;
    good.clusters.push_back(cluster);
  }
  good.sure = 1;
  const Json within = within_json(problem, good, 0.01);
  const DrawnBoxes boxes(within);
  EXPECT_EQ(within["boxes"], 60'000);
  EXPECT_LE(boxes.lower.size(), 20'000U);
  EXPECT_EQ(within["clusters"].size(), 50U);
  EXPECT_EQ(within["clusters_all"], 60);
  EXPECT_EQ(within["holding"], 0);
  EXPECT_TRUE(within["clusters"][0]["beta"].is_null());
  EXPECT_EQ(*std::max_element(boxes.cluster.begin(), boxes.cluster.end()), 50);
  for (std::size_t i = 0; i < good.boxes.size(); i += 397) {
    EXPECT_TRUE(boxes.hold(good.boxes[i].lower, good.boxes[i].upper)) << i;
  }
}

TEST(SceneGoodPostures, RejectsWhatHasNoList) {
  const auto rejects = [](const char* words, const char* expected) {
    const CommandResult result = run_maxwrench(std::string("view ") + words);
    EXPECT_EQ(result.exit_status, 2) << words;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_NE(result.err.find(expected), std::string::npos) << result.err;
    EXPECT_EQ(result.out, "");
  };
  rejects("uvms/valve_trajectory --within 1%", "--within: got uvms/valve_trajectory, a task in");
  rejects("mobile/push --within 1%", "--within: got mobile/push, a task with dependent joints");
  rejects("planar/force --within 0", "--within");
  rejects("planar/force --within nan", "--within");
  rejects("planar/force --resolution 0.1", "--resolution");
  rejects("planar/force --time 5", "--time");
  rejects("planar/force --within 1% --measure saturating_wrench", "measure");
}

/// A list that has no time is still true, and the page is written.
TEST(SceneGoodPostures, AListThatEndsEarlySaysSo) {
  const CommandResult result = run_maxwrench("view uvms/valve --within 1% --time 0 --budget 500");
  EXPECT_EQ(result.exit_status, 1) << result.err;
  const Json within = scene_in(result.out)["within"];
  EXPECT_EQ(within["status"], "bracket");
  EXPECT_FALSE(within["reason"].is_null());
  EXPECT_GT(within["boxes"], 0);
}

}  // namespace
}  // namespace maxwrench
