#pragma once

#include <beeline/draw/internal/projection.h>

namespace beeline::internal {

/// Draws a primitive on paper, except labels, which place_labels() draws.
void draw(const Primitive& shape, const Projection& projection, std::vector<PaperMark>& marks);

/// A point of a primitive, and the size on paper of the primitive around it at any scale.
struct Footprint {
  Vector3 at = Vector3::Zero();
  PaperPoint around = PaperPoint::Zero();  ///< half size, points
};
void add_footprints(const Primitive& shape, double pen, std::vector<Footprint>& footprints);

/// Returns the depth of the primitive's centre towards the viewer, to draw from far to near.
double depth(const Primitive& shape, const Projection& projection);

}  // namespace beeline::internal
