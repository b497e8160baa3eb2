#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

#include "lib/scenario/scenario_list.h"
#include "solvers/certify/bound/bound_points.h"
#include "solvers/certify/bound/bounds.h"
#include "solvers/certify/bound/box_support.h"
#include "solvers/certify/bound/equation_program.h"
#include "solvers/certify/bound/list_multiplier.h"
#include "solvers/certify/bound/list_rows.h"
#include "solvers/certify/bound/loop_box.h"
#include "solvers/certify/bound/loop_linear.h"
#include "solvers/certify/bound/multiplier_program.h"

namespace maxwrench {
namespace {

/// The least U of the facets that are combined. The program has a row for each facet and for each
/// combination of equations, and columns as that of one wrench. The mean of the points with the
/// weights that it finds is what these facets cannot exclude; the facets that it violates are added
/// in rounds, whatever their scenario.
class ListBound final : public Bound {
 public:
  explicit ListBound(std::shared_ptr<const ListModel> model)
      : model_(std::move(model)),
        first_(model_->block(0)),
        most_rank_(std::min<Eigen::Index>(first_.m, first_.coordinates.chain.count())),
        support_(model_->kept().robot.actuation, false),
        linear_(first_),
        equations_(first_),
        rows_(*model_),
        multiplier_(*model_),
        programs_(static_cast<std::size_t>(ListRows::kMost + most_rank_ + 1)),
        points_blocks_(model_->n() * (model_->loads() + model_->axes()), ProgramPoints::kMost),
        entries_(ProgramPoints::kMost, most_rank_ + ListRows::kMost) {
    for (Eigen::Index b = 0; b < model_->blocks(); ++b) boxes_.emplace_back(model_->block(b));
    none_ = Eigen::VectorXd::Zero(model_->n());
  }

  double ceiling() const override { return model_->ceiling(); }

  void extend(Eigen::VectorXd& lower, Eigen::VectorXd& upper) const override {
    if (first_.m == 0) return;  // x is theta_r
    lower = first_.coordinates.lower.array() - kLimitTolerance;
    upper = first_.coordinates.upper.array() + kLimitTolerance;
  }

  bool shrink(Eigen::VectorXd& lower, Eigen::VectorXd& upper, std::vector<BoxCut>* cuts) override {
    return first_.m == 0 || linear_.shrink(lower, upper, cuts);
  }

  void evaluate(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, double low, double high,
                BoxProof& proof) override {
    proof.forget(high);
    for (LoopBox& box : boxes_) {
      if (!box.set(lower, upper)) return;
    }
    values_.set_ends(low, high);
    multiplier_.read(proof.multiplier);
    take(value(), proof);
    if (proof.high <= low) return;
    if (first_.m > 0) linear_.precondition(lower, upper);
    const bool known = values_.is_useful(proof.high);
    if (!known && equations_.exclude(lower, upper, boxes_.front(), linear_, proof)) return;
    rank_ = std::min<Eigen::Index>(linear_.rank(), most_rank_);
    improve_by_rounds(low, proof);
  }

  std::unique_ptr<Bound> clone() const override { return std::make_unique<ListBound>(model_); }

 private:
  static constexpr int kMostRounds = 60;
  static constexpr int kMostSteps = 120;
  static constexpr double kBelow = 1e-9;
  static constexpr double kClose = 0.1;
  /// Facets that lower the bound by less than this share of its excess end the rounds.
  static constexpr double kUseful = 0.01;
  /// Stands in a stored basis for the unit column of the sum of weights.
  static constexpr int kSum = -1'000'000;

  Eigen::Index row_count() const { return rank_ + rows_.count(); }
  MultiplierProgram& program() {
    auto& program = programs_[static_cast<std::size_t>(row_count())];
    if (!program) {
      const Eigen::Index r = row_count();
      program = std::make_unique<MultiplierProgram>(Eigen::MatrixXd::Identity(r, r),
                                                    Eigen::VectorXd::Zero(r),
                                                    Eigen::VectorXd::Zero(r), ProgramPoints::kMost);
    }
    return *program;
  }

  // Multipliers.

  void take(double U, BoxProof& proof) {
    if (U < proof.high) proof.improve(U, multiplier_.numbers());
  }

  /// Adds up the facets' multipliers by scenario.
  void gather(const Eigen::VectorXd& solved) {
    multiplier_.clear();
    multiplier_.nu.noalias() = linear_.M().topRows(rank_).transpose() * solved.head(rank_);
    for (Eigen::Index j = 0; j < rows_.count(); ++j) {
      const double weight = solved[rank_ + j];
      if (weight == 0) continue;
      const ListRows::Row& row = rows_.rows()[static_cast<std::size_t>(j)];
      multiplier_.add(row.key, weight, rows_.normal(row));
    }
  }

  /// U of the multiplier, rounding included. Leaves the violations in values_.
  double value() {
    lambda_.setZero(model_->n(), model_->loads());
    slopes_.setZero(model_->n(), model_->axes());
    double off = multiplier_.nu.cwiseAbs().dot(first_.f), off_a = 0;
    s_ = 0;
    double supports = 0;
    for (const ListMultiplier::Part& part : multiplier_.parts()) {
      s_ += support_.of(part.lambda, model_->limits(part.key));
      supports += support_.rounding();
      model_->weigh(part.key, loads_, axes_);
      lambda_.noalias() += part.lambda * loads_.transpose();
      slopes_.noalias() += part.lambda * axes_.transpose();
      for (Eigen::Index b = 0; b < loads_.size(); ++b) {
        off += std::abs(loads_[b]) * part.lambda.cwiseAbs().dot(model_->block(b).tau);
      }
      for (Eigen::Index k = 0; k < axes_.size(); ++k) {
        off_a += std::abs(axes_[k]) * part.lambda.cwiseAbs().dot(model_->block(k).a);
      }
    }
    weigh();
    const double share = kBoundRounding * kMostSpread;
    // A value t may be below the lower end of another scenario by kEndTolerance (1 + |t|).
    off = supports + share * off + kEndTolerance * off_a;
    return values_.bound(s_, g_, h_, off, (share + kEndTolerance) * off_a);
  }

  /// g and h at all control points.
  void weigh() {
    g_.setZero(first_.size);
    h_.setZero(first_.size);
    for (Eigen::Index b = 0; b < model_->blocks(); ++b) {
      const bool loads = b < model_->loads(), axes = b < model_->axes();
      load_ = loads ? Eigen::VectorXd(lambda_.col(b)) : none_;
      slope_ = axes ? Eigen::VectorXd(slopes_.col(b)) : none_;
      if (b > 0 && load_.isZero(0) && slope_.isZero(0)) continue;
      LoopBox& box = boxes_[static_cast<std::size_t>(b)];
      box.weigh(load_, slope_, multiplier_.nu);
      g_ += box.g();
      h_ += box.h();
    }
  }

  // Rounds.

  void improve_by_rounds(double low, BoxProof& proof) {
    begin(proof.basis);
    const double least_t = values_.least_t();
    double before = kInfinity;
    for (int round = 0; round < kMostRounds; ++round) {
      const double least =
          program().solve(least_t - kBelow * std::abs(least_t), kMostSteps, local_, solved_);
      gather(solved_);
      take(value(), proof);
      if (proof.high <= low) break;
      const double now = s_ + values_.at().maxCoeff();
      const bool close = values_.is_useful(proof.high) &&
                         now - least <= kClose * std::max(proof.high - least_t, 0.0);
      if (!close && add_points(least)) continue;
      if (least > before - kUseful * std::max(before - least_t, 0.0)) break;
      before = least;
      if (!add_rows()) break;
    }
    keep(proof.basis);
  }

  /// Begins with the facets and points of a larger box's basis and the points that are worst at its
  /// multiplier; without a basis, with the corners of the box.
  void begin(const std::vector<int>& basis) {
    rows_.clear();
    points_.clear();
    local_.clear();
    if (basis.empty()) {
      points_.add_corners(first_.coordinates.chain, first_.size);
    } else {
      const auto keys = static_cast<std::ptrdiff_t>(model_->key_size());
      auto at = basis.begin() + 1;
      for (int i = 0; i < basis.front(); ++i, at += 1 + keys) {
        rows_.add(*at, ScenarioKey(at + 1, at + 1 + keys));
      }
      const auto r = static_cast<int>(row_count());
      for (; at != basis.end(); ++at) {
        if (*at >= 0) points_.add(*at);
        local_.push_back(*at >= 0      ? 2 * r + static_cast<int>(points_.count())
                         : *at == kSum ? 2 * r
                                       : -1 - *at);
      }
      points_.add_largest(values_.at(), -kInfinity);
    }
    for (Eigen::Index i = 0; i < points_.count(); ++i) read_point(i);
    fill();
  }

  /// Stores the facets that count, and the points and equations of the basis.
  void keep(std::vector<int>& basis) const {
    const auto r = static_cast<int>(row_count());
    std::vector<char> counts(static_cast<std::size_t>(r), 1);
    for (const int column : local_) {
      if (column < 2 * r) counts[static_cast<std::size_t>(column % r)] = 0;
    }
    basis = {0};
    for (Eigen::Index j = 0; j < rows_.count(); ++j) {
      if (counts[static_cast<std::size_t>(rank_ + j)] == 0) continue;
      const ListRows::Row& row = rows_.rows()[static_cast<std::size_t>(j)];
      ++basis.front();
      basis.push_back(row.pair);
      basis.insert(basis.end(), row.key.begin(), row.key.end());
    }
    for (const int column : local_) {
      if (column > 2 * r) {
        basis.push_back(points_.ids()[static_cast<std::size_t>(column - 2 * r - 1)]);
      } else if (column == 2 * r) {
        basis.push_back(kSum);
      } else if (column % r < static_cast<int>(rank_)) {
        basis.push_back(-1 - column % r);
      }
    }
  }

  /// Reads the blocks of a point and its entries in all rows.
  void read_point(Eigen::Index i) {
    const Eigen::Index id = points_.ids()[static_cast<std::size_t>(i)];
    const bool high = id >= first_.size;
    const double t = high ? values_.most_t() : values_.least_t();
    const Eigen::Index n = model_->n(), from = n * model_->loads();
    auto all = points_blocks_.col(i);
    for (Eigen::Index b = 0; b < model_->blocks(); ++b) {
      LoopBox& box = boxes_[static_cast<std::size_t>(b)];
      box.read(high ? id - first_.size : id);
      if (b < model_->loads()) all.segment(b * n, n) = box.tau();
      if (b < model_->axes()) all.segment(from + b * n, n) = t * box.a();
    }
    if (rank_ > 0) {
      const LoopBox& box = boxes_.front();
      entries_.row(i).head(rank_).noalias() = linear_.M().topRows(rank_) * box.f();
    }
    for (Eigen::Index j = 0; j < rows_.count(); ++j) read_entry(i, j);
  }
  void read_entry(Eigen::Index i, Eigen::Index j) {
    entries_(i, rank_ + j) = rows_.coefficients(j).dot(points_blocks_.col(i));
  }

  /// Writes all rows and points into the program of this size.
  void fill() {
    MultiplierProgram& program = this->program();
    for (Eigen::Index j = 0; j < rows_.count(); ++j) {
      const ListRows::Row& row = rows_.rows()[static_cast<std::size_t>(j)];
      program.set_limits(rank_ + j, row.b_min, row.b_max);
    }
    program.set_points(0);
    fill_points();
  }
  void fill_points() {
    MultiplierProgram& program = this->program();
    program.set_points(points_.count());
    for (Eigen::Index k = 0; k < row_count(); ++k) {
      program.row(k) = entries_.col(k).head(points_.count());
    }
    for (Eigen::Index i = 0; i < points_.count(); ++i) {
      program.costs()[i] = points_.ids()[static_cast<std::size_t>(i)] >= first_.size
                               ? values_.most_t()
                               : values_.least_t();
    }
  }

  bool add_points(double least) {
    const Eigen::Index before = points_.count();
    if (!points_.add_largest(values_.at(), least - s_)) return false;
    for (Eigen::Index i = before; i < points_.count(); ++i) read_point(i);
    fill_points();
    return true;
  }

  /// Adds the facets that the mean of the points violates.
  bool add_rows() {
    const MultiplierProgram& last = program();
    mean_.setZero(points_blocks_.rows());
    for (Eigen::Index i = 0; i < points_.count(); ++i) {
      const double weight = last.weight(i);
      if (weight > 0) mean_ += weight * points_blocks_.col(i);
    }
    const auto r = static_cast<int>(row_count());
    const Eigen::Index before = rows_.count();
    if (!rows_.add_violated(mean_)) return false;
    const int more = static_cast<int>(row_count()) - r;
    for (int& column : local_) {
      if (column >= 2 * r) {
        column += 2 * more;
      } else if (column >= r) {
        column += more;
      }
    }
    for (int k = 0; k < more; ++k) local_.push_back(r + k);
    for (Eigen::Index j = before; j < rows_.count(); ++j) {
      for (Eigen::Index i = 0; i < points_.count(); ++i) read_entry(i, j);
    }
    fill();
    return true;
  }

  std::shared_ptr<const ListModel> model_;
  const LoopModel& first_;
  const Eigen::Index most_rank_;
  BoxSupport support_;
  std::vector<LoopBox> boxes_;
  LoopLinear linear_;
  EquationProgram equations_;
  ListRows rows_;
  ListMultiplier multiplier_;
  std::vector<std::unique_ptr<MultiplierProgram>> programs_;  ///< by the number of rows
  PointValues values_;
  ProgramPoints points_;
  Eigen::MatrixXd points_blocks_;  ///< [T; t A] of each point
  Eigen::MatrixXd entries_;        ///< points×rows
  Eigen::Index rank_ = 0;
  double s_ = 0;
  Eigen::MatrixXd lambda_, slopes_;
  Eigen::VectorXd none_, solved_, loads_, axes_, load_, slope_, g_, h_, mean_;
  std::vector<int> local_;
};

}  // namespace

std::unique_ptr<Bound> make_list_bound(const Problem& problem, Wrench wrench) {
  if (wrench == Wrench::kAny || !has_still_water(problem.scenarios) ||
      problem.contact_columns() > 0) {
    return make_alone_list_bound(problem, wrench);
  }
  return std::make_unique<ListBound>(std::make_shared<const ListModel>(problem));
}

}  // namespace maxwrench
