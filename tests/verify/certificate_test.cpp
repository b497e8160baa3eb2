#include "verify/certificate.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/support.h"
#include "tests/support/written_proof.h"

namespace maxwrench {
namespace {

std::string proof_file(const TemporaryFolder& folder, const std::string& text) {
  const std::string file = folder.path() / "proof";
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

TEST(Certificate, ReadsWhatIsWritten) {
  const WrittenProof at("planar/force", "ellipsoid", Wrench::kPure, 1e-3);
  const TemporaryFolder folder;
  const std::string text = certificate_text(at.proof);
  const ProofCertificate read = read_certificate(proof_file(folder, text));
  EXPECT_EQ(certificate_text(read), text);
  EXPECT_EQ(at.refusal(read), "");
  EXPECT_EQ(read.x, at.proof.x);
  EXPECT_EQ(read.bound, at.proof.bound);
}

/// Any byte that changes, and any end that is missing.
TEST(Certificate, RefusesDamagedFiles) {
  const WrittenProof at("planar/force", "linf_polytope", Wrench::kPure, 1e-3);
  const TemporaryFolder folder;
  const std::string text = certificate_text(at.proof);
  Random random(1);
  const auto below = [&](std::size_t n) {
    return static_cast<std::size_t>(random.uniform(0, 1) * static_cast<double>(n));
  };
  for (int i = 0; i < 1000 / kSampleDivisor; ++i) {
    std::string damaged = text;
    if (i % 4 == 0) {
      damaged.resize(below(text.size()));
    } else {
      damaged[below(text.size())] ^= static_cast<char>(1 << below(8));
    }
    EXPECT_THROW(read_certificate(proof_file(folder, damaged)), std::invalid_argument);
  }
  EXPECT_THROW(read_certificate(folder.path() / "none"), std::invalid_argument);
}

/// Nor does a file that is cut off before its checksum pass, one that unpacks to far more than a
/// proof does, or one with names that write more than a line.
TEST(Certificate, RefusesHostileFiles) {
  const WrittenProof at("planar/force", "linf_polytope", Wrench::kPure, 1e-2);
  const TemporaryFolder folder;
  const std::string text = certificate_text(at.proof);
  for (std::size_t size = 0; size < 32; ++size) {
    EXPECT_THROW(read_certificate(proof_file(folder, text.substr(0, size))), std::invalid_argument);
  }
  std::vector<ProofCertificate> bad(3, at.proof);
  bad[0].tree.nodes.assign(1'000'000, {});
  bad[1].problem = "planar/force\nverified";
  bad[2].version += "\x1b[2J";
  for (const ProofCertificate& each : bad) {
    EXPECT_THROW(read_certificate(proof_file(folder, certificate_text(each))),
                 std::invalid_argument);
  }
}

}  // namespace
}  // namespace maxwrench
