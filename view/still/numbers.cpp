#include "view/still/numbers.h"

#include <nlohmann/json.hpp>

namespace maxwrench {

using nlohmann::ordered_json;

double number_or(const ordered_json& value, double other) {
  return value.is_number() ? value.get<double>() : other;
}

bool has_numbers(const ordered_json& list) { return list.is_array() && !list.empty(); }

Eigen::Affine3d pose_at(const ordered_json& numbers, std::size_t i) {
  Eigen::Affine3d pose = Eigen::Affine3d::Identity();
  for (std::size_t k = 0; k < 12; ++k) {
    pose(static_cast<Eigen::Index>(k / 4), static_cast<Eigen::Index>(k % 4)) =
        numbers[12 * i + k].get<double>();
  }
  return pose;
}

Eigen::Vector3d vector_at(const ordered_json& numbers, std::size_t first) {
  return {numbers[first].get<double>(), numbers[first + 1].get<double>(),
          numbers[first + 2].get<double>()};
}

std::vector<Eigen::Vector3d> points_of(const ordered_json& numbers) {
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i + 3 <= numbers.size(); i += 3) {
    points.push_back(vector_at(numbers, i));
  }
  return points;
}

}  // namespace maxwrench
