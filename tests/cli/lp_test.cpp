#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/netlib.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

using nlohmann::json;

std::string netlib(const std::string& file) { return kNetlibFolder + ("/" + file); }

json solve(const std::string& file, int exit_status, const std::string& options = "") {
  const CommandResult result = run_maxwrench("lp '" + file + "' --json " + options);
  EXPECT_EQ(result.exit_status, exit_status) << file << ": " << result.err;
  EXPECT_EQ(result.err, "");
  return json::parse(result.out);
}

TEST(NetlibCommand, OptimaAreTheExactOnes) {
  for (const auto& [name, value] : kNetlibOptima) {
    const json answer = solve(netlib(std::string(name) + ".mps"), 0);
    EXPECT_EQ(answer["status"], "optimal") << name;
    EXPECT_NEAR(answer["objective"], value, 1e-8 * std::abs(value)) << name;
    EXPECT_TRUE(answer["verified"]) << name;
    for (const auto& residual : answer["residual"]) EXPECT_LT(residual, 1e-7) << name;
  }
}

TEST(NetlibCommand, OtherVerdictsAreProven) {
  for (const char* name : kNetlibInfeasible) {
    const json answer = solve(netlib("infeasible/" + std::string(name) + ".mps"), 1);
    EXPECT_EQ(answer["status"], "infeasible") << name;
    EXPECT_TRUE(answer["verified"]) << name;
    EXPECT_TRUE(answer["objective"].is_null()) << name;
  }
  EXPECT_EQ(solve(netlib("unbounded/gas11.mps"), 1)["status"], "unbounded");
}

/// min 2 x + 3 y - 5 subject to x + y >= 4, x - y <= 1, y <= 10: x + y = 4 and x - y = 1 give
/// x = 2.5, y = 1.5 and 9.5 - 5 = 4.5. By the rows: 2 = p + q, 3 = p - q, so p = 2.5, q = -0.5.
constexpr const char* kSmall =
    "NAME small\nROWS\n N cost\n G sum\n L difference\nCOLUMNS\n"
    "    x         cost      2.0   sum       1.0\n"
    "    x         difference 1.0\n"
    "    y         cost      3.0   sum       1.0\n"
    "    y         difference -1.0\n"
    "RHS\n    RHS       sum       4.0   difference 1.0\n    RHS       cost      5.0\n"
    "BOUNDS\n UP BND       y         10.0\nENDATA\n";

TEST(LpCommand, DualsAndConstantInTheFilesOwnSense) {
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "small.mps").string();
  std::ofstream(file) << kSmall;
  for (const char* lp : {"simplex", "clp", "glpk"}) {
    const json answer = solve(file, 0, std::string("--solver ") + lp);
    EXPECT_NEAR(answer["objective"], 4.5, 1e-9) << lp;
    EXPECT_NEAR(answer["x"]["x"], 2.5, 1e-9) << lp;
    EXPECT_NEAR(answer["duals"]["sum"], 2.5, 1e-9) << lp;
    EXPECT_NEAR(answer["duals"]["difference"], -0.5, 1e-9) << lp;
    EXPECT_EQ(answer["sense"], "min");
  }
  const CommandResult text = run_maxwrench("lp '" + file + "'");
  EXPECT_NE(text.out.find("cost = 4.5"), std::string::npos) << text.out;
}

/// All files that come with the tests, by the rational numbers that `verify` checks.
TEST(NetlibCommand, SLOW_VerdictsAreProvenInRationalNumbers) {
  const TemporaryFolder folder;
  const std::string proof = (folder.path() / "proof.json").string();
  int files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kNetlibFolder)) {
    if (entry.path().extension() != ".mps") continue;
    ++files;
    const CommandResult made =
        run_maxwrench("lp '" + entry.path().string() + "' --certificate '" + proof + "'");
    EXPECT_EQ(made.err, "");
    const CommandResult checked = run_maxwrench("verify '" + proof + "'");
    EXPECT_EQ(checked.exit_status, 0) << entry.path() << checked.out << checked.err;
    std::filesystem::remove(proof);
  }
  EXPECT_GE(files, 22);
}

/// 9/2, see above; what is changed is rejected, what is no certificate is bad input.
TEST(LpCommand, CertificatesAreChecked) {
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "small.mps").string();
  const std::string proof = (folder.path() / "proof.json").string();
  std::ofstream(file) << kSmall;
  EXPECT_EQ(run_maxwrench("lp '" + file + "' --certificate '" + proof + "'").exit_status, 0);
  const json good = json::parse(run_maxwrench("verify --json '" + proof + "'").out);
  EXPECT_EQ(good["status"], "verified");
  EXPECT_EQ(good["objective"], "9/2");
  const std::string text = read_text(proof);
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string other = text;
    EXPECT_NE(other.find(from), other.npos) << from << " in " << other;
    std::ofstream(proof) << other.replace(other.find(from), from.size(), to);
    return run_maxwrench("verify '" + proof + "'");
  };
  EXPECT_EQ(changed("\"9/2\"", "\"4\"").exit_status, 1);
  EXPECT_EQ(changed("\"5/2\"", "\"7/2\"").exit_status, 1);  // x
  EXPECT_EQ(changed("optimal", "infeasible").exit_status, 1);
  for (const auto& [from, to] :
       std::vector<std::pair<std::string, std::string>>{{"\"5/2\"", "\"5/0\""},
                                                        {"\"5/2\"", "\"2.5\""},
                                                        {"\"5/2\"", "2.5"},
                                                        {"\"lambda\"", "\"mu\""},
                                                        {"optimal", "best"},
                                                        {"lp proof 1", "lp proof 2"},
                                                        {"{", "{{"}}) {
    const CommandResult result = changed(from, to);
    EXPECT_EQ(result.exit_status, 2) << to << result.out;
    EXPECT_NE(result.err.find(proof), std::string::npos) << result.err;
  }
}

TEST(LpCommand, BadInputExitsWithTwo) {
  for (const char* words :
       {"lp", "lp missing.mps", "lp README.md", "lp README.md --solver facets"}) {
    const CommandResult result = run_maxwrench(words);
    EXPECT_EQ(result.exit_status, 2) << words;
    EXPECT_EQ(result.out, "") << words;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
}

TEST(LpCommand, WrittenWrenchProgramsGiveTheSameBeta) {
  const TemporaryFolder folder;
  for (const char* problem : {"planar/force", "uvms/valve"}) {
    for (const char* wrench : {"pure", "any"}) {
      const std::string file = (folder.path() / "program.mps").string();
      const CommandResult eval = run_maxwrench("eval " + std::string(problem) + " --wrench " +
                                               wrench + " --json --write '" + file + "'");
      ASSERT_EQ(eval.exit_status, 0) << eval.err;
      const json expected = json::parse(eval.out);
      const json answer = solve(file, 0);
      const double beta = expected["beta"];
      EXPECT_NEAR(answer["objective"], beta, 1e-10 * (1 + std::abs(beta)));
      EXPECT_EQ(answer["sense"], "max");
      EXPECT_TRUE(answer["duals"].contains("base_yaw"));
      EXPECT_TRUE(answer["x"].contains(std::string(wrench) == "pure" ? "w_c" : "w_fx"));
    }
  }
}

TEST(LpCommand, OnlyThePolytopeOfEffortsIsWritten) {
  const CommandResult other = run_maxwrench("eval planar/force --measure ellipsoid --write x.mps");
  EXPECT_EQ(other.exit_status, 2);
  EXPECT_NE(other.err.find("--write"), std::string::npos) << other.err;
  const CommandResult nowhere = run_maxwrench("eval planar/force --write /proc/nowhere/x.mps");
  EXPECT_EQ(nowhere.exit_status, 2);
  EXPECT_NE(nowhere.err.find("/proc/nowhere/x.mps: got 'No such file"), std::string::npos)
      << nowhere.err;
}

}  // namespace
}  // namespace maxwrench
