#pragma once

#include "maxwrench/problem.h"
#include "verify/form.h"

namespace maxwrench {

/// The robot of a static task with one contact, whose base follows from theta_r in closed form: all
/// its rows as forms in theta_r, by recursion along the tree. What the end effector's pose fixes,
/// gravity and wrenches, is carried from its axes to the base, and what the base fixes the other
/// way, once through each joint, so no joint is met twice. The base has six free axes, or those
/// along which all of this happens.
class FormModel {
 public:
  /// Keeps a reference. Throws std::invalid_argument, in one line, for other tasks.
  explicit FormModel(const Problem& problem);
  explicit FormModel(const Problem&&) = delete;
  FormModel(const FormModel&) = delete;

  const FormShape& shape() const { return shape_; }
  /// The largest |q| within limits, of each variable.
  const std::vector<double>& far() const { return far_; }

  /// tau_d, n: what gravity and buoyancy take (eq:dynamics at rest).
  std::vector<Form> tau_d() const;
  /// J'h, n, of a wrench at the end effector in world axes.
  std::vector<Form> exerted(const Vector6d& h) const;
  /// The force of c (or, if not `force`, its torque) in base axes.
  FormVector along_at_base(bool force) const;
  /// [linear; angular] of the base when the end effector moves by c as if they were one body: y
  /// with J_b y = c, so c'h = y'J_b'h.
  std::array<FormVector, 2> carrying() const;
  /// The same of joint i: J_i = J_b K_i', so J_i'h = K_i J_b'h; zero of one that does not move the
  /// end effector.
  std::array<FormVector, 2> screw(std::size_t joint) const;
  /// c'h where the base exerts nothing, by the weight of all: -y'tau_b.
  Form weight_along_c() const;
  /// The effort of joint i there, tau_i - K_i tau_b.
  Form weight_at(std::size_t joint) const;
  /// A point of link a, in its axes, seen in those of link b.
  FormVector seen(int a, const Eigen::Vector3d& point, int b) const;
  /// A point in link axes -> in those of a pose on that link.
  FormVector into(const Pose<double>& pose, const FormVector& x) const;
  /// How much the length of a vector may shrink, as a share, on its way from the end effector to
  /// the base: rotations of rounded numbers.
  long double shrinking() const;

 private:
  struct Place {
    FormMatrix R;
    FormVector p;
  };
  FormVector constant(const Eigen::Vector3d& x) const;
  FormMatrix matrix(const Eigen::Matrix3d& R) const;
  Place place_of(std::size_t joint) const;
  std::array<FormVector, 2> to_base(int link, FormVector along, FormVector about) const;
  std::array<FormVector, 2> from_end_effector(const Vector6d& h) const;
  void weigh();
  void weigh_links();
  void sum_total();
  Form held_by(std::size_t joint) const;  ///< its row of tau_d
  FormVector inboard(std::size_t link, const FormVector& before) const;
  int parent(std::size_t link) const { return problem_.robot.joints[link - 1].parent; }

  const Problem& problem_;
  FormShape shape_;
  std::vector<int> variable_;   ///< of each joint; -1: it rests
  std::vector<char> on_chain_;  ///< links between base and end effector
  std::vector<double> far_;
  std::vector<Place> places_;       ///< of each joint: parent link -> link
  std::vector<Wide> mass_;          ///< kg, wet, of each link
  std::vector<FormVector> moment_;  ///< its first moment about its origin
  std::vector<Wide> carried_;       ///< kg, with all that a link carries
  std::vector<FormVector> pull_;    ///< gravity in link axes
  std::vector<FormVector> load_;    ///< moment of the carried weights about the link's origin
  std::vector<FormVector> total_;   ///< of all weights, about links of the chain
};

}  // namespace maxwrench
