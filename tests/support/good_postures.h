#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "maxwrench/objective.h"
#include "solvers/certify/good_postures.h"

namespace maxwrench {

inline bool holds(const GoodBox& box, const Eigen::VectorXd& x) {
  return (x.array() >= box.lower.array()).all() && (x.array() <= box.upper.array()).all();
}

/// Of the first box that holds x; -1: none.
inline int cluster_at(const GoodPostures& good, const Eigen::VectorXd& x) {
  for (const GoodBox& box : good.boxes) {
    if (holds(box, x)) return box.cluster;
  }
  return -1;
}

/// What is true of every list.
inline void expect_sound(Objective& objective, const GoodPostures& good,
                         const GoodOptions& options) {
  for (const GoodBox& box : good.boxes) {
    EXPECT_GE(box.high, good.least);
    if (good.status == Status::kProven) {
      EXPECT_LE((box.upper - box.lower).maxCoeff(), options.resolution * (1 + 1e-8));
    }
    EXPECT_TRUE((box.lower.array() >= objective.lower().array()).all());
    EXPECT_TRUE((box.upper.array() <= objective.upper().array()).all());
  }
  double last = kInfinity;
  for (std::size_t i = 0; i < good.clusters.size(); ++i) {
    const Cluster& cluster = good.clusters[i];
    EXPECT_LE(cluster.best.value, last);
    last = cluster.best.value;
    if (last == -kInfinity) continue;
    EXPECT_EQ(cluster_at(good, cluster.best.theta_r), static_cast<int>(i));
    EXPECT_EQ(objective.evaluate(cluster.best.theta_r), last);
    EXPECT_LE(last, cluster.high + 1e-9 * std::abs(last));
  }
}

}  // namespace maxwrench
