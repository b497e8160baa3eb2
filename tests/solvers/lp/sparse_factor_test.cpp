#include "solvers/lp/simplex/sparse_factor.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <vector>

#include "lib/math/random.h"
#include "tests/support/support.h"

namespace maxwrench::simplex {
namespace {

constexpr double kSingular = 1e-10;

/// A model of `m` rows whose columns have a few random entries; columns m to 2m - 1 have a large
/// entry in a row of their own, so that together they are a regular basis.
Model random_model(Random& random, int m, int entries) {
  std::vector<Eigen::Triplet<double>> list;
  for (int j = 0; j < 3 * m; ++j) {
    std::set<int> rows;
    if (j < m) {
      list.emplace_back((7 * j) % m, j, random.uniform(2, 4));
      rows.insert((7 * j) % m);
    }
    for (int k = 0; k < entries; ++k) {
      const int i = static_cast<int>(random.next() % m);
      if (rows.insert(i).second) list.emplace_back(i, j, random.uniform(-1, 1));
    }
  }
  LinearProgram program;
  program.A.resize(m, 3 * m);
  program.A.setFromTriplets(list.begin(), list.end());
  program.b.setZero(m);
  program.c.setZero(3 * m);
  program.l.setZero(3 * m);
  program.u.setOnes(3 * m);
  Model model;
  EXPECT_TRUE(model.load(program));
  return model;
}

Eigen::SparseMatrix<double> basis_matrix(const Model& model, const std::vector<int>& head) {
  std::vector<Eigen::Triplet<double>> list;
  for (int p = 0; p < model.rows; ++p) {
    for (int e = model.start[head[p]]; e < model.start[head[p] + 1]; ++e) {
      list.emplace_back(model.index[e], p, model.value[e]);
    }
  }
  Eigen::SparseMatrix<double> basis(model.rows, model.rows);
  basis.setFromTriplets(list.begin(), list.end());
  return basis;
}

Eigen::VectorXd column_of(const Model& model, int j) {
  Eigen::VectorXd column = Eigen::VectorXd::Zero(model.rows);
  for (int e = model.start[j]; e < model.start[j + 1]; ++e) column[model.index[e]] = model.value[e];
  return column;
}

/// Compares the solutions for B, B' and a row of the inverse with those of Eigen.
void expect_solves(const SparseFactor& factor, const Eigen::SparseMatrix<double>& basis,
                   Random& random, double tolerance) {
  const int m = static_cast<int>(basis.rows());
  Eigen::SparseLU<Eigen::SparseMatrix<double>> peer(basis), peer_transposed(basis.transpose());
  ASSERT_EQ(peer.info(), Eigen::Success);
  const auto expect_near = [&](const Eigen::VectorXd& own, const Eigen::VectorXd& other) {
    EXPECT_LT((own - other).norm(), tolerance * (1 + other.norm()));
  };
  Eigen::VectorXd a = Eigen::VectorXd::Zero(m), own(m);
  for (int k = 0; k < 3; ++k) a[static_cast<int>(random.next() % m)] = random.normal();
  factor.ftran(a.data(), own.data());
  expect_near(own, peer.solve(a));
  factor.btran(a.data(), own.data());
  expect_near(own, peer_transposed.solve(a));
  for (double& v : a) v = random.normal();
  factor.ftran(a.data(), own.data());
  expect_near(own, peer.solve(a));
  factor.btran(a.data(), own.data());
  expect_near(own, peer_transposed.solve(a));
  const int p = static_cast<int>(random.next() % m);
  factor.row(p, own.data());
  expect_near(own, peer_transposed.solve(Eigen::VectorXd::Unit(m, p)));
}

/// Half of the positions hold logical variables, the others columns that make B regular.
std::vector<int> regular_head(const Model& model, Random& random) {
  std::vector<int> head(model.rows);
  for (int j = 0; j < model.rows; ++j) {
    head[j] = random.next() % 2 ? model.rows + j : (7 * j) % model.rows;
  }
  return head;
}

TEST(SparseFactor, AgreesWithEigenAlsoAfterUpdates) {
  Random random(41);
  for (const int m : {25, 26, 200, 710}) {  // 7 divides none of them
    for (const int entries : {1, 3, 8}) {
      const Model model = random_model(random, m, entries);
      std::vector<int> head = regular_head(model, random);
      SparseFactor factor;
      factor.resize(m, 64);
      std::vector<Replacement> singular;
      ASSERT_TRUE(factor.factorise(model, head, kSingular, singular)) << m << ' ' << entries;
      expect_solves(factor, basis_matrix(model, head), random, 1e-8);
      for (int k = 0; k < 64; ++k) {
        const int q = m + static_cast<int>(random.next() % (2 * m));
        if (std::find(head.begin(), head.end(), q) != head.end()) continue;
        Eigen::VectorXd a = column_of(model, q), alpha(m), other = Eigen::VectorXd::Ones(m);
        factor.ftran_entering(a.data(), alpha.data());
        int p = 0;
        alpha.cwiseAbs().maxCoeff(&p);
        // Other solutions in between, as in the simplex, must not disturb the update.
        factor.ftran(other.data(), a.data());
        factor.update(p, alpha[p]);
        head[p] = q;
        if (k % 16 == 15) expect_solves(factor, basis_matrix(model, head), random, 1e-7);
      }
    }
  }
}

TEST(SparseFactor, NamesDependentColumnsAndRowsThatRepair) {
  Random random(42);
  for (int k = 0; k < samples(60); ++k) {
    const int m = 30 + k;
    if (m % 7 == 0) continue;
    Model model = random_model(random, m, 3);
    std::vector<int> head(m);
    for (int& j : head) {  // many columns twice, many rows without an entry
      j = static_cast<int>(random.next() % 4) == 0 ? static_cast<int>(random.next() % m)
                                                   : m + static_cast<int>(random.next() % m);
    }
    const int rank =
        static_cast<int>(Eigen::FullPivLU<Eigen::MatrixXd>(basis_matrix(model, head)).rank());
    SparseFactor factor;
    factor.resize(m, 8);
    std::vector<Replacement> singular;
    EXPECT_EQ(factor.factorise(model, head, kSingular, singular), rank == m);
    ASSERT_EQ(static_cast<int>(singular.size()), m - rank);
    for (const auto& [position, row] : singular) head[position] = row;
    singular.clear();
    EXPECT_TRUE(factor.factorise(model, head, kSingular, singular));
    expect_solves(factor, basis_matrix(model, head), random, 1e-8);
  }
}

/// The columns at positions 0 and 1 differ by `gap` in one entry.
TEST(SparseFactor, NearlyDependentColumns) {
  Random random(43);
  for (const double gap : {1e-6, 1e-13}) {
    Model model = random_model(random, 60, 4);
    std::vector<int> head(60);
    std::iota(head.begin(), head.end(), 60);
    const int first = model.start[60], size = model.start[61] - first, last = model.start[180];
    model.index.insert(model.index.begin() + last, model.index.begin() + first,
                       model.index.begin() + first + size);
    model.value.insert(model.value.begin() + last, model.value.begin() + first,
                       model.value.begin() + first + size);
    model.value[last] += gap;
    model.start[179] = last;  // the last column is the copy
    model.start[180] = last + size;
    head[1] = 179;
    SparseFactor factor;
    factor.resize(60, 8);
    std::vector<Replacement> singular;
    const bool regular = factor.factorise(model, head, kSingular, singular);
    EXPECT_EQ(regular, gap > kSingular);
    if (regular) {
      Eigen::VectorXd a = Eigen::VectorXd::Ones(60), z(60);
      factor.ftran(a.data(), z.data());
      EXPECT_LT((basis_matrix(model, head) * z - a).norm(), 1e-13 * z.norm() * 60);
    } else {
      ASSERT_EQ(singular.size(), 1U);
      EXPECT_LE(singular[0].position, 1);
      head[singular[0].position] = singular[0].row;
      EXPECT_GT(
          Eigen::FullPivLU<Eigen::MatrixXd>(basis_matrix(model, head)).setThreshold(1e-9).rank(),
          59);
    }
  }
}

/// Not a number is no pivot: the column counts as dependent.
TEST(SparseFactor, NotANumberIsNoPivot) {
  Random random(44);
  Model model = random_model(random, 40, 3);
  std::vector<int> head(40);
  std::iota(head.begin(), head.end(), 40);
  for (int e = model.start[50]; e < model.start[51]; ++e) model.value[e] = std::nan("");
  SparseFactor factor;
  factor.resize(40, 8);
  std::vector<Replacement> singular;
  EXPECT_FALSE(factor.factorise(model, head, kSingular, singular));
  EXPECT_GE(singular.size(), 1U);
}

}  // namespace
}  // namespace maxwrench::simplex
