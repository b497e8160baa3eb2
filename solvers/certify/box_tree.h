#pragma once

#include <vector>

#include "solvers/certify/good_postures.h"

namespace maxwrench {

/// Many boxes in a binary tree of boxes around them, to find neighbours. Sides that were made by
/// the same halvings are the same numbers, so nothing is rounded.
class BoxTree {
 public:
  /// `lower`, `upper`: around all; where `turns`, both are one place. The boxes outlive the tree.
  BoxTree(const std::vector<GoodBox>& boxes, const Eigen::VectorXd& lower,
          const Eigen::VectorXd& upper, const std::vector<char>& turns);

  /// Which hang together: for each box a number, 0, 1, ... in the order of their first boxes. Those
  /// hang together that have a common point.
  std::vector<int> connect();

  /// A box that holds x; -1: none does.
  int find(const Eigen::VectorXd& x) const;

 private:
  struct Node {
    int first = 0, last = 0;    ///< of `order_`
    int left = -1, right = -1;  ///< -1: a leaf
    Eigen::VectorXd lower, upper;
    bool whole = false;  ///< all its boxes are known to hang together
  };

  int build(int first, int last);
  template <class A, class B>
  bool touch(const A& a, const B& b) const;
  void join_within(Node& node);
  void join_between(Node& a, Node& b);
  void join_boxes(const Node& a, const Node& b);
  int set_of(int box);

  Node& at(int node) { return nodes_[static_cast<std::size_t>(node)]; }
  int box(int place) const { return order_[static_cast<std::size_t>(place)]; }

  const std::vector<GoodBox>& boxes_;
  Eigen::VectorXd lower_, upper_;
  std::vector<char> turns_;
  std::vector<int> order_, parent_;
  std::vector<Node> nodes_;
};

}  // namespace maxwrench
