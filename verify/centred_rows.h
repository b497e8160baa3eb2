#pragma once

#include <memory>
#include <vector>

#include "verify/box_forms.h"

namespace maxwrench {

/// Rows of forms, each on the stretch of variables that it depends on, and how far they are from
/// their values at the centre of a box.
class CentredRows {
 public:
  CentredRows(const FormShape& shape, const std::vector<FormRow>& rows);

  /// False if the box is too wide or cannot be enclosed.
  bool set(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);
  /// A number near the value of a row at the centre.
  double middle(std::size_t row) const { return middle_[row]; }
  /// An upper bound of |row - middle| in the box.
  double off(std::size_t row) const { return off_[row]; }

 private:
  struct Group {
    int from, to;
    std::unique_ptr<const FormShape> shape;
    std::unique_ptr<BoxForms> box;
    std::vector<FormRow> rows;
    std::vector<std::size_t> places;  ///< of the rows among all
  };
  Group& group_of(const FormShape& shape, const FormRow& row);

  std::vector<Group> groups_;
  std::vector<double> middle_, off_, terms_;
  std::vector<Narrow> points_;
};

}  // namespace maxwrench
