#pragma once

#include <vector>

#include <beeline/pose/se3.h>

namespace beeline {

/// An arm in the form that its kernels run through: every joint turns about, slides along or does
/// both along the z axis of its own frame, so that one formula serves all kinds,
///     T(q) = base * L_1 ... L_n * tool,
///     L_i = move(step) * turn_x(alpha) * turn_z(rest_angle + turn * q_k) * move_z(travel * q_k),
/// k = coordinate.
/// This is Denavit-Hartenberg's form (modified; Craig 1986) but for `step`, which need not follow
/// the common normal: nothing grows without bounds where axes are nearly parallel.
struct Chain {
  struct Link {
    double cos_alpha = 1, sin_alpha = 0;  ///< from the z axis before to this joint's, about x
    Vector3 step = Vector3::Zero();       ///< metres, from the origin before, in its axes
    double rest_angle = 0;                ///< radians
    double turn = 0;                      ///< radians for each unit of the coordinate; 0: slides
    double travel = 0;                    ///< metres for each unit of the coordinate; 0: revolute
    int coordinate = 0;                   ///< which q drives it: mimic joints share one
  };
  Pose base = Pose::Identity();  ///< of the frame whose z axis is joint 1's, in the world
  std::vector<Link> links;
  Pose tool = Pose::Identity();  ///< in the last joint's frame
};

/// The links' angles side by side, filled up to a multiple of eight by links that stand still:
/// kernels take all sines and cosines of a configuration together. The rest angles are added to
/// these, as many turns away their sum with q would lose digits.
struct ChainAngles {
  std::vector<double> turn, cos_rest, sin_rest;
  bool in_order = true;  ///< link i is driven by coordinate i
};
ChainAngles angles_of(const Chain& chain);

class Arm;

/// The arm's kinematics in that form, equal but for rounding.
Chain chain_of(const Arm& arm);

/// Where a joint's axis is in the world when every coordinate is zero.
struct JointAxis {
  Vector3 direction;
  Vector3 point;
};
std::vector<JointAxis> axes_of(const Chain& chain);

/// The same motion with each link frame's origin at the point given, and its z axis along the
/// direction given, which is the joint's own or its opposite.
Chain chain_through(const Chain& chain, const std::vector<JointAxis>& axes);

}  // namespace beeline
