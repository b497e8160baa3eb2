#pragma once

#include <vector>

#include "solvers/certify/good_postures.h"

namespace maxwrench {

/// A binary tree of boxes around many boxes, to find neighbours. Comparisons are exact, because
/// sides made by the same halvings are identical numbers. Boxes are closed sets: a connected set of
/// postures that they cover lies in connected boxes.
class BoxTree {
 public:
  /// `lower` and `upper` are the limits of all boxes; where `turns`, both limits are the same
  /// place. The boxes must outlive the tree.
  BoxTree(const std::vector<GoodBox>& boxes, const Eigen::VectorXd& lower,
          const Eigen::VectorXd& upper, const std::vector<char>& turns);

  /// Numbers the connected sets of boxes: for each box 0, 1, ... in the order of the sets' first
  /// boxes. Boxes with a common point are connected.
  std::vector<int> connect();

  /// The index of a box that contains x, or comes within `margin` of it; -1 if there is none.
  int find(const Eigen::VectorXd& x, double margin = 0) const;

 private:
  struct Node {
    int first = 0, last = 0;    ///< range in `order_`
    int left = -1, right = -1;  ///< -1: a leaf
    Eigen::VectorXd lower, upper;
    bool whole = false;  ///< all its boxes are known to be connected
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
