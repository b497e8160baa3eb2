#include "lib/search/facet_program.h"

#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "lib/posture/redundancy.h"
#include "lib/robot/clearance_slope.h"
#include "lib/search/scenario_rows.h"
#include "maxwrench/measure.h"
#include "maxwrench/posture.h"
#include "maxwrench/problem.h"
#include "maxwrench/wrench_program.h"

namespace maxwrench {
namespace {

/// [m] The lower bound of a clearance. It is positive because bodies that touch collide and a
/// solver meets its bounds only up to rounding.
constexpr double kLeastClearance = 1e-9;
constexpr int kMostPairs = 200, kMostScenarioRows = 1200;
constexpr double kClearanceUnit = 0.1;  // m

std::vector<int> all_dependent_joints(const Problem& problem) {
  std::vector<int> following = problem.dependent;
  if (problem.contact) {
    following.insert(following.end(), problem.contact->follow.begin(),
                     problem.contact->follow.end());
  }
  return following;
}

/// For each link the last link on its way from the base that a joint of the task moves; 0: none.
/// Two links with the same one keep their distance.
std::vector<int> movers(const Problem& problem) {
  const std::vector<Joint>& joints = problem.robot.joints;
  std::vector<bool> moves(joints.size());
  for (const int joint : problem.redundant) moves[static_cast<std::size_t>(joint)] = true;
  for (const int joint : all_dependent_joints(problem)) {
    moves[static_cast<std::size_t>(joint)] = true;
  }
  std::vector<int> mover(joints.size() + 1);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const std::optional<Gear>& gear = joints[i].gear;
    const bool moved = moves[i] || (gear && moves[static_cast<std::size_t>(gear->leader)]);
    mover[i + 1] =
        moved ? static_cast<int>(i + 1) : mover[static_cast<std::size_t>(joints[i].parent)];
  }
  return mover;
}

/// The pairs of bodies whose distance is known and may change.
std::vector<int> known_pairs(const Problem& problem, bool check_collision) {
  std::vector<int> known;
  const CollisionChecker* checker = problem.robot.collision.get();
  if (!check_collision || checker == nullptr) return known;
  const std::vector<Pose<double>> links(problem.robot.links.size());
  const std::vector<int> mover = movers(problem);
  ClosestPoints near;
  for (int pair = 0; pair < checker->pairs(); ++pair) {
    if (!checker->nearest(links, pair, near)) continue;
    const int a = mover[static_cast<std::size_t>(near.link_a)];
    const int b = mover[static_cast<std::size_t>(near.link_b)];
    if (a != b) known.push_back(pair);
  }
  return known;
}

}  // namespace

struct FacetProgram::Workspace {
  Workspace(const Problem& p, Wrench wrench, const MeasureMaker& make, bool check_collision)
      : problem(p),
        model(p, false),
        program(make_wrench_program(p, wrench)),
        measure(make()),
        pairs(known_pairs(p, check_collision)),
        following(all_dependent_joints(p)),
        slopes(p.robot.velocities(), p.redundancy()) {
    if (ScenarioRows::count(p, wrench) > 0) list.emplace(p);
    set_w();
    set_bounds();
    const Eigen::Index count = row_min.size();
    rows.setZero(count);
    by_theta_r.setZero(count, p.redundancy());
    by_w.setZero(count, c_w.size());
  }

  /// Of a list, w is the factor of its wrenches.
  void set_w() {
    c_w = program.c_w;
    w_min = program.w_min;
    w_max = program.w_max;
    if (!list) return;
    c_w.setOnes(1);
    w_min.setConstant(1, problem.scenarios.non_negative ? 0 : -kInfinity);
    w_max.setConstant(1, kInfinity);
  }

  void set_bounds() {
    const Eigen::Index faces = facets(), p = static_cast<Eigen::Index>(pairs.size());
    row_min.setZero(faces + p + static_cast<Eigen::Index>(following.size()));
    row_max = row_min;
    if (list) {
      row_min.head(faces).setConstant(-kInfinity);
      row_max.head(faces) = list->bound();
    } else {
      row_min.head(faces) = actuation().b_min;
      row_max.head(faces) = actuation().b_max;
    }
    row_min.segment(faces, p).setConstant(kLeastClearance);
    row_max.segment(faces, p).setConstant(kInfinity);
    for (std::size_t i = 0; i < following.size(); ++i) {
      const Joint& joint = problem.robot.joints[static_cast<std::size_t>(following[i])];
      const Eigen::Index row = faces + p + static_cast<Eigen::Index>(i);
      row_min[row] = joint.q_min;
      row_max[row] = joint.q_max;
    }
    row_unit = (row_max - row_min) / 2;
    if (list) row_unit.head(faces) = list->unit();
    row_unit.segment(faces, p).setConstant(kClearanceUnit);
    for (double& unit : row_unit) unit = unit > 0 && std::isfinite(unit) ? unit : 1;
  }

  const Zonotope& actuation() const { return *program.actuation; }
  /// The number of rows of forces.
  Eigen::Index facets() const { return list ? list->bound().size() : actuation().facet_pairs(); }

  bool place(const Eigen::VectorXd& theta_r) {
    if (posture && posture->theta_r == theta_r) return posture->status == Status::kValid;
    posture = &model.evaluate(theta_r);
    if (posture->status != Status::kValid) return false;
    if (model.ik_solutions() > 1) choose_nearest();
    read_posture();
    return true;
  }

  void read_posture() {
    if (list) {
      list->set(*posture);
    } else {
      set_posture(*posture, program);
    }
  }

  /// The squared distance of q from `anchor`; whole turns do not count.
  double away(const Eigen::VectorXd& q) const {
    double sum = 0;
    for (Eigen::Index i = 0; i < q.size(); ++i) {
      const bool turns =
          problem.robot.joints[static_cast<std::size_t>(i)].type == JointType::kRevolute;
      const double d = q[i] - anchor[i];
      sum += turns ? std::pow(std::remainder(d, 2 * std::numbers::pi), 2) : d * d;
    }
    return sum;
  }

  /// Selects the IK solution nearest to `anchor`, the first of several equally near ones.
  void choose_nearest() {
    int nearest = 0;
    double least = kInfinity;
    for (int i = 0; i < model.ik_solutions(); ++i) {
      const double distance = away(model.select(i).q);
      if (distance >= least) continue;
      least = distance;
      nearest = i;
    }
    model.select(nearest);
  }

  void fill_rows() {
    if (list) {
      list->fill(w[0], rows.head(facets()));
    } else {
      f = program.tau_d;
      f.noalias() += program.JtW.lazyProduct(w);
      rows.head(facets()).noalias() = actuation().N.transpose() * f;
    }
    Eigen::Index row = facets();
    for (const int pair : pairs) {
      problem.robot.collision->nearest(posture->links, pair, near);
      rows[row++] = near.clearance;
    }
    for (const int joint : following) rows[row++] = posture->q[joint];
  }

  /// The derivatives of the clearances and of the dependent joints, from those of all joints.
  void differentiate_places() {
    null_motion(problem, *posture, A_r);
    const auto turns = A_r.bottomRows(posture->q.size());
    Eigen::Index row = facets();
    for (const int pair : pairs) {
      problem.robot.collision->nearest(posture->links, pair, near);
      auto slope_of_pair = by_theta_r.row(row++);
      slope_of_pair.setZero();
      if (near.on_a == near.on_b) continue;  // no derivative
      for (Eigen::Index joint = 0; joint < turns.rows(); ++joint) {
        if (turns.row(joint).isZero(0)) continue;  // it rests
        const double opens =
            clearance_slope(problem.robot, posture->links, near, static_cast<int>(joint));
        if (opens != 0) slope_of_pair += opens * turns.row(joint);
      }
    }
    for (const int joint : following) by_theta_r.row(row++) = turns.row(joint);
  }

  void differentiate_forces() {
    if (list) {
      list->differentiate(model, w[0], by_theta_r.topRows(facets()), by_w.topRows(facets()));
      return;
    }
    differentiate();
    by_theta_r.topRows(facets()).noalias() = actuation().N.transpose() * slopes;
    by_w.topRows(facets()).noalias() = actuation().N.transpose() * program.JtW;
  }

  /// The derivative of f = tau_d + J'W w at constant w. Row k is that of a capability with lambda =
  /// e_k.
  void differentiate() {
    seeds.w = w;
    for (Eigen::Index k = 0; k < slopes.rows(); ++k) {
      seeds.lambda.setZero(slopes.rows());
      seeds.lambda[k] = 1;
      fill_wrenches(*posture, program, seeds);
      model.pull_back(posture->theta_r, seeds, slope);
      slopes.row(k) = slope.transpose();
    }
  }

  const Problem& problem;
  PostureEvaluator model;
  WrenchProgram program;
  std::optional<ScenarioRows> list;  ///< of a task with a list of scenarios
  std::unique_ptr<Measure> measure;
  const std::vector<int> pairs, following;
  const Posture* posture = nullptr;
  Eigen::VectorXd anchor;  ///< joints of the current IK solution
  Capability capability, seeds;
  Eigen::VectorXd w, f, slope, c_w, w_min, w_max;
  Eigen::MatrixXd slopes;  ///< n×r
  ClosestPoints near;
  Eigen::MatrixXd A_r;  ///< n×r
  Eigen::VectorXd rows, row_min, row_max, row_unit;
  Eigen::MatrixXd by_theta_r, by_w;
};

bool has_facet_program(const Problem& problem, Wrench wrench) {
  const Zonotope& actuation = problem.robot.actuation;
  if (problem.motion || !actuation.has_facets || actuation.facet_pairs() > kMostPairs) return false;
  if (problem.scenarios.empty()) return true;
  const Eigen::Index rows = ScenarioRows::count(problem, wrench);
  return rows > 0 && rows <= kMostScenarioRows;
}

FacetProgram::FacetProgram(const Problem& problem, Wrench wrench, const MeasureMaker& make,
                           bool check_collision)
    : workspace_(std::make_unique<Workspace>(problem, wrench, make, check_collision)) {}
FacetProgram::~FacetProgram() = default;

const Eigen::VectorXd& FacetProgram::c_w() const { return workspace_->c_w; }
const Eigen::VectorXd& FacetProgram::w_min() const { return workspace_->w_min; }
const Eigen::VectorXd& FacetProgram::w_max() const { return workspace_->w_max; }
const Eigen::VectorXd& FacetProgram::row_min() const { return workspace_->row_min; }
const Eigen::VectorXd& FacetProgram::row_max() const { return workspace_->row_max; }
const Eigen::VectorXd& FacetProgram::row_unit() const { return workspace_->row_unit; }
Eigen::Index FacetProgram::force_rows() const { return workspace_->facets(); }
FacetSide FacetProgram::facet(Eigen::Index row) const {
  return workspace_->list ? workspace_->list->facet(row) : FacetSide{row, 1, {}};
}
const std::vector<int>& FacetProgram::pairs() const { return workspace_->pairs; }
const std::vector<int>& FacetProgram::following() const { return workspace_->following; }

int FacetProgram::ik_solutions(const Eigen::VectorXd& theta_r) {
  Workspace& ws = *workspace_;
  ws.posture = &ws.model.evaluate(theta_r);
  return ws.posture->status == Status::kValid ? ws.model.ik_solutions() : 0;
}

bool FacetProgram::set_out(const Eigen::VectorXd& theta_r, int ik_solution, Eigen::VectorXd& w) {
  Workspace& ws = *workspace_;
  if (ik_solution >= ik_solutions(theta_r)) return false;
  ws.posture = &ws.model.select(ik_solution);
  ws.anchor = ws.posture->q;
  ws.read_posture();
  ws.measure->evaluate(*ws.posture, ws.program, false, ws.capability);
  if (ws.capability.status == Status::kOptimal) {
    w = ws.capability.w;
  } else {
    w = Eigen::VectorXd::Zero(w_min().size()).cwiseMax(w_min()).cwiseMin(w_max());
  }
  return true;
}

bool FacetProgram::evaluate(const Eigen::VectorXd& theta_r, const Eigen::VectorXd& w) {
  Workspace& ws = *workspace_;
  if (!ws.place(theta_r)) return false;
  ws.w = w;
  ws.fill_rows();
  return true;
}

const Eigen::VectorXd& FacetProgram::rows() const { return workspace_->rows; }

void FacetProgram::linearize() {
  Workspace& ws = *workspace_;
  ws.anchor = ws.posture->q;
  ws.differentiate_forces();
  ws.differentiate_places();
}

const Eigen::MatrixXd& FacetProgram::by_theta_r() const { return workspace_->by_theta_r; }
const Eigen::MatrixXd& FacetProgram::by_w() const { return workspace_->by_w; }

}  // namespace maxwrench
