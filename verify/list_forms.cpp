#include "verify/list_forms.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace maxwrench {
namespace {

/// Whether x is a whole number from 0 to count - 1.
bool is_index(double x, std::size_t count) {
  return x >= 0 && x < static_cast<double>(count) && x == std::floor(x);
}

}  // namespace

ListForms::ListForms(const Problem& problem, const FormModel& model)
    : problem_(problem), nominal_(to_rows(model.tau_d(), model.far())) {
  for (const LoadGroup& group : list().loads) {
    auto& rows = cases_.emplace_back();
    for (const LoadCase& load : group) {
      const FormModel alone(problem, load.loads);
      rows.push_back(to_rows(alone.tau_d(), alone.far()));
    }
  }
  Vector6d used = Vector6d::Zero();
  for (const ScenarioWrench& wrench : list().wrenches) used += wrench.c.cwiseAbs();
  if (list().ball) used += list().ball->E.cwiseAbs().rowwise().sum();
  for (std::size_t k = 0; k < 6; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    if (used[axis] == 0) continue;
    const std::vector<Form> forms = model.exerted(Vector6d::Unit(axis));
    along_[k] = to_rows(forms, model.far());
    for (const Form& form : forms) {
      sizes_[k].push_back(narrow(Wide(form.magnitude(model.far()))).high);
    }
  }
  if (model.coordinates().base_is_dependent) set_ceiling(model);
}

/// From all wrenches, of a ball those along its axes, with all limits and the first case of each
/// load that is no current. Scenarios whose wrench the base's free axes do not limit are left out.
void ListForms::set_ceiling(const FormModel& model) {
  std::vector<LinkLoad> first;
  for (const LoadGroup& group : list().loads) {
    const auto load = std::find_if(group.begin(), group.end(),
                                   [](const LoadCase& each) { return each.current.isZero(0); });
    if (load == group.end()) return;
    first.insert(first.end(), load->loads.begin(), load->loads.end());
  }
  const FormModel changes(problem_, first);
  std::vector<Form> tau = model.tau_d();
  const std::vector<Form> change = changes.tau_d();
  for (std::size_t i = 0; i < tau.size(); ++i) tau[i] += change[i];
  for (const ScenarioWrench& wrench : list().wrenches) {
    if (wrench.hold) continue;
    Matrix6Xd directions = wrench.c;
    if (list().ball) directions = (list().ball->radius * list().ball->E).colwise() + wrench.c;
    for (const Vector6d& c : directions.colwise()) {
      if (c.isZero(0)) continue;
      for (const ScenarioLimits& limits : list().limits) {
        const Zonotope& set = limits.actuation;
        if (!set.u_min.allFinite() || !set.u_max.allFinite()) continue;
        try {
          // A share that covers the rounding of c, which is not an interval here.
          const double most = pure_ceiling(problem_, model, c / c.norm(), set, tau) / c.norm();
          ceiling_ = std::min(ceiling_, most * (1 + 1e-12));
        } catch (const std::invalid_argument&) {
          continue;
        }
      }
    }
  }
}

std::size_t ListForms::entries() const {
  const std::size_t axes = list().ball ? static_cast<std::size_t>(list().ball->E.cols()) : 0;
  return 2 + list().loads.size() + axes;
}

std::optional<ListScenario> ListForms::read(const double* entries) const {
  ListScenario scenario;
  const double* at = entries;
  if (!is_index(at[0], list().wrenches.size()) || !is_index(at[1], list().limits.size())) return {};
  scenario.wrench = static_cast<int>(*at++);
  scenario.limits = static_cast<int>(*at++);
  for (const LoadGroup& group : list().loads) {
    if (!is_index(*at, group.size())) return {};
    const auto number = static_cast<int>(*at++);
    if (!group[static_cast<std::size_t>(number)].current.isZero(0)) return {};
    scenario.cases.push_back(number);
  }
  const double* end = entries + this->entries();
  scenario.z.assign(at, end);
  return scenario;
}

std::array<Narrow, 6> ListForms::wrench(const ListScenario& scenario) const {
  const ScenarioWrench& of = list().wrenches[static_cast<std::size_t>(scenario.wrench)];
  std::array<Narrow, 6> c;
  for (std::size_t k = 0; k < 6; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    c[k] = of.c[axis];
    if (!list().ball || of.hold) continue;
    for (std::size_t j = 0; j < scenario.z.size(); ++j) {
      const double E = list().ball->E(axis, static_cast<Eigen::Index>(j));
      if (E != 0) c[k] += Narrow(list().ball->radius) * Narrow(E) * Narrow(scenario.z[j]);
    }
  }
  return c;
}

}  // namespace maxwrench
