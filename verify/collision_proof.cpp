#include "verify/collision_proof.h"

namespace maxwrench {
namespace {

/// An upper bound of the distance [m] by which x is beyond the reach of a box; negative within the
/// reach. Convex in x.
double beyond(const std::array<Narrow, 3>& x, const Eigen::Vector3d& half_sizes, double reach) {
  double most = -kInfinity;
  Narrow square;
  for (std::size_t i = 0; i < 3; ++i) {
    const double out = Narrow::above(x[i].magnitude() - half_sizes[static_cast<Eigen::Index>(i)]);
    if (!(out < kInfinity)) return kInfinity;  // or NaN
    most = std::max(most, out);
    if (out > 0) square += Narrow(out) * Narrow(out);
  }
  return Narrow::above((most <= 0 ? most : root_above(square.high)) - reach);
}

/// Computes the products of terms at q, one for each coefficient.
void set_products(const FormShape& shape, const Eigen::VectorXd& q, std::vector<double>& terms) {
  terms.assign(1, 1.0);
  for (std::size_t i = 0; i < shape.terms.size(); ++i) {
    const double x = q[shape.coordinates[i]];
    const bool turns = shape.terms[i] == 3;
    std::vector<double> more;
    for (const double term : terms) {
      more.push_back(term);
      more.push_back(term * (turns ? std::cos(x) : x));
      if (turns) more.push_back(term * std::sin(x));
    }
    terms = std::move(more);
  }
}

bool is_thin(const InscribedBox& core) { return (core.half_sizes.array() > 0).count() <= 1; }

/// The corners of a box and the points midway between them. For a segment, the points at its
/// quarters.
std::vector<Eigen::Vector3d> points_of(const InscribedBox& core) {
  const int steps = is_thin(core) ? 2 : 1;
  const auto most = [&](int axis) { return core.half_sizes[axis] > 0 ? steps : 0; };
  std::vector<Eigen::Vector3d> points;
  for (int i = -most(0); i <= most(0); ++i) {
    for (int j = -most(1); j <= most(1); ++j) {
      for (int k = -most(2); k <= most(2); ++k) {
        points.push_back(Eigen::Vector3d(i, j, k).cwiseProduct(core.half_sizes) / steps);
      }
    }
  }
  return points;
}

/// Whether some row has a term of a variable other than 1.
bool moves(const FormShape& shape, std::size_t variable,
           const std::vector<std::array<FormRow, 3>>& points) {
  for (const std::array<FormRow, 3>& point : points) {
    for (const FormRow& row : point) {
      for (const int index : row.index) {
        if (shape.digit(index, variable) != 0) return true;
      }
    }
  }
  return false;
}

/// Subtracted from the reach, because points are moved into link axes with rounded numbers.
constexpr double kHair = 1e-9;

}  // namespace

bool CollisionProof::collides(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                              int pair) {
  const CollisionChecker* const checker = problem_.robot.collision.get();
  if (checker == nullptr || pair < 0 || pair >= checker->pairs()) return false;
  set_products(model_.shape(), (lower + upper) / 2, terms_);
  for (const Movers& each : movers(pair)) {
    if (!set_box(lower, upper, each)) continue;
    for (const auto& point : each.points) {
      if (may_be_close(each, point) && is_close(each, point)) return true;
    }
  }
  return false;
}

/// Of coordinates that move no point any value will do. Their boxes may be too wide to enclose.
bool CollisionProof::set_box(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                             const Movers& movers) {
  lower_ = lower;
  upper_ = upper;
  lower_(movers.others).setZero();
  upper_(movers.others).setZero();
  return box_.set(lower_, upper_);
}

const std::vector<CollisionProof::Movers>& CollisionProof::movers(int pair) {
  const auto found = known_.find(pair);
  if (found != known_.end()) return found->second;
  std::vector<Movers>& both = known_[pair];
  InscribedBoxPair inscribed_boxes;
  if (problem_.robot.collision->inscribed_boxes(pair, inscribed_boxes)) {
    both.push_back(movers(inscribed_boxes.a, inscribed_boxes.b, inscribed_boxes.reach));
    both.push_back(movers(inscribed_boxes.b, inscribed_boxes.a, inscribed_boxes.reach));
  }
  return both;
}

CollisionProof::Movers CollisionProof::movers(const InscribedBox& core, const InscribedBox& other,
                                              double reach) const {
  Movers result{other.half_sizes, reach - kHair, {}, {}};
  for (const Eigen::Vector3d& at : points_of(core)) {
    const Eigen::Vector3d in_link = core.placement.R * at + core.placement.p;
    const FormVector x = model_.seen(core.link, model_.constant(in_link), other.link);
    const FormVector in_core = model_.into(other.placement, x);
    const std::vector<double>& far = model_.far();
    result.points.push_back(
        {FormRow(in_core[0], far), FormRow(in_core[1], far), FormRow(in_core[2], far)});
  }
  const FormShape& shape = model_.shape();
  for (std::size_t i = 0; i < shape.terms.size(); ++i) {
    if (!moves(shape, i, result.points)) result.others.push_back(shape.coordinates[i]);
  }
  return result;
}

/// Whether the point is close at the centre of the box, without an enclosure. Only then a proof is
/// attempted.
bool CollisionProof::may_be_close(const Movers& movers, const std::array<FormRow, 3>& point) const {
  std::array<Narrow, 3> x;
  for (std::size_t i = 0; i < 3; ++i) {
    double sum = 0;
    for (std::size_t k = 0; k < point[i].index.size(); ++k) {
      sum += point[i].coefficient[k].low * terms_[static_cast<std::size_t>(point[i].index[k])];
    }
    x[i] = sum;
  }
  return beyond(x, movers.half_sizes, movers.reach) < 0;
}

bool CollisionProof::is_close(const Movers& movers, const std::array<FormRow, 3>& point) {
  for (std::size_t i = 0; i < 3; ++i) {
    x_[i].assign(static_cast<std::size_t>(model_.shape().size), 0.0);
    add_to(x_[i], point[i], 1.0);
    box_.over_box(x_[i]);
  }
  for (std::size_t v = 0; v < x_[0].size(); ++v) {
    const std::array<Narrow, 3> x = {x_[0][v], x_[1][v], x_[2][v]};
    if (!(beyond(x, movers.half_sizes, movers.reach) < 0)) return false;
  }
  return true;
}

}  // namespace maxwrench
