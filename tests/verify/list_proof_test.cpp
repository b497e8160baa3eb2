#include <gtest/gtest.h>

#include <functional>

#include "maxwrench/certify.h"
#include "maxwrench/solve.h"
#include "tests/support/coded_tasks.h"
#include "tests/support/list_tasks.h"
#include "tests/support/support.h"
#include "tests/support/written_proof.h"
#include "verify/certificate.h"
#include "verify/verify.h"

namespace maxwrench {
namespace {

using ListTree = CertificateTree;

/// Certificates of all forms but currents, as `certify` writes them, are verified at any thread
/// count, and after they have been a file.
TEST(ListProof, SLOW_IsVerified) {
  for (const ListForm& form : list_forms()) {
    const Problem task = scenario_task(form.wrench, form.tables);
    Options options;
    options.budget = 3000;
    ProofOptions how;
    how.gap = kSanitized ? 1e-1 : 2e-2;
    how.seconds = 200;
    how.keep_certificate = true;
    if (std::string(form.name) == "current") {
      EXPECT_TRUE(rejection_of([&] {
                    certify(task, options, how);
                  }).starts_with("keep_certificate: got a task with currents"));
      continue;
    }
    const Proof proof = certify(task, options, how);
    EXPECT_EQ(proof.status, Status::kProven) << form.name << ": " << proof.reason.str();
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "list.proof";
    std::ofstream(file, std::ios::binary) << proof.certificate;
    const ProofCertificate read = read_certificate(file.string());
    EXPECT_EQ(certificate_text(read), proof.certificate) << form.name;
    for (const int threads : {1, 3}) {
      if (kSanitized && threads == 1) continue;
      const Verification result = verify(task, read, threads);
      EXPECT_EQ(result.rejection, "") << form.name;
      EXPECT_EQ(result.boxes, static_cast<long>(read.tree.nodes.size()));
      EXPECT_GT(result.by_multiplier, 0);
    }
  }
}

struct ListTampering {
  const char* name;
  std::function<void(ProofCertificate&)> change;
};

/// A leaf with a multiplier.
ListTree::Node& leaf_of(ListTree& tree) {
  for (ListTree::Node& node : tree.nodes) {
    if (node.axis < 0 && node.reason == ListTree::Reason::kMultiplier) return node;
  }
  throw std::logic_error("no leaf has a multiplier");
}

/// Changes an entry of each part of all multipliers.
void change_entry(ProofCertificate& proof, int entry, const std::function<double(double)>& change) {
  for (const ListTree::Node& node : proof.tree.nodes) {
    if (node.reason != ListTree::Reason::kMultiplier) continue;
    for (std::size_t part = 0; part < node.parts; ++part) {
      const std::size_t at = node.multiplier + part * static_cast<std::size_t>(proof.tree.width) +
                             static_cast<std::size_t>(entry);
      proof.tree.multipliers[at] = change(proof.tree.multipliers[at]);
    }
  }
}

/// Multiplies all lambda, which have an entry for each of the vehicle's ten velocities.
void scale_lambda(ProofCertificate& proof, double factor) {
  for (int i = proof.tree.width - 10; i < proof.tree.width; ++i) {
    change_entry(proof, i, [factor](double x) { return factor * x; });
  }
}

ListTampering set_entry(const char* name, int entry, double value) {
  return {name, [entry, value](ProofCertificate& proof) {
            change_entry(proof, entry, [value](double) { return value; });
          }};
}

std::vector<ListTampering> list_tamperings() {
  return {
      {"a lower bound", [](auto& p) { p.bound = p.value * (1 - 1e-3); }},
      {"a bound just above the value", [](auto& p) { p.bound = p.value * (1 + 1e-7); }},
      {"a higher value", [](auto& p) { p.value *= 1 + 1e-5; }},
      {"a higher value and efforts", [](auto& p) { p.value *= 1 + 1e-5, p.u *= 1 + 1e-5; }},
      {"a smaller gap", [](auto& p) { p.gap = 1e-6; }},
      {"a leaf left out", [](auto& p) { p.tree.nodes.pop_back(); }},
      {"a leaf twice", [](auto& p) { p.tree.nodes.push_back(p.tree.nodes.back()); }},
      {"no boxes but the first",
       [](auto& p) { p.tree.nodes.resize(1), p.tree.nodes[0].axis = -1; }},
      {"multipliers of zero", [](auto& p) { scale_lambda(p, 0); }},
      {"negative multipliers", [](auto& p) { scale_lambda(p, -1); }},
      {"no parts of a multiplier", [](auto& p) { leaf_of(p.tree).parts = 0; }},
      {"more parts than there are", [](auto& p) { leaf_of(p.tree).parts = 1U << 30U; }},
      {"wider parts", [](auto& p) { ++p.tree.width; }},
      {"a shared entry", [](auto& p) { p.tree.shared = 1; }},
      {"a wrench less", [](auto& p) { p.tree.of_list = false; }},
      set_entry("a wrench that does not exist", 0, 1000),
      set_entry("a wrench below the first", 0, -1),
      set_entry("half a wrench", 0, 0.5),
      set_entry("no number of a wrench", 0, std::nan("")),
      set_entry("limits that do not exist", 1, 1000),
      set_entry("infinite limits", 1, kInfinity),
      {"no scenario that decides", [](auto& p) { p.decides.clear(); }},
      {"one that does not exist", [](auto& p) { p.decides[0] = 99; }},
      {"one that is no number", [](auto& p) { p.decides[1] = std::nan(""); }},
      {"other efforts", [](auto& p) { p.u[0] += 1e-3; }},
      {"efforts that are no numbers", [](auto& p) { p.u[0] = std::nan(""); }},
      {"efforts of fewer actuators", [](auto& p) { p.u.conservativeResize(p.u.size() - 1); }},
      {"another posture", [](auto& p) { p.x[1] += 1e-3; }},
      {"a posture beyond the limits", [](auto& p) { p.x[1] += 100; }},
      {"a smaller root", [](auto& p) { p.upper[1] -= 0.1; }},
      {"another robot", [](auto& p) { ++p.digest; }},
  };
}

/// Each of them is false in its own way. None of them goes through a file, so no checksum helps.
TEST(ListProof, RejectsFalseProofs) {
  for (const ListForm& form : list_forms()) {
    const std::string name = form.name;
    if (name != "senses" && name != "ball" && name != "losses") continue;
    const WrittenProof at(scenario_task(form.wrench, form.tables), "list", "linf_polytope",
                          Wrench::kPure, 3e-2);
    ASSERT_EQ(at.rejection(at.proof), "") << name;
    for (const ListTampering& tampering : list_tamperings()) {
      ProofCertificate proof = at.proof;
      tampering.change(proof);
      EXPECT_NE(at.rejection(proof), "") << name << ": " << tampering.name;
    }
  }
}

WrittenProof written_list(const char* form, double gap) {
  for (const ListForm& each : list_forms()) {
    if (std::string(each.name) == form) {
      return {scenario_task(each.wrench, each.tables), "list", "linf_polytope", Wrench::kPure, gap};
    }
  }
  throw std::logic_error("no such form");
}

/// A multiplier of a wrench outside the ball proves too much.
TEST(ListProof, RejectsWrenchesOutsideTheBall) {
  const WrittenProof at = written_list("ball", 3e-2);
  for (const double factor : {1.1, 1e3, -1.5}) {
    ProofCertificate proof = at.proof;
    for (const int entry : {2, 3}) {
      change_entry(proof, entry, [factor](double z) { return factor * z; });
    }
    EXPECT_NE(at.rejection(proof), "") << factor;
  }
  ProofCertificate proof = at.proof;
  proof.decides[2] *= 2;
  EXPECT_NE(at.rejection(proof), "");
}

/// What holds for the intact robot does not hold for one that may lose a thruster: the intact
/// robot's value is larger, and its multipliers prove less.
TEST(ListProof, RejectsTheValueOfFewerScenarios) {
  WrittenProof at = written_list("losses", 3e-2);
  ProofCertificate intact = at.proof;
  change_entry(intact, 1, [](double) { return 0.0; });
  EXPECT_NE(at.rejection(intact), "");
  Problem fewer = at.problem;
  fewer.scenarios.limits.resize(1);
  Options options;
  options.check_collision = true;
  const Answer best = solve(fewer, options);
  ASSERT_GT(best.beta(), at.proof.bound);
  ProofCertificate higher = at.proof;
  higher.value = best.beta();
  higher.bound = higher.value * 1.01;
  higher.gap = 0.02;
  higher.x = best.posture.theta_r;
  higher.u = best.capability.u;
  higher.decides = {0, 0};
  EXPECT_NE(at.rejection(higher).find("not held in a scenario"), std::string::npos);
}

/// The recipe is part of what a certificate is about: other limits, loads or wrenches are another
/// task, even with the digest of the new one.
TEST(ListProof, RejectsOtherLists) {
  const auto stronger = [](Problem& task) {
    for (ScenarioLimits& each : task.scenarios.limits) {
      each.actuation =
          with_limits(each.actuation, 1.2 * each.actuation.u_min, 1.2 * each.actuation.u_max);
    }
  };
  const auto shorter = [](Problem& task) {
    for (ScenarioWrench& each : task.scenarios.wrenches) each.c /= 1.2;
  };
  const auto lighter = [](Problem& task) { task.scenarios.loads.clear(); };
  const auto smaller = [](Problem& task) { task.scenarios.ball->radius /= 1.2; };
  for (const auto& [form, change] :
       {std::pair<const char*, std::function<void(Problem&)>>("senses", stronger),
        {"senses", shorter},
        {"corners", lighter},
        {"corners", stronger},
        {"ball", smaller}}) {
    if (kSanitized && form != std::string("senses")) continue;
    WrittenProof at = written_list(form, kSanitized ? 1e-1 : 3e-2);
    ASSERT_EQ(at.rejection(at.proof), "") << form;
    change(at.problem);
    EXPECT_NE(at.rejection(at.proof).find("another robot or task"), std::string::npos) << form;
    at.proof.digest = digest(at.problem);
    EXPECT_NE(at.rejection(at.proof), "") << form;
  }
}

/// A certificate of one wrench is none of a list, and the other way round.
TEST(ListProof, IsOfItsKind) {
  const WrittenProof list = written_list("losses", 3e-2);
  Problem one = list.problem;
  one.scenarios = {};
  ProofCertificate proof = list.proof;
  proof.digest = digest(one);
  EXPECT_NE(verify(one, proof, 1).rejection, "");
}

}  // namespace
}  // namespace maxwrench
