#include "verify/centred_rows.h"

#include <gtest/gtest.h>

#include "tests/support/support.h"

namespace maxwrench {
namespace {

/// Three variables: two turn, and the one between them slides.
class CentredRowsOf : public testing::Test {
 protected:
  const FormShape shape_{{3, 2, 3}, {2, 0, 1}};
  const std::vector<double> far_ = {4, 2, 4};

  Form variable(int i, double a, double b) const { return {shape_, i, 0.25L, a, b}; }
};

TEST_F(CentredRowsOf, ContainTheRowsInTheBox) {
  const std::vector<Form> forms = {Form(shape_, 3.0L), variable(2, 0.5, -2), variable(1, 2, 0),
                                   variable(0, 1, 1) * variable(1, -1, 0),
                                   variable(0, 1, 2) * variable(1, 3, 0) * variable(2, 4, 5)};
  std::vector<FormRow> rows;
  for (const Form& form : forms) rows.emplace_back(form, far_);
  CentredRows centred(shape_, rows);
  Random random(3);
  std::vector<double> share(rows.size(), 0);
  for (int i = 0; i < 200; ++i) {
    Eigen::VectorXd centre(3), x(3);
    for (double& each : centre) each = random.uniform(-1, 1);
    const double size = std::pow(10, random.uniform(-6, 0));
    const Eigen::VectorXd lower = centre.array() - size, upper = centre.array() + size;
    ASSERT_TRUE(centred.set(lower, upper));
    for (std::size_t row = 0; row < rows.size(); ++row) {
      const Narrow middle = BoxForms::at_point(shape_, rows[row], centre);
      EXPECT_NEAR(centred.middle(row), middle.low, 1e-13 * (1 + middle.magnitude()));
      for (int corner = 0; corner < 9; ++corner) {
        for (int k = 0; k < 3; ++k) {
          const double ends = corner >> k & 1 ? upper[k] : lower[k];
          x[k] = corner < 8 ? ends : random.uniform(lower[k], upper[k]);
        }
        const double off =
            std::abs(BoxForms::at_point(shape_, rows[row], x).low - centred.middle(row));
        EXPECT_LE(off, centred.off(row) + 1e-12);
        share[row] = std::max(share[row], off / (centred.off(row) + 1e-9));
      }
    }
  }
  for (std::size_t row = 1; row < rows.size(); ++row) EXPECT_GT(share[row], 0.9) << row;
}

TEST_F(CentredRowsOf, HaveNoBoxesOfHalfATurn) {
  CentredRows centred(shape_, {FormRow(variable(0, 1, 1), far_)});
  const Eigen::Vector3d centre(0, 0, 0);
  EXPECT_TRUE(centred.set(centre.array() - 1.5, centre.array() + 1.5));
  EXPECT_FALSE(centred.set(centre.array() - 1.6, centre.array() + 1.6));
  // Of variables that no row depends on any box will do.
  EXPECT_TRUE(centred.set(Eigen::Vector3d(-9, -9, -1), Eigen::Vector3d(9, 9, 1)));
}

}  // namespace
}  // namespace maxwrench
