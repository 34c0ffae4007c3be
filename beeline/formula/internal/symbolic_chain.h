#pragma once

#include <cstddef>
#include <string>

#include <beeline/formula/formula.h>
#include <beeline/formula/internal/symbolic_vector.h>

namespace beeline::internal {

/// A product of elementary transforms. Consecutive rotations about parallel axes become one
/// rotation by the sum of their angles, so products of cosines of these angles do not arise.
class SymbolicPose {
 public:
  explicit SymbolicPose(const SymbolicArm& arm) : arm_(&arm) {}

  void append(const ElementaryTransform& transform);

  ExpressionRotation rotation() const;
  const ExpressionVector& position() const { return position_; }

  /// The completed rotations. Each rotation about another axis adds one.
  const ExpressionRotation& closed() const { return closed_; }

 private:
  void rotate(int axis, int symbol, int multiple);

  const SymbolicArm* arm_;
  ExpressionRotation closed_ = identity_rotation();  ///< the product of all completed rotations
  int axis_ = -1;  ///< axis of the rotation that is being summed, in the frame of closed_; -1: none
  Angle angle_ = {};                                   ///< angle of this rotation
  ExpressionRotation constant_ = identity_rotation();  ///< exact rotation after it
  ExpressionVector position_ = {};
};

/// Returns the pose of frame `to` in frame `from`, the product of the transforms from <= i < to.
/// Frame 0 is the world, frame i + 1 link i, frame n + 2 the tool. Throws Error when the entries
/// have more than `options.max_symbols` symbols.
SymbolicPose pose_between(const SymbolicArm& arm, std::size_t from, std::size_t to);

/// Returns the rotation about an axis by k * 15 degrees.
ExpressionRotation exact_rotation(int axis, int k);

/// Returns 1 or -1 if v is that multiple of the unit vector along the axis, else 0.
int sign_along(const ExpressionVector& v, int axis);

/// Sets SymbolicArm::groups.
void assign_groups(SymbolicArm& arm);

/// The sum of Expression::size() of all entries.
std::size_t size_of(const ExpressionRotation& rotation);
std::size_t size_of(const ExpressionVector& vector);

/// Throws Error for more than `options.max_symbols` symbols: "the pose of link 7 has more than
/// ...".
void check_size(const SymbolicArm& arm, std::size_t symbols, const std::string& what);

}  // namespace beeline::internal
