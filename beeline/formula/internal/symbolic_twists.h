#pragma once

#include <vector>

#include <beeline/formula/formula.h>
#include <beeline/formula/internal/symbolic_vector.h>

namespace beeline::internal {

/// A velocity of the tool and its angular velocity.
struct SymbolicTwist {
  ExpressionVector linear = {}, angular = {};
};

/// The transforms of an arm as one list, from the world to the tool. Place k is the frame before
/// transform k.
struct TransformList {
  std::vector<ElementaryTransform> transforms = {};
  std::vector<std::size_t> frames = {};  ///< the place of frame i of pose_between()
};
TransformList transform_list(const SymbolicArm& arm);

/// A variable of a transform, and its twist in the frame before the transform for unit rate of the
/// variable's coordinate.
struct OwnTwist {
  int coordinate = 0;
  SymbolicTwist twist = {};
};
std::vector<OwnTwist> own_twists(const SymbolicArm& arm, const ElementaryTransform& transform);

/// Returns the variables in a distance.
std::vector<int> variables_of(const SymbolicArm& arm, const Expression& distance);

/// A place in `list` where the velocity is taken, and a place whose axes express it.
struct TwistFrame {
  std::size_t origin = 0;
  std::size_t axes = 0;
};

/// Returns the twist for unit rate of each coordinate: of the point of the last link at the origin
/// of a place, in the axes of a place. Each twist is moved from its joint's frame through one
/// transform after another, so its size is the size of the result.
std::vector<SymbolicTwist> symbolic_twists(const SymbolicArm& arm, const TransformList& list,
                                           const TwistFrame& frame);

}  // namespace beeline::internal
