#include <glpk.h>
#include <gtest/gtest.h>

#include <cfloat>
#include <filesystem>

#include "maxwrench/mps.h"
#include "tests/support/netlib.h"

namespace maxwrench {
namespace {

using Interval = std::pair<double, double>;

/// GLPK writes an absent bound as the largest number.
Interval interval(double low, double high) {
  return {low == -DBL_MAX ? -kInfinity : low, high == DBL_MAX ? kInfinity : high};
}

/// A file as GLPK's own reader has it. It keeps rows N, as free ones.
class GlpkFile {
 public:
  explicit GlpkFile(const std::filesystem::path& file) : problem_(glp_create_prob()) {
    const int terminal = glp_term_out(GLP_OFF);
    glp_mpscp options;
    glp_init_mpscp(&options);
    options.tol_mps = 0;  // else 1e-14 is read as zero
    EXPECT_EQ(glp_read_mps(problem_, GLP_MPS_DECK, &options, file.c_str()), 0) << file;
    glp_term_out(terminal);
    glp_create_index(problem_);
  }
  ~GlpkFile() { glp_delete_prob(problem_); }
  GlpkFile(const GlpkFile&) = delete;
  GlpkFile& operator=(const GlpkFile&) = delete;

  void expect_same_columns(const MpsProgram& mps) const {
    ASSERT_EQ(glp_get_num_cols(problem_), mps.file_cols);
    // GLPK adds the objective's right-hand side, where the convention is to subtract it.
    EXPECT_EQ(glp_get_obj_coef(problem_, 0), -mps.constant);
    for (int j = 0; j < mps.file_cols; ++j) {
      EXPECT_EQ(glp_get_col_name(problem_, j + 1), mps.program.col_names[j]);
      EXPECT_EQ(interval(glp_get_col_lb(problem_, j + 1), glp_get_col_ub(problem_, j + 1)),
                Interval(mps.program.l[j], mps.program.u[j]))
          << mps.program.col_names[j];
      EXPECT_EQ(glp_get_obj_coef(problem_, j + 1), -mps.program.c[j]);
    }
  }

  void expect_same_rows(const MpsProgram& mps) const {
    const LinearProgram& p = mps.program;
    const Eigen::MatrixXd A(p.A);
    int logical = mps.file_cols;
    for (int i = 0; i < p.rows(); ++i) {
      const int row = glp_find_row(problem_, p.row_names[i].c_str());
      ASSERT_GT(row, 0) << p.row_names[i];
      const bool equality = logical == p.cols() || A(i, logical) == 0;
      EXPECT_EQ(interval(glp_get_row_lb(problem_, row), glp_get_row_ub(problem_, row)),
                equality ? Interval(p.b[i], p.b[i]) : Interval(p.l[logical], p.u[logical]))
          << p.row_names[i];
      if (!equality) {
        EXPECT_EQ(A(i, logical), -1);
        ++logical;
      }
      EXPECT_EQ(entries(row, mps.file_cols), A.row(i).head(mps.file_cols).transpose());
    }
    EXPECT_EQ(logical, p.cols());
    int counted = 0;
    for (int row = 1; row <= glp_get_num_rows(problem_); ++row) {
      counted += glp_get_row_type(problem_, row) == GLP_FR ? 0 : 1;
    }
    EXPECT_EQ(counted, p.rows());
  }

 private:
  Eigen::VectorXd entries(int row, int cols) const {
    std::vector<int> places(static_cast<std::size_t>(cols) + 1);
    std::vector<double> values(places.size());
    const int count = glp_get_mat_row(problem_, row, places.data(), values.data());
    Eigen::VectorXd all = Eigen::VectorXd::Zero(cols);
    for (int k = 1; k <= count; ++k) all[places[k] - 1] = values[k];
    return all;
  }

  glp_prob* problem_;
};

/// Every number of every file of Netlib.
TEST(MpsPeer, NetlibFilesAreReadAsGlpkReadsThem) {
  int files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kNetlibFolder)) {
    if (entry.path().extension() != ".mps") continue;
    SCOPED_TRACE(entry.path().filename());
    const MpsProgram mps = read_mps(entry.path());
    const GlpkFile peer(entry.path());
    peer.expect_same_columns(mps);
    peer.expect_same_rows(mps);
    ++files;
  }
  EXPECT_EQ(files, 22);
}

}  // namespace
}  // namespace maxwrench
