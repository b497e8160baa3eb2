#include "solvers/certify/box_tree.h"

#include <algorithm>
#include <numeric>

namespace maxwrench {
namespace {

constexpr int kLeafBoxes = 8;

}  // namespace

BoxTree::BoxTree(const std::vector<GoodBox>& boxes, const Eigen::VectorXd& lower,
                 const Eigen::VectorXd& upper, const std::vector<char>& turns)
    : boxes_(boxes),
      lower_(lower),
      upper_(upper),
      turns_(turns),
      order_(boxes.size()),
      parent_(boxes.size()) {
  turns_.resize(static_cast<std::size_t>(lower.size()), 0);
  std::iota(order_.begin(), order_.end(), 0);
  std::iota(parent_.begin(), parent_.end(), 0);
  if (!boxes.empty()) build(0, static_cast<int>(boxes.size()));
}

/// Cuts into two equal parts along the widest side.
int BoxTree::build(int first, int last) {
  const auto index = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  Eigen::VectorXd lower = boxes_[static_cast<std::size_t>(box(first))].lower;
  Eigen::VectorXd upper = boxes_[static_cast<std::size_t>(box(first))].upper;
  for (int i = first + 1; i < last; ++i) {
    lower = lower.cwiseMin(boxes_[static_cast<std::size_t>(box(i))].lower);
    upper = upper.cwiseMax(boxes_[static_cast<std::size_t>(box(i))].upper);
  }
  int left = -1, right = -1;
  if (last - first > kLeafBoxes) {
    Eigen::Index axis = 0;
    (upper - lower).maxCoeff(&axis);
    const int middle = (first + last) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                     [&](int a, int b) {
                       return boxes_[static_cast<std::size_t>(a)].lower[axis] <
                              boxes_[static_cast<std::size_t>(b)].lower[axis];
                     });
    left = build(first, middle);
    right = build(middle, last);
  }
  at(index) = {first, last, left, right, std::move(lower), std::move(upper), false};
  return index;
}

/// Whether two boxes touch; for boxes around others, whether these may touch.
template <class A, class B>
bool BoxTree::touch(const A& a, const B& b) const {
  for (Eigen::Index i = 0; i < lower_.size(); ++i) {
    if (a.lower[i] <= b.upper[i] && b.lower[i] <= a.upper[i]) continue;
    if (turns_[static_cast<std::size_t>(i)] == 0) return false;
    const bool around = (a.upper[i] >= upper_[i] && b.lower[i] <= lower_[i]) ||
                        (b.upper[i] >= upper_[i] && a.lower[i] <= lower_[i]);
    if (!around) return false;
  }
  return true;
}

int BoxTree::set_of(int box) {
  while (parent_[static_cast<std::size_t>(box)] != box) {
    int& parent = parent_[static_cast<std::size_t>(box)];
    parent = parent_[static_cast<std::size_t>(parent)];
    box = parent;
  }
  return box;
}

void BoxTree::join_boxes(const Node& a, const Node& b) {
  for (int i = a.first; i < a.last; ++i) {
    for (int j = b.first; j < b.last; ++j) {
      const int one = set_of(box(i)), other = set_of(box(j));
      if (one == other) continue;
      if (!touch(boxes_[static_cast<std::size_t>(box(i))],
                 boxes_[static_cast<std::size_t>(box(j))])) {
        continue;
      }
      // The first box represents its set.
      parent_[static_cast<std::size_t>(std::max(one, other))] = std::min(one, other);
    }
  }
}

void BoxTree::join_between(Node& a, Node& b) {
  if (!touch(a, b)) return;
  if (a.whole && b.whole && set_of(box(a.first)) == set_of(box(b.first))) return;
  if (a.left < 0 && b.left < 0) return join_boxes(a, b);
  const bool cut_a = b.left < 0 || (a.left >= 0 && a.last - a.first >= b.last - b.first);
  Node& parted = cut_a ? a : b;
  Node& other = cut_a ? b : a;
  join_between(at(parted.left), other);
  join_between(at(parted.right), other);
}

void BoxTree::join_within(Node& node) {
  if (node.left < 0) {
    join_boxes(node, node);
  } else {
    join_within(at(node.left));
    join_within(at(node.right));
    join_between(at(node.left), at(node.right));
  }
  node.whole = node.left < 0 || (at(node.left).whole && at(node.right).whole);
  const int set = set_of(box(node.first));
  if (node.left >= 0) {
    node.whole = node.whole && set == set_of(box(at(node.right).first));
    return;
  }
  for (int i = node.first; i < node.last; ++i) node.whole = node.whole && set_of(box(i)) == set;
}

std::vector<int> BoxTree::connect() {
  if (!nodes_.empty()) join_within(nodes_.front());
  std::vector<int> numbers(boxes_.size(), -1);
  int count = 0;
  for (int i = 0; i < static_cast<int>(boxes_.size()); ++i) {
    const int set = set_of(i);  // at or before i
    numbers[static_cast<std::size_t>(i)] =
        set == i ? count++ : numbers[static_cast<std::size_t>(set)];
  }
  return numbers;
}

int BoxTree::find(const Eigen::VectorXd& x, double margin) const {
  const auto holds = [&](const auto& box) {
    return (x.array() >= box.lower.array() - margin).all() &&
           (x.array() <= box.upper.array() + margin).all();
  };
  std::vector<int> waiting;
  if (!nodes_.empty()) waiting.push_back(0);
  while (!waiting.empty()) {
    const Node& node = nodes_[static_cast<std::size_t>(waiting.back())];
    waiting.pop_back();
    if (!holds(node)) continue;
    if (node.left >= 0) {
      waiting.push_back(node.right);
      waiting.push_back(node.left);
      continue;
    }
    for (int i = node.first; i < node.last; ++i) {
      if (holds(boxes_[static_cast<std::size_t>(box(i))])) return box(i);
    }
  }
  return -1;
}

}  // namespace maxwrench
