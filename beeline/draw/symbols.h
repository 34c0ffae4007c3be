#pragma once

#include <beeline/draw/projection.h>

namespace beeline {

/// Draws a primitive on paper. Labels are left out: place_labels() puts them where there is room.
void draw(const Primitive& shape, const Projection& projection, std::vector<Mark>& marks);

/// How far a primitive reaches around some of its points, on paper, whatever the scale.
struct Foot {
  Vector3 at = Vector3::Zero();
  Point around = Point::Zero();  ///< points, to either side
};
void add_feet(const Primitive& shape, double pen, std::vector<Foot>& feet);

/// The distance of the middle of a primitive towards the viewer, to draw far things first.
double depth(const Primitive& shape, const Projection& projection);

}  // namespace beeline
