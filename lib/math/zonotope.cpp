#include "maxwrench/zonotope.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "lib/math/decompositions.h"

namespace maxwrench {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Rows and columns of B that nonzero entries connect.
struct Block {
  std::vector<int> rows, cols;
};

std::vector<Block> independent_blocks(const MatrixXd& B) {
  // Union-find over rows 0..n-1. A column joins all rows in which it has an entry.
  std::vector<int> root(B.rows());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int row) {
    while (root[row] != row) row = root[row];
    return row;
  };
  std::vector<int> first_row(B.cols(), -1);
  for (int j = 0; j < B.cols(); ++j) {
    for (int i = 0; i < B.rows(); ++i) {
      if (B(i, j) == 0) continue;
      if (first_row[j] < 0) first_row[j] = i;
      root[find(i)] = find(first_row[j]);
    }
  }
  std::vector<Block> blocks;
  std::vector<int> block_of(B.rows(), -1);
  for (int i = 0; i < B.rows(); ++i) {
    int& block = block_of[find(i)];
    if (block < 0) {
      block = static_cast<int>(blocks.size());
      blocks.emplace_back();
    }
    blocks[block].rows.push_back(i);
  }
  for (int j = 0; j < B.cols(); ++j) {
    if (first_row[j] >= 0) blocks[block_of[find(first_row[j])]].cols.push_back(j);
  }
  return blocks;
}

/// The number of subsets with `k` of `n` elements; more than `limit` if the number exceeds `limit`.
long count_subsets(int n, int k, long limit) {
  double count = 1;
  for (int i = 0; i < k; ++i) count = count * (n - i) / (i + 1);
  return count > static_cast<double>(limit) ? limit + 1 : static_cast<long>(count + 0.5);
}

bool next_subset(std::vector<int>& subset, int n) {
  const int k = static_cast<int>(subset.size());
  int i = k - 1;
  while (i >= 0 && subset[i] == n - k + i) --i;
  if (i < 0) return false;
  ++subset[i];
  for (int j = i + 1; j < k; ++j) subset[j] = subset[j - 1] + 1;
  return true;
}

/// Unit normals of the facets of {G v : v in a box}, G r×m of rank r, one of each antipodal pair.
std::vector<VectorXd> facet_normals(const MatrixXd& G) {
  const int r = static_cast<int>(G.rows());
  if (r == 1) return {VectorXd::Ones(1)};
  std::vector<VectorXd> normals;
  std::vector<int> subset(r - 1);
  std::iota(subset.begin(), subset.end(), 0);
  MatrixXd spanning(r, r - 1);
  do {
    for (int i = 0; i < r - 1; ++i) spanning.col(i) = G.col(subset[i]).normalized();
    const MatrixXd across = split(spanning).complement;
    if (across.cols() > 1) continue;
    const VectorXd normal = across.col(0);
    const bool known = std::any_of(normals.begin(), normals.end(), [&](const VectorXd& other) {
      return std::abs(other.dot(normal)) > 1 - 1e-12;
    });
    if (!known) normals.push_back(normal);
  } while (next_subset(subset, static_cast<int>(G.cols())));
  return normals;
}

void add_normal(Zonotope& zonotope, const VectorXd& normal) {
  const Eigen::Index f = zonotope.N.cols();
  zonotope.N.conservativeResize(Eigen::NoChange, f + 1);
  zonotope.N.col(f) = normal;
}

/// Computes b_min and b_max from N, B and the limits of u.
void set_supports(Zonotope& zonotope) {
  const Eigen::Index f = zonotope.N.cols();
  zonotope.b_min.setZero(f);
  zonotope.b_max.setZero(f);
  for (Eigen::Index pair = 0; pair < f; ++pair) {
    const VectorXd normal = zonotope.N.col(pair);
    for (int j = 0; j < zonotope.actuators(); ++j) {
      const double slope = normal.dot(zonotope.B.col(j));
      // A generator that lies in the facet up to rounding does not change its support.
      if (std::abs(slope) < 1e-13 * zonotope.B.col(j).norm()) continue;
      const double low = slope * zonotope.u_min[j], high = slope * zonotope.u_max[j];
      zonotope.b_min[pair] += std::min(low, high);
      zonotope.b_max[pair] += std::max(low, high);
    }
  }
}

void require_limits(const VectorXd& u_min, const VectorXd& u_max) {
  for (Eigen::Index j = 0; j < u_min.size(); ++j) {
    if (u_min[j] <= u_max[j] && u_min[j] < kInfinity && u_max[j] > -kInfinity) continue;
    throw std::invalid_argument("zonotope: limit " + std::to_string(u_min[j]) + " .. " +
                                std::to_string(u_max[j]) + " of actuator " + std::to_string(j) +
                                ", expected min <= max");
  }
}

/// Adds the facet pairs of one block; false if there would be too many.
bool add_block(Zonotope& zonotope, const Block& block, long max_subsets) {
  const MatrixXd part = zonotope.B(block.rows, block.cols);
  const int rows = static_cast<int>(block.rows.size());
  auto [range, complement] = split(part);
  const auto rank = static_cast<int>(range.cols());
  if (count_subsets(static_cast<int>(block.cols.size()), std::max(rank - 1, 0), max_subsets) >
      max_subsets) {
    return false;
  }
  std::vector<VectorXd> normals;
  if (rank > 0) {
    if (rank == rows) range.setIdentity();
    for (const VectorXd& normal : facet_normals(range.transpose() * part)) {
      normals.push_back(range * normal);
    }
  }
  // No actuator acts along these directions.
  for (int i = 0; i < rows - rank; ++i) normals.push_back(complement.col(i));
  for (const VectorXd& normal : normals) {
    VectorXd full = VectorXd::Zero(zonotope.dimension());
    full(block.rows) = normal;
    add_normal(zonotope, full);
  }
  return true;
}

}  // namespace

Zonotope make_zonotope(MatrixXd B, VectorXd u_min, VectorXd u_max, long max_subsets) {
  if (B.cols() != u_min.size() || B.cols() != u_max.size()) {
    throw std::invalid_argument("zonotope: B has " + std::to_string(B.cols()) +
                                " columns, expected as many as limits");
  }
  if (!B.allFinite()) throw std::invalid_argument("zonotope: an entry of B is not finite");
  require_limits(u_min, u_max);
  Zonotope zonotope;
  zonotope.B = std::move(B);
  zonotope.u_min = std::move(u_min);
  zonotope.u_max = std::move(u_max);
  if (zonotope.B.size() > 0) {
    zonotope.rank = static_cast<int>(split(zonotope.B).range.cols());
    zonotope.B_pinv = pseudo_inverse(zonotope.B);
  } else {
    zonotope.B_pinv.resize(zonotope.B.cols(), zonotope.B.rows());
  }
  zonotope.N.resize(zonotope.dimension(), 0);
  const std::vector<Block> blocks = independent_blocks(zonotope.B);
  zonotope.has_facets = std::all_of(blocks.begin(), blocks.end(), [&](const Block& block) {
    return add_block(zonotope, block, max_subsets);
  });
  if (!zonotope.has_facets) zonotope.N.resize(zonotope.dimension(), 0);
  set_supports(zonotope);
  index_normals(zonotope);
  return zonotope;
}

void index_normals(Zonotope& zonotope) {
  zonotope.N_nonzero = zonotope.N.sparseView();
  zonotope.N_nonzero.makeCompressed();
  const int n = zonotope.dimension(), f = zonotope.facet_pairs();
  zonotope.N_begin.assign(static_cast<std::size_t>(f), n);
  zonotope.N_end.assign(static_cast<std::size_t>(f), 0);
  for (int j = 0; j < f; ++j) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(zonotope.N_nonzero, j); entry; ++entry) {
      int& begin = zonotope.N_begin[static_cast<std::size_t>(j)];
      int& end = zonotope.N_end[static_cast<std::size_t>(j)];
      begin = std::min(begin, static_cast<int>(entry.row()));
      end = std::max(end, static_cast<int>(entry.row()) + 1);
    }
  }
  std::vector<int>&begin = zonotope.N_begin, &end = zonotope.N_end;
  for (std::size_t j = 1; j < end.size(); ++j) end[j] = std::max(end[j], end[j - 1]);
  for (std::size_t j = begin.size(); j-- > 1;) begin[j - 1] = std::min(begin[j - 1], begin[j]);
}

Zonotope with_limits(Zonotope zonotope, VectorXd u_min, VectorXd u_max) {
  if (zonotope.actuators() != u_min.size() || zonotope.actuators() != u_max.size()) {
    throw std::invalid_argument("zonotope: got " + std::to_string(u_min.size()) + " and " +
                                std::to_string(u_max.size()) + " limits, expected " +
                                std::to_string(zonotope.actuators()));
  }
  require_limits(u_min, u_max);
  zonotope.u_min = std::move(u_min);
  zonotope.u_max = std::move(u_max);
  set_supports(zonotope);
  return zonotope;
}

}  // namespace maxwrench
