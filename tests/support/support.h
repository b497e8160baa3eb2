#pragma once

#include <filesystem>
#include <string>

#include "lib/math/random.h"
#include "maxwrench/problem.h"

namespace maxwrench {

#if defined(__SANITIZE_ADDRESS__)  // GCC's name
#define MAXWRENCH_SANITIZED
#elif defined(__has_feature)  // Clang's
#if __has_feature(address_sanitizer)
#define MAXWRENCH_SANITIZED
#endif
#endif
#if defined(MAXWRENCH_SANITIZED)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

/// The number of samples that a statistical test draws. Sanitizers are about twenty times slower,
/// so with them it is a twentieth, rounded up.
constexpr int samples(int all) { return kSanitized ? (all + 19) / 20 : all; }

/// The number of heap allocations of this process so far. Sanitizers replace malloc, so nothing is
/// counted with them.
inline constexpr bool kAllocationsAreCounted = !kSanitized;
long allocation_count();

/// A vehicle on six axes with eight thrusters of asymmetric limits and an arm of `joints` joints
/// (every third one prismatic), with random numbers throughout. End effector pose and c are random,
/// and any wrench is allowed.
Problem random_problem(Random& random, int joints);

/// A uniformly random theta_r within its limits.
Eigen::VectorXd random_theta_r(const Problem& problem, Random& random);

Eigen::Vector3d random_vector(Random& random, double scale = 1);
Eigen::Matrix3d random_rotation(Random& random);

/// The output of a command.
struct CommandResult {
  int exit_status = -1;
  std::string out, err;
};

/// Runs `build/maxwrench` with these words (shell syntax) in `folder`.
CommandResult run_maxwrench(const std::string& words,
                            const std::filesystem::path& folder = MAXWRENCH_SOURCE_DIR);

std::string read_text(const std::filesystem::path& file);

/// A new folder that is removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace maxwrench
