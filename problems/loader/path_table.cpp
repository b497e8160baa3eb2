#include "problems/loader/path_table.h"

#include <cmath>

#include "problems/loader/bad_input.h"
#include "problems/loader/number_table.h"
#include "problems/loader/urdf_tree.h"

namespace maxwrench {
namespace {

constexpr double kShortestTime = 1e-6;     // s, between neighbours
constexpr double kLengthTolerance = 1e-3;  // of a quaternion that was printed with a few digits
/// [rad] between neighbours. Near pi, rounding would decide in which direction the path turns.
constexpr double kLargestTurn = 3;

Pose<double> pose_of(const NumberTable& table, std::size_t row) {
  const std::vector<double>& n = table.rows[row];
  const Eigen::Vector3d p(n[1], n[2], n[3]);
  if (table.columns.size() == 7) return pose_from_xyz_rpy(p, {n[4], n[5], n[6]});
  const Eigen::Quaterniond e(n[4], n[5], n[6], n[7]);
  if (!(std::abs(e.norm() - 1) < kLengthTolerance)) {
    table.throw_bad_row(row, "a quaternion of length 1");
  }
  return {e.normalized().toRotationMatrix(), p};
}

/// Rejects times that do not rise from zero.
void require_times(const NumberTable& table) {
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const double t = table.rows[i][0];
    if (i == 0 && t != 0) table.throw_bad_row(i, "t = 0 in the first row");
    if (i > 0 && t - table.rows[i - 1][0] < kShortestTime) {
      table.throw_bad_row(i, "a t that rises from row to row, by 1e-6 s or more");
    }
  }
}

void require_turns(const NumberTable& table, const std::vector<Pose<double>>& poses) {
  for (std::size_t i = 1; i < poses.size(); ++i) {
    if (logarithm(poses[i - 1].R.transpose() * poses[i].R).norm() > kLargestTurn) {
      table.throw_bad_row(i, "a pose turned by at most 3 rad from the row before");
    }
  }
}

}  // namespace

Path read_path_table(const std::filesystem::path& file) {
  const NumberTable table = read_numbers(file, {{"t", "x", "y", "z", "roll", "pitch", "yaw"},
                                                {"t", "x", "y", "z", "qw", "qx", "qy", "qz"}});
  if (table.rows.size() < 2) {
    throw_bad_input(file, "rows", std::to_string(table.rows.size()), "two poses or more");
  }
  std::vector<double> times;
  std::vector<Pose<double>> poses;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    times.push_back(table.rows[i][0]);
    poses.push_back(pose_of(table, i));
  }
  require_times(table);
  require_turns(table, poses);
  return Path::spline(times, poses);
}

WrenchTable read_wrench_table(const std::filesystem::path& file) {
  const NumberTable table = read_numbers(file, {{"t", "fx", "fy", "fz", "tx", "ty", "tz"}});
  if (table.rows.size() < 2) {
    throw_bad_input(file, "rows", std::to_string(table.rows.size()), "two wrenches or more");
  }
  require_times(table);
  WrenchTable result;
  result.file = file.string();
  result.wrenches.resize(6, static_cast<Eigen::Index>(table.rows.size()));
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const std::vector<double>& row = table.rows[i];
    result.t.push_back(row[0]);
    result.wrenches.col(static_cast<Eigen::Index>(i)) = Eigen::Map<const Vector6d>(row.data() + 1);
  }
  return result;
}

}  // namespace maxwrench
