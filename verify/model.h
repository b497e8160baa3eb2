#pragma once

#include "verify/coordinates.h"
#include "verify/form.h"

namespace maxwrench {

/// The robot of a static task: all its rows as forms in the coordinates of a posture, by recursion
/// along the tree. What the end effector's pose fixes, gravity and wrenches, is carried from its
/// axes towards the base, and what the base fixes the other way, once through each joint, so no
/// joint is met twice.
///
/// Where the base follows in closed form, all is carried to the base: it has six free axes, or
/// those along which all of this happens. Else the base has a yaw of its own, which with what is
/// behind it fixes its rows and those of joints beside the chain. Off the postures, where the
/// equations do not hold, the two differ.
class FormModel {
 public:
  /// Keeps a reference. Throws std::invalid_argument, in one line, for other tasks.
  explicit FormModel(const Problem& problem);
  explicit FormModel(const Problem&&) = delete;
  FormModel(const FormModel&) = delete;

  const PostureCoordinates& coordinates() const { return coordinates_; }
  const FormShape& shape() const { return shape_; }
  /// The largest |q| within limits, of each variable.
  const std::vector<double>& far() const { return far_; }

  /// tau_d, n: what gravity and buoyancy take (eq:dynamics at rest).
  std::vector<Form> tau_d() const;
  /// J'h, n, of a wrench at the end effector in world axes, where its pose leaves nothing free;
  /// turned with it, if the task's wrenches are.
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

  FormVector constant(const Eigen::Vector3d& x) const;
  FormMatrix matrix(const Eigen::Matrix3d& R) const;
  /// A turn about an axis by a variable.
  FormMatrix turn(int axis, int variable) const;
  Form sliding(int variable) const { return Form(shape_, variable, 0.0L, 1.0L, 0.0L); }
  /// A point of link a, in its axes, seen in those of link b; or a direction.
  FormVector seen(int a, FormVector x, int b, bool point = true) const;
  /// A point in link axes -> in those of a pose on that link.
  FormVector into(const Pose<double>& pose, const FormVector& x) const;
  /// The end effector's pose (R, p) in the world.
  const FormMatrix& pose_turn() const { return pose_R_; }
  FormVector pose_place() const;
  /// A point or a direction in the world -> in the end effector's axes.
  FormVector into_pose(const FormVector& x, bool point) const;

  /// How much the length of a vector may shrink, as a share, on its way from the end effector to
  /// the base: rotations of rounded numbers.
  long double shrinking() const;

 private:
  struct Place {
    FormMatrix R;
    FormVector p;
  };
  Place place_of(std::size_t joint) const;
  void set_pose();
  std::array<FormVector, 2> to_base(int link, FormVector along, FormVector about) const;
  std::array<FormVector, 2> from_end_effector(const Vector6d& h) const;
  void weigh_links();
  void weigh();
  void weigh_from_base();
  void sum_total();
  Form held_by(std::size_t joint) const;  ///< its row of tau_d
  void exert_on_base(const Vector6d& h, std::vector<Form>& rows) const;
  FormVector from_world(const FormVector& x) const;  ///< a direction -> in base axes, by its yaw
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
  FormVector shift_;           ///< of the pose, by what is free
  std::vector<Place> places_;  ///< of each joint: parent link -> link
  std::vector<Wide> mass_;     ///< kg, wet, of each link
  std::vector<Wide> carried_;  ///< kg, with all that a link carries
  /// First moment about its origin of each link, with all that it carries, but for the chain.
  std::vector<FormVector> moment_;
  std::vector<FormVector> pull_;   ///< gravity in link axes
  std::vector<FormVector> load_;   ///< moment of the carried weights about the link's origin
  std::vector<FormVector> total_;  ///< of all weights, about links of the chain
};

}  // namespace maxwrench
