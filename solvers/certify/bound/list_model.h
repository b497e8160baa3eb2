#pragma once

#include <array>
#include <memory>
#include <vector>

#include "maxwrench/problem.h"
#include "solvers/certify/bound/loop_model.h"

namespace maxwrench {

/// One scenario of a list: [wrench, limits, case of each load, z of the ball]. The wrench of a ball
/// is c + r E z, with the components of z in units of `kBallStep`.
using ScenarioKey = std::vector<int>;
inline constexpr double kBallStep = 1.0 / (1 << 30);

/// The scenarios of a list as linear combinations of a few blocks of multi-affine rows:
///
///     tau_s = T_0 + sum_b m_sb T_b,      a_s = sum_k c_sk A_k.
///
/// T_0 is tau_d of the nominal robot. Each other T_b is the load of a unit of wet mass, or of its
/// first moment, on one link. A_k is J' times unit component k of a wrench.
///
/// Some scenarios are left out, which keeps a bound: those with a current, whose load is not
/// multi-affine, and those with infinite limits of efforts.
class ListModel {
 public:
  /// Keeps a reference to the problem. Throws std::invalid_argument, with one line, for lists
  /// without facets, without a scenario that is supported, and as `LoopModel`.
  explicit ListModel(const Problem& problem);
  explicit ListModel(const Problem&& problem) = delete;
  ListModel(const ListModel&) = delete;
  ListModel& operator=(const ListModel&) = delete;

  /// Block b has T_b and A_b in place of tau and a; beyond the last T or A, they are of no use. The
  /// first block has the equations.
  const LoopModel& block(Eigen::Index b) const { return *blocks_[static_cast<std::size_t>(b)]; }
  Eigen::Index blocks() const { return static_cast<Eigen::Index>(blocks_.size()); }
  Eigen::Index n() const { return blocks_.front()->n; }
  Eigen::Index loads() const { return static_cast<Eigen::Index>(units_.size()) + 1; }  ///< of T
  Eigen::Index axes() const { return static_cast<Eigen::Index>(axes_.size()); }        ///< of A

  /// The numbers m_s, the first of which is 1; and c_s in the order of the blocks A.
  void weigh(const ScenarioKey& key, Eigen::VectorXd& loads, Eigen::VectorXd& axes) const;
  /// The same for one case of a load: without T_0.
  void weigh(const LoadCase& load, Eigen::VectorXd& loads) const;
  /// The components of a wrench in the order of the blocks A.
  Eigen::VectorXd along_axes(const Vector6d& c) const;

  /// The task with a list of the scenarios that are not left out.
  const Problem& kept() const { return kept_; }
  /// The key of a scenario of the kept list with the wrench c.
  ScenarioKey key_of(const ScenarioChoice& choice) const;
  const Zonotope& limits(const ScenarioKey& key) const {
    return list().limits[static_cast<std::size_t>(key[1])].actuation;
  }
  /// The numbers of a key and z as they are in multipliers, and back.
  Eigen::Index key_size() const { return key_size_; }
  void write(const ScenarioKey& key, Eigen::Ref<Eigen::VectorXd> numbers) const;
  ScenarioKey read(const Eigen::Ref<const Eigen::VectorXd>& numbers) const;

  /// A number that no value exceeds: the least of those of some scenarios.
  double ceiling() const { return ceiling_; }

 private:
  /// A unit of wet mass (component 0), or of its first moment along an axis (1 to 3), of a link.
  struct UnitLoad {
    int link, component;
    bool operator==(const UnitLoad&) const = default;
  };
  const ScenarioList& list() const { return problem_.scenarios; }
  void leave_out();
  void find_units();
  void find_axes();
  Problem block_task(std::size_t block, const Problem& nominal) const;
  void set_ceiling();

  const Problem& problem_;
  Problem kept_;
  std::vector<int> kept_limits_;
  std::vector<std::vector<int>> kept_cases_;  ///< for each load
  std::vector<UnitLoad> units_;
  std::vector<int> axes_;
  std::array<int, 6> place_{};  ///< of each component of a wrench in `axes_`, or -1
  std::vector<std::unique_ptr<const Problem>> tasks_;
  std::vector<std::unique_ptr<LoopModel>> blocks_;
  Eigen::Index key_size_ = 0;
  double ceiling_ = kInfinity;
};

}  // namespace maxwrench
