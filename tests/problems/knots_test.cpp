#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

#include "maxwrench/load.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

/// uvms/valve_impulse: four knots of four joints.
class KnotsTest : public testing::Test {
 protected:
  Eigen::MatrixXd read(const std::string& text) {
    std::ofstream(file_) << text;
    return load_knots(file_, problem_);
  }
  std::string rejection(const std::string& text) {
    try {
      read(text);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  }

  const Problem problem_ = load_problem("uvms/valve_impulse");
  const TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_.path() / "knots.csv";
};

TEST_F(KnotsTest, AreReadAsTheyWereWritten) {
  Random random(1);
  const Eigen::MatrixXd knots =
      Eigen::MatrixXd::NullaryExpr(4, 4, [&] { return 2 * random.uniform() - 1; });
  const std::string text = knots_csv(problem_, knots);
  EXPECT_EQ(text.substr(0, text.find('\n')),
            "q1_shoulder_yaw,q2_shoulder_pitch,q3_elbow,q4_wrist_roll");
  EXPECT_EQ(read(text), knots);
  EXPECT_EQ(read(text.substr(text.find('\n') + 1)), knots);  // without names
}

TEST_F(KnotsTest, AreNotHeldToLimits) {
  EXPECT_EQ(read("1,2,3,4\n1,2,3,4\n1,2,3,4\n99,-2e1, 3 ,4\r\n")(3, 1), -20);
}

/// As spreadsheets save "CSV UTF-8".
TEST_F(KnotsTest, MayComeFromASpreadsheet) {
  const std::string header = "q1_shoulder_yaw,q2_shoulder_pitch,q3_elbow,q4_wrist_roll\r\n";
  for (const std::string& start : {header, std::string()}) {
    EXPECT_EQ(read("\xef\xbb\xbf" + start + "1,2,3,4\r\n1,2,3,4\r\n1,2,3,4\r\n9,8,7,6\r\n").row(3),
              Eigen::RowVector4d(9, 8, 7, 6));
  }
}

TEST_F(KnotsTest, OfAStaticProblemAreOneRow) {
  std::ofstream(file_) << "elbow,shoulder\n1,2\n";
  const Problem problem = load_problem("planar/force");
  EXPECT_THROW(load_knots(file_, problem), std::invalid_argument);
  std::ofstream(file_) << "shoulder,elbow\n1,2\n";
  EXPECT_EQ(load_knots(file_, problem), Eigen::RowVector2d(1, 2));
}

/// A name with a comma would not be read back, so no names are written.
TEST_F(KnotsTest, NamesThatACsvCannotHoldAreLeftOut) {
  Problem problem = load_problem("planar/force");
  problem.robot.joints[0].name = "a,b";
  EXPECT_EQ(knots_csv(problem, Eigen::RowVector2d(1, -0.5)), "1,-0.5\n");
}

TEST_F(KnotsTest, WrongTablesAreRejectedInOneLine) {
  const std::string row = "1,2,3,4\n";
  const std::pair<std::string, std::string> tables[] = {
      {"", "rows: got 0, expected 4, one for each knot of theta_r"},
      {row + row + row, "rows: got 3, expected 4"},
      {row + row + row + row + row, "rows: got 5, expected 4"},
      {"1,2,3\n", "line 1: got '1,2,3', expected 4 (q1_shoulder_yaw,"},
      {row + "1,2,3,4,5\n", "line 2: got '1,2,3,4,5', expected 4 (q1_shoulder_yaw,"},
      {row + "1,2,3,nan\n", "line 2: got '1,2,3,nan', expected 4 (q1_shoulder_yaw,"},
      {row + "1,2,3,1e999\n", "line 2: got '1,2,3,1e999', expected"},
      {row + "1,2,3,4x\n", "line 2: got '1,2,3,4x', expected"},
      {"a,b,c,d\n" + row, "line 1: got 'a,b,c,d', expected 4 (q1_shoulder_yaw,"},
  };
  for (const auto& [text, expected] : tables) {
    const std::string message = rejection(text);
    EXPECT_EQ(message.find(file_.string() + ": " + expected), 0u) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
  std::filesystem::remove(file_);
  EXPECT_THROW(load_knots(file_, problem_), std::invalid_argument);
  EXPECT_THROW(load_knots(folder_.path(), problem_), std::invalid_argument);
}

}  // namespace
}  // namespace maxwrench
