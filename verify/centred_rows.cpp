#include "verify/centred_rows.h"

#include <algorithm>

namespace maxwrench {

CentredRows::CentredRows(const FormShape& shape, const std::vector<FormRow>& rows)
    : middle_(rows.size()), off_(rows.size()) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    Group& group = group_of(shape, rows[i]);
    group.rows.push_back(on_stretch(rows[i], shape, group.from, group.to));
    group.places.push_back(i);
  }
}

CentredRows::Group& CentredRows::group_of(const FormShape& shape, const FormRow& row) {
  const auto count = static_cast<int>(shape.terms.size());
  const auto depends_on = [&](int variable) {
    return std::any_of(row.index.begin(), row.index.end(), [&](int index) {
      return shape.digit(index, static_cast<std::size_t>(variable)) != 0;
    });
  };
  int from = 0, to = count;
  while (to > 0 && !depends_on(to - 1)) --to;
  while (from < to && !depends_on(from)) ++from;
  for (Group& group : groups_) {
    if (group.from == from && group.to == to) return group;
  }
  Group group{from,    to, std::make_unique<const FormShape>(shape.stretch(from, to)),
              nullptr, {}, {}};
  group.box = std::make_unique<BoxForms>(*group.shape);
  groups_.push_back(std::move(group));
  return groups_.back();
}

bool CentredRows::set(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
  const Eigen::VectorXd centre = (lower + upper) / 2;
  for (Group& group : groups_) {
    if (!group.box->set(lower, upper)) return false;
    set_products(*group.shape, centre, terms_);
    for (std::size_t i = 0; i < group.rows.size(); ++i) {
      const std::size_t place = group.places[i];
      middle_[place] = value_near(group.rows[i], terms_);
      points_.assign(static_cast<std::size_t>(group.shape->size), 0.0);
      add_to(points_, group.rows[i], 1.0);
      group.box->over_box(points_);
      double most = 0;
      for (const Narrow& x : points_) {
        const double off = (x - Narrow(middle_[place])).magnitude();
        if (!(off < kInfinity)) return false;  // or NaN
        most = std::max(most, off);
      }
      off_[place] = most;
    }
  }
  return true;
}

}  // namespace maxwrench
