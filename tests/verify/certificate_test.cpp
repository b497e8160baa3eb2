#include "verify/certificate.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <fstream>

#include "tests/support/support.h"
#include "tests/support/written_proof.h"
#include "verify/bytes.h"

namespace maxwrench {
namespace {

std::string proof_file(const TemporaryFolder& folder, const std::string& text) {
  const std::string file = folder.path() / "proof";
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

/// The same certificate with the smallest file that zlib can make of it.
std::string packed_again(const std::string& text) {
  const std::size_t magic = std::string("maxwrench proof 2\n").size();
  ByteReader head(std::string_view(text).substr(magic + 4));
  std::vector<Bytef> raw(head.whole(8));
  uLongf length = raw.size();
  const auto* old = reinterpret_cast<const Bytef*>(text.data()) + magic + 12;
  EXPECT_EQ(uncompress(raw.data(), &length, old, text.size() - magic - 12), Z_OK);
  std::vector<Bytef> packed(compressBound(raw.size()));
  uLongf size = packed.size();
  EXPECT_EQ(compress2(packed.data(), &size, raw.data(), raw.size(), Z_BEST_COMPRESSION), Z_OK);
  std::string all = text.substr(magic + 4, 8);
  all.append(packed.begin(), packed.begin() + static_cast<std::ptrdiff_t>(size));
  ByteWriter sum;
  sum.whole(crc32_z(0, reinterpret_cast<const Bytef*>(all.data()), all.size()), 4);
  return text.substr(0, magic) + sum.text() + all;
}

TEST(Certificate, ReadsWhatIsWritten) {
  const WrittenProof at("planar/force", "ellipsoid", Wrench::kPure, 1e-3);
  const TemporaryFolder folder;
  const std::string text = certificate_text(at.proof);
  const ProofCertificate read = read_certificate(proof_file(folder, text));
  EXPECT_EQ(certificate_text(read), text);
  EXPECT_EQ(at.rejection(read), "");
  EXPECT_EQ(read.x, at.proof.x);
  EXPECT_EQ(read.bound, at.proof.bound);
}

/// Any byte that changes, and any end that is missing.
TEST(Certificate, RejectsDamagedFiles) {
  const WrittenProof at("planar/force", "linf_polytope", Wrench::kPure, 1e-3);
  const TemporaryFolder folder;
  const std::string text = certificate_text(at.proof);
  Random random(1);
  const auto below = [&](std::size_t n) {
    return static_cast<std::size_t>(random.uniform(0, 1) * static_cast<double>(n));
  };
  for (int i = 0; i < samples(1000); ++i) {
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
TEST(Certificate, RejectsHostileFiles) {
  const WrittenProof at("planar/force", "linf_polytope", Wrench::kPure, 1e-2);
  const TemporaryFolder folder;
  const std::string text = certificate_text(at.proof);
  for (std::size_t size = 0; size < 32; ++size) {
    EXPECT_THROW(read_certificate(proof_file(folder, text.substr(0, size))), std::invalid_argument);
  }
  std::vector<ProofCertificate> bad(2, at.proof);
  bad[0].problem = "planar/force\nverified";
  bad[1].version += "\x1b[2J";
  for (const ProofCertificate& each : bad) {
    EXPECT_THROW(read_certificate(proof_file(folder, certificate_text(each))),
                 std::invalid_argument);
  }
}

/// 50 million nodes without a multiplier, the most that there may be, pack into 250 kB and take 2
/// GB of memory.
TEST(Certificate, HasNodesByTheSizeOfTheFile) {
  const WrittenProof at("planar/force", "linf_polytope", Wrench::kPure, 1e-2);
  const TemporaryFolder folder;
  ProofCertificate many = at.proof;
  many.tree.nodes.assign(4'000'000, {});
  const std::string text = certificate_text(many);
  EXPECT_GT(text.size(), many.tree.nodes.size() / 16);
  EXPECT_EQ(read_certificate(proof_file(folder, text)).tree.nodes.size(), many.tree.nodes.size());
  const std::string forged = packed_again(text);
  EXPECT_LT(forged.size(), text.size() / 100);
  EXPECT_THROW(read_certificate(proof_file(folder, forged)), std::invalid_argument);
}

}  // namespace
}  // namespace maxwrench
