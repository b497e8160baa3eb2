#pragma once

#include "maxwrench/problem.h"
#include "verify/coordinates.h"
#include "verify/form.h"

namespace maxwrench {

/// A pose as forms.
struct FormPose {
  FormMatrix R;
  FormVector p;
};

/// The robot of a static task: all its rows as forms in the coordinates of a posture, computed by
/// recursion along the tree. Gravity and wrenches depend on the end effector's pose. They are
/// carried from its axes towards the base, and quantities that depend on the base are carried the
/// other way. Each passes each joint once, so no joint occurs twice in a product.
///
/// If the base's pose has a closed form, everything is carried to the base, which has six free axes
/// or all axes that these motions need. Otherwise the base has a yaw of its own. The rows of the
/// base and of joints outside the chain are then computed from this yaw and from the joints after
/// it. The two ways give different values only where the equations do not hold, away from postures.
class FormModel {
 public:
  /// Keeps a reference to the problem. Throws std::invalid_argument, in one line, for other tasks.
  explicit FormModel(const Problem& problem);
  /// The same with other coordinates.
  FormModel(const Problem& problem, const CoordinateChoice& choice)
      : FormModel(problem, nullptr, choice) {}
  explicit FormModel(const Problem&&) = delete;
  /// The same robot with these wet masses in place of its own.
  FormModel(const Problem& problem, const std::vector<LinkLoad>& loads)
      : FormModel(problem, &loads) {}
  FormModel(const FormModel&) = delete;

  const PostureCoordinates& coordinates() const { return coordinates_; }
  const FormShape& shape() const { return shape_; }
  /// The largest |q| within the limits of each variable.
  const std::vector<double>& far() const { return far_; }

  /// tau_d, n: the load of gravity and buoyancy (eq:dynamics at rest).
  std::vector<Form> tau_d() const;
  /// J'h, n, for a wrench h at the end effector in world axes. If the task's wrenches turn with the
  /// end effector, h is given at `Problem::pose` and turned with it.
  std::vector<Form> exerted(const Vector6d& h) const;
  /// A, n rows: a force F of a second contact, in base axes, adds A F to tau. Depends on the joints
  /// of the second arm only.
  std::vector<FormVector> levers() const;
  /// J_2'C_2 w, n, with the wrench w = low + omega (high - low) of a second contact, where omega
  /// are the shares.
  std::vector<Form> contact_load(const Eigen::VectorXd& low, const Eigen::VectorXd& high) const;
  /// The frame of the second contact in the world, at its regrasp coordinates.
  FormPose contact_frame() const;
  /// The force of a wrench c, or its torque if not `force`, in base axes.
  FormVector along_at_base(const Vector6d& c, bool force) const;
  /// [linear; angular] velocity of the base when the end effector moves by c as one body with the
  /// base: y with J_b y = c, so c'h = y'J_b'h.
  std::array<FormVector, 2> carrying() const;
  /// The same for joint i: J_i = J_b K_i', so J_i'h = K_i J_b'h. Zero for a joint that does not
  /// move the end effector.
  std::array<FormVector, 2> screw(std::size_t joint) const;
  /// c'h due to the weight of all links, if the base exerts nothing: -y'tau_b.
  Form weight_along_c() const;
  /// The effort of joint i in this case, tau_i - K_i tau_b.
  Form weight_at(std::size_t joint) const;

  FormVector constant(const Eigen::Vector3d& x) const;
  FormMatrix matrix(const Eigen::Matrix3d& R) const;
  /// A rotation about an axis by a variable.
  FormMatrix turn(int axis, int variable) const;
  Form sliding(int variable) const { return Form(shape_, variable, 0.0L, 1.0L, 0.0L); }
  /// Converts a point, or a direction, from the axes of link a to those of link b.
  FormVector seen(int a, FormVector x, int b, bool point = true) const;
  /// Converts a point from link axes to the axes of a pose on that link.
  FormVector into(const Pose<double>& pose, const FormVector& x) const;
  /// The end effector's pose (R, p) in the world.
  const FormMatrix& pose_turn() const { return pose_R_; }
  FormVector pose_place() const;
  /// Converts a point or a direction from the world to the end effector's axes.
  FormVector into_pose(const FormVector& x, bool point) const;

  /// The largest share by which the length of a vector may shrink on its way from the end effector
  /// to the base, because the rotations have rounded entries.
  long double shrinking() const;

 private:
  FormPose place_of(std::size_t joint) const;
  void set_pose();
  std::array<FormVector, 2> to_base(int link, FormVector along, FormVector about) const;
  std::array<FormVector, 2> from_end_effector(const Vector6d& h) const;
  FormModel(const Problem& problem, const std::vector<LinkLoad>* loads,
            const CoordinateChoice& choice = {});
  void weigh_links(const std::vector<LinkLoad>* loads);
  void weigh();
  void weigh_from_base();
  void sum_total();
  Form held_by(std::size_t joint) const;  ///< the joint's row of tau_d
  void exert_on_base(const Vector6d& h, std::vector<Form>& rows) const;
  FormVector from_world(const FormVector& x) const;  ///< direction to base axes, by the yaw
  /// What a force and a torque in base axes add to tau at the second end effector.
  std::vector<Form> exerted_by_contact(const FormVector& force, const FormVector& torque) const;
  FormVector inboard(std::size_t link, const FormVector& before) const;
  int parent(std::size_t link) const { return problem_.robot.joints[link - 1].parent; }
  const EndEffector& tip() const {
    return problem_.robot.end_effectors[static_cast<std::size_t>(problem_.end_effector)];
  }

  const Problem& problem_;
  PostureCoordinates coordinates_;
  FormShape shape_;
  std::vector<char> on_chain_;  ///< links between base and end effector
  std::vector<double> far_;
  FormMatrix pose_R_;
  FormVector shift_;              ///< displacement of the pose by its free coordinates
  std::vector<FormPose> places_;  ///< of each joint: parent link -> link
  std::vector<Wide> mass_;        ///< kg, wet, of each link
  std::vector<Wide> carried_;     ///< kg, with all that a link carries
  /// First moment of each link about its origin, with all that it carries except the chain.
  std::vector<FormVector> moment_;
  std::vector<FormVector> pull_;   ///< gravity in link axes
  std::vector<FormVector> load_;   ///< moment of the carried weights about the link's origin
  std::vector<FormVector> total_;  ///< moment of all weights, about links of the chain
};

}  // namespace maxwrench
