#include "maxwrench/mps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "solvers/lp/makers.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

std::filesystem::path data(const std::string& name) {
  return std::filesystem::path(MAXWRENCH_SOURCE_DIR) / "tests/data/lp" / (name + ".mps");
}

struct ClpAnswer {
  MpsProgram mps;
  LpSolution solution;
};

ClpAnswer solve(const std::filesystem::path& file) {
  ClpAnswer answer{read_mps(file), {}};
  validate(answer.mps.program);
  make_simplex()->solve(answer.mps.program, answer.solution);
  EXPECT_TRUE(verified(answer.mps.program, answer.solution)) << file;
  return answer;
}

/// The optimum of each file is derived in the comment at its head.
TEST(Mps, HandWrittenFilesHaveTheirOptima) {
  const std::vector<std::pair<std::string, double>> optima = {
      {"beale", -0.05},       {"kuhn", -2},      {"marshall_suurballe", -1},
      {"klee_minty", 1e14},   {"bounds", -8.5},  {"negative_upper", -10},
      {"minus_infinity", 10}, {"ranges", -6},    {"several", 17},
      {"empty", -4},          {"zero_width", 3}, {"blanks_in_names", 11}};
  for (const auto& [name, optimum] : optima) {
    const ClpAnswer answer = solve(data(name));
    EXPECT_EQ(answer.solution.status, Status::kOptimal) << name;
    EXPECT_NEAR(answer.mps.objective(answer.solution), optimum, 1e-9 * (1 + std::abs(optimum)))
        << name;
  }
}

TEST(Mps, HandWrittenFilesWithoutOptimum) {
  EXPECT_EQ(solve(data("infeasible_empty_row")).solution.status, Status::kInfeasible);
  EXPECT_EQ(solve(data("crossing_bounds")).solution.status, Status::kInfeasible);
  EXPECT_EQ(solve(data("both_infeasible")).solution.status, Status::kInfeasible);
  EXPECT_EQ(solve(data("dual_infeasible")).solution.status, Status::kUnbounded);
}

TEST(Mps, BoundsAsWritten) {
  const LinearProgram p = read_mps(data("bounds")).program;
  const Eigen::VectorXd l{{-5, -3, 0, 0, 2, -kInfinity, 1.5}};
  const Eigen::VectorXd u{{-1, kInfinity, 1, 0, 2, kInfinity, 1.5}};
  EXPECT_EQ(p.l.head(7), l);
  EXPECT_EQ(p.u.head(7), u);
  const LinearProgram q = read_mps(data("negative_upper")).program;
  EXPECT_EQ(q.l[0], -kInfinity);
  EXPECT_EQ(q.u[0], -2);
}

/// Every row but the equality E3 has a logical column with the row's range.
TEST(Mps, RangesAsWritten) {
  const MpsProgram mps = read_mps(data("ranges"));
  EXPECT_EQ(mps.file_cols, 5);
  const Eigen::VectorXd low{{6, 10, 6, 2}}, high{{10, 14, 9, 7}};
  EXPECT_EQ(mps.program.l.tail(4), low);
  EXPECT_EQ(mps.program.u.tail(4), high);
  EXPECT_EQ(mps.program.b[4], 3);
  EXPECT_EQ(mps.program.row_names[2], "L1");
  EXPECT_EQ(mps.program.col_names[7], "L1");
}

/// max 2 x + 3 y + 7, x + y <= 4, y <= 2: one more unit of the right-hand side is worth 2.
TEST(Mps, DualsAndConstantInTheFilesOwnSense) {
  const ClpAnswer answer = solve(data("several"));
  EXPECT_FALSE(answer.mps.minimize);
  EXPECT_EQ(answer.mps.constant, 7);
  EXPECT_EQ(answer.mps.objective_name, "GAIN");
  EXPECT_EQ(answer.mps.name, "SEVERAL");
  EXPECT_NEAR(answer.mps.duals(answer.solution)[0], 2, 1e-12);
  // min x, x - s = 0, s >= -7 - y and so on: raising R1's right-hand side costs 1.
  const ClpAnswer other = solve(data("negative_upper"));
  EXPECT_TRUE(other.mps.minimize);
  EXPECT_NEAR(other.mps.duals(other.solution)[0], 1, 1e-12);
  EXPECT_NEAR(other.mps.point(other.solution)[0], -10, 1e-12);
}

/// Bounds of 1e30 are how files write none, and a negative upper bound keeps a lower one.
TEST(Mps, LargeBoundsAreNone) {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "large.mps";
  std::ofstream(file) << "NAME X FREE\nROWS\n N COST\nCOLUMNS\n X COST 1\n Y COST 1\n Z COST 1\n"
                         "BOUNDS\n UP BND X 1e30\n LO BND Y -1e30\n UP BND Y -2\n"
                         " LO BND Z -1e24\n UP BND Z -3\nENDATA\n";
  const LinearProgram p = read_mps(file).program;
  EXPECT_EQ(p.l, Eigen::Vector3d(0, -kInfinity, -1e24));
  EXPECT_EQ(p.u, Eigen::Vector3d(kInfinity, -2, -3));
}

TEST(Mps, ReadingIsSilent) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  read_mps(data("several"));
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Mps, BadFilesAreRejectedByName) {
  const std::string head = "NAME X FREE\nROWS\n N COST\n L R1\nCOLUMNS\n X COST 1 R1 1\n";
  const std::vector<std::pair<std::string, std::string>> bad = {
      {"", "ENDATA"},
      {"no mps at all\n", "NAME"},
      {head + "RHS\n RHS R1 4\n", "ENDATA"},
      {head + "RHS\n RHS R9 4\nENDATA\n", "line 8"},
      {head + "RHS\n RHS R1 four\nENDATA\n", "line 8"},
      {head + "RHS\n RHS R1 nan\nENDATA\n", "line 8"},
      {head + "BOUNDS\n UP BND Y 4\nENDATA\n", "column"},
      {head + "BOUNDS\n UP BND X\nENDATA\n", "number"},
      {head + "BOUNDS\n SC BND X 4\nENDATA\n", "type"},
      {head + "QUADOBJ\n X X 1\nENDATA\n", "QUADOBJ"},
      {head + " M1 'MARKER' 'SOSORG'\nENDATA\n", "SOS"},
      {head + " X R1 2\nENDATA\n", "row R1 once in column X"},
      {head + " Y COST 1 COST 2\nENDATA\n", "row COST once in column Y"},
      {head + "RHS\n RHS R1 4\n RHS R1 5\nENDATA\n", "row R1 only once"},
      {head + "BOUNDS\n UP BND X 4\n FX BND X 5\nENDATA\n",
       "one lower and one upper bound of column X"},
      {head + " Y COST 1\n X R1 2\nENDATA\n", "column X together"},
      {"NAME X\nROWS\n N COST\n K R1\nENDATA\n", "line 4"},
      {"NAME X\nOBJSENSE\n    SIDEWAYS\nROWS\n N COST\n", "MIN or MAX"},
      {head + " " + std::string(500, 'Y') + " R1 1\nENDATA\n", "100 characters"}};
  const TemporaryFolder folder;
  const std::string file = folder.path() / "bad.mps";
  for (const auto& [text, expected] : bad) {
    std::ofstream(file) << text;
    try {
      read_mps(file);
      ADD_FAILURE() << "accepted: " << text;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(file), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
    }
  }
  EXPECT_THROW(read_mps(folder.path() / "missing.mps"), std::invalid_argument);
  EXPECT_THROW(read_mps(folder.path()), std::invalid_argument);
}

/// No RHS section, RANGES after BOUNDS, Fortran exponents, integer markers: all occur in the wild.
TEST(Mps, UnusualButLegalFiles) {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "odd.mps";
  std::ofstream(file)
      << "NAME\n* comment\n\nROWS\n N COST\n G R1\n G R2\nCOLUMNS\n"
         "    X  COST  1.5D+0  R1  1\n    M1 'MARKER' 'INTORG'\n"
         "\tY\tCOST\t1\tR2\t1\n    M2 'MARKER' 'INTEND'\n"
         "BOUNDS\n LO BND X 2\n LO BND Y 3\nRANGES\n RNG R1 10\nENDATA\nleft over\n";
  const ClpAnswer answer = solve(file);
  EXPECT_EQ(answer.solution.status, Status::kOptimal);
  EXPECT_NEAR(answer.mps.objective(answer.solution), 6, 1e-12);
}

}  // namespace
}  // namespace maxwrench
