#pragma once

#include <limits>
#include <vector>

#include <beeline/model/arm.h>

namespace beeline::internal {

/// The arm's chain prepared for the kernels: values that are the identity or zero to rounding
/// (1e-15 of the arm's size) are marked, so that the kernels omit them. Real is double or float.
template <class Real>
struct BatchPlan {
  /// A rotation about x: none, by -90 degrees, or by another angle.
  enum class XRotation { none, minus_quarter, other };

  /// Trans(translation) Rot_x(alpha)
  struct Constant {
    Real translation[3] = {0, 0, 0};
    bool translates[3] = {false, false, false};  ///< for each component, whether it is not zero
    XRotation rotation = XRotation::none;
    Real cos_alpha = 1, sin_alpha = 0;
  };
  /// Chain::Link. theta at q = 0 is (half_turns - rounder) pi + remainder.
  struct Link {
    Constant constant;
    int coordinate = 0;
    Real theta_per_q = 0, d_per_q = 0;
    bool rotates = false, translates = false;  ///< whether theta varies; whether d varies
    bool unit_rate = false;                    ///< theta_per_q is 1
    /// Numbers of this size have no fraction: adding and subtracting it rounds to an integer.
    static constexpr Real rounder = std::numeric_limits<Real>::digits == 53
                                        ? static_cast<Real>(0x1.8p52)
                                        : static_cast<Real>(0x1.8p23);
    Real half_turns = rounder;
    Real remainder = 0, remainder_by_pi = 0;
    bool has_remainder = false;
    Real cos_offset = 1, sin_offset = 0;  ///< cosine and sine of theta at q = 0
  };
  /// The upper three rows of a pose, column by column.
  struct Columns {
    Real number[12];
  };

  Columns base;  ///< includes the first link's Constant
  std::vector<Link> links;
  Constant tool;  ///< the tool's transform, before Rot_z
  bool rotates_tool = false;
  Real cos_tool = 1, sin_tool = 0;    ///< cosine and sine of the angle of this Rot_z
  std::vector<Columns> frame_T_link;  ///< links 1 to n in the frames of the chain
  Columns base_link;                  ///< link 0 in the world
  int dof = 0;
  bool in_order = true;  ///< whether coordinate i drives link i
  bool planar = false;   ///< all axes are exactly the world's z axis or its opposite

  explicit BatchPlan(const Arm& arm);
};

}  // namespace beeline::internal
