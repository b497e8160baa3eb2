#pragma once

#include <functional>
#include <vector>

#include "solvers/certify/bound/bound_points.h"
#include "solvers/certify/bound/loop_model.h"
#include "solvers/certify/bound/multiplier_program.h"

namespace maxwrench {

/// The points of a multiplier program, which are added in rounds.
class ProgramRounds {
 public:
  /// `write(i, id)` sets column i of the program for point `id`. `number` is that of
  /// `ProgramPoints::add_largest`. Keeps a reference to the program.
  ProgramRounds(MultiplierProgram& program, std::function<void(Eigen::Index, Eigen::Index)> write,
                std::function<int(int)> number)
      : program_(program), write_(std::move(write)), number_(std::move(number)) {}
  ProgramRounds(const ProgramRounds&) = delete;
  ProgramRounds& operator=(const ProgramRounds&) = delete;

  /// Begins with the points of a larger box's basis and those that are worst at its multiplier,
  /// which has these values; without a basis, with the corners of the box.
  void begin(const std::vector<int>& basis, const LoopModel& model, const Eigen::VectorXd& values) {
    columns_ = points_.begin(basis, program_.first_point());
    if (basis.empty()) points_.add_corners(model.coordinates.chain, model.size);
    write_from(0);
    if (!basis.empty()) add(values, -kInfinity);
  }

  /// Adds points of the largest values above a limit. Returns false if there are none to add, or
  /// no room for them.
  bool add(const Eigen::VectorXd& values, double above) {
    const Eigen::Index before = points_.count();
    if (!points_.add_largest(values, above, number_)) return false;
    write_from(before);
    return true;
  }

  /// The basis of the program, in its columns.
  std::vector<int>& columns() { return columns_; }
  /// The same with the numbers of points, for `begin` in a part of the box.
  std::vector<int> basis() const { return points_.numbered(columns_, program_.first_point()); }

 private:
  void write_from(Eigen::Index first) {
    program_.set_points(points_.count());
    for (Eigen::Index i = first; i < points_.count(); ++i) {
      write_(i, points_.ids()[static_cast<std::size_t>(i)]);
    }
  }

  MultiplierProgram& program_;
  const std::function<void(Eigen::Index, Eigen::Index)> write_;
  const std::function<int(int)> number_;
  ProgramPoints points_;
  std::vector<int> columns_;
};

}  // namespace maxwrench
