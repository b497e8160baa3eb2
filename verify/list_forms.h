#pragma once

#include <array>
#include <optional>
#include <vector>

#include "verify/proof_over_box.h"

namespace maxwrench {

/// A difference of ends that counts as rounding, relative to 1 + their size: a posture whose lower
/// end in one scenario exceeds its value by no more has this value.
inline constexpr double kToleratedEnd = 1e-9;

/// One scenario, as part of a multiplier.
struct ListScenario {
  int wrench = 0, limits = 0;
  std::vector<int> cases;
  std::vector<double> z;  ///< of the ball
};

/// The rows of a list of scenarios: those of the nominal robot, of each case of each load, and of
/// each component of a wrench. The rows of a scenario are sums of these.
class ListForms {
 public:
  /// Keeps a reference to the problem.
  ListForms(const Problem& problem, const FormModel& model);
  explicit ListForms(const Problem&& problem, const FormModel&) = delete;

  const std::vector<FormRow>& nominal() const { return nominal_; }
  const std::vector<FormRow>& of_case(std::size_t load, std::size_t number) const {
    return cases_[load][number];
  }
  /// J' times unit component k of a wrench; empty if no wrench has it.
  const std::vector<FormRow>& along(std::size_t k) const { return along_[k]; }
  /// The largest magnitudes of these rows.
  const std::vector<double>& sizes(std::size_t k) const { return sizes_[k]; }

  /// The number of entries of a scenario in a multiplier.
  std::size_t entries() const;
  /// The scenario of these entries; none if the list has no such scenario, or if one of its loads
  /// is a current.
  std::optional<ListScenario> read(const double* entries) const;
  /// c_s = c + r E z, which contains the exact numbers.
  std::array<Narrow, 6> wrench(const ListScenario& scenario) const;

  /// A number that no value exceeds, from those of some scenarios.
  double ceiling() const { return ceiling_; }

 private:
  const ScenarioList& list() const { return problem_.scenarios; }
  void set_ceiling(const FormModel& model);

  const Problem& problem_;
  std::vector<FormRow> nominal_;
  std::vector<std::vector<std::vector<FormRow>>> cases_;
  std::array<std::vector<FormRow>, 6> along_;
  std::array<std::vector<double>, 6> sizes_;
  double ceiling_ = kInfinity;
};

}  // namespace maxwrench
