#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "maxwrench/types.h"

// Numbers of a scene as vectors and poses.

namespace maxwrench {

/// The number, or another one where there is none.
double number_or(const nlohmann::ordered_json& value, double other);

/// Whether it is a list that is not empty.
bool has_numbers(const nlohmann::ordered_json& list);

/// The i-th pose in a list of poses, 12 numbers each.
Eigen::Affine3d pose_at(const nlohmann::ordered_json& numbers, std::size_t i = 0);

/// All points in a list of numbers, three for each.
std::vector<Eigen::Vector3d> points_of(const nlohmann::ordered_json& numbers);

/// Three numbers of a list from `first` on.
Eigen::Vector3d vector_at(const nlohmann::ordered_json& numbers, std::size_t first = 0);

}  // namespace maxwrench
