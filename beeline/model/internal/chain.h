#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include <beeline/model/arm.h>
#include <beeline/model/internal/kept_objects.h>

namespace beeline::internal {

/// An arm in the form that the kernels use. Every joint rotates about the z axis of its own frame,
/// translates along it, or does both, so one formula holds for all joint types:
///     T(q) = base * L_1(q) ... L_n(q) * tool,
///     L_i(q) = Trans(translation) Rot_x(alpha) Rot_z(theta) Trans_z(d),
///     theta = theta_offset + theta_per_q * q_k,  d = d_per_q * q_k,  k = coordinate.
/// These are the modified Denavit-Hartenberg parameters (Craig, "Introduction to Robotics", 1986),
/// except that `translation` is a vector instead of the length a along the common normal: it stays
/// bounded where neighbouring axes are nearly parallel.
struct Chain {
  struct Link {
    double cos_alpha = 1, sin_alpha = 0;    ///< angle about x between the two z axes
    Vector3 translation = Vector3::Zero();  ///< of the origin, in the frame before, metres
    double theta_offset = 0;                ///< theta at q = 0, rad
    double theta_per_q = 0;  ///< d theta / d q, rad per unit of q; 0 for a prismatic joint
    double d_per_q = 0;      ///< d d / d q, metres per unit of q; 0 for a revolute joint
    int coordinate = 0;      ///< the index of its coordinate; mimic joints share their leader's
  };
  Pose base = Pose::Identity();  ///< world_T_0: a frame whose z axis is parallel to joint 1's
  std::vector<Link> links;
  Pose tool = Pose::Identity();  ///< n_T_tool: the tool in the frame of the last joint
};

/// Trans(translation) Rot_x(alpha), the part of L_i that does not depend on q.
Pose constant_transform(const Chain::Link& link);

/// Rot_z(theta) Trans_z(d), the part of L_i that depends on q, at the coordinate's value q.
Pose joint_motion(const Chain::Link& link, double q);

/// L_i(q), the product of the two.
Pose link_transform(const Chain::Link& link, double q);

/// The angles of all links as arrays, padded to a multiple of eight with links that do not move, so
/// that the kernels compute all sines and cosines of a configuration together. theta_offset enters
/// by the addition theorems, not by a sum: if q is many revolutions, theta_offset + q loses digits.
struct ChainAngles {
  std::vector<double> theta_per_q, cos_offset, sin_offset;
  bool in_order = true;  ///< link i is driven by coordinate i
};
ChainAngles angles_of(const Chain& chain);

/// What follows from an arm, see Arm::Memory: its data for the kernels, and what other layers keep.
struct ArmMemory {
  ArmMemory(Chain arm_chain, ChainAngles chain_angles);

  Chain chain;
  ChainAngles angles;
  KeptObjects of_arm;
  /// What does not depend on limits, and what does not depend on the tool either. Arms that differ
  /// in these share it.
  std::shared_ptr<KeptObjects> of_geometry, of_links;
  std::atomic<int> arms = 1;  ///< number of copies of the arm

  static ArmMemory& of(const Arm& arm) { return *arm.memory_; }

  /// Shares what the arm has in common with `other`, from which it differs in its tool or, if
  /// `same_tool`, in limits only.
  static void share(const Arm& other, bool same_tool, Arm& arm) {
    of(arm).of_links = of(other).of_links;
    if (same_tool) of(arm).of_geometry = of(other).of_geometry;
  }
};

/// Returns the chain of the arm. Both give the same poses, to rounding.
inline const Chain& chain_of(const Arm& arm) { return ArmMemory::of(arm).chain; }
inline const ChainAngles& chain_angles_of(const Arm& arm) { return ArmMemory::of(arm).angles; }

/// Computes the chain of an arm under construction.
Chain make_chain(const Arm& arm);

}  // namespace beeline::internal
