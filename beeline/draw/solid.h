#pragma once

#include <vector>

#include <beeline/draw/projection.h>

namespace beeline {

/// The direction on paper of an axis seen in projection, and how much of it points at the viewer.
struct Seen {
  Point along;     ///< of unit length
  double flat;     ///< length on paper of a unit of the axis, in [0, 1]
  double towards;  ///< in [0, 1]: the axis is turned to the viewer if need be
  double sign;     ///< -1 where it was turned
};
Seen seen(const Vector3& axis, const Projection& projection);

/// How solid things look on paper; all sizes in points.
struct Finish {
  Colour fill = paper_white;
  Colour line = ink;
  double line_width = 1.1;
};

/// A cylinder whose middle is at `centre`, `half` its height to either side; with a thread or not.
void cylinder(const Point& centre, const Seen& axis, double radius, double half,
              const Finish& finish, bool thread, std::vector<Mark>& marks);

/// A box along `axis`, these half lengths along and across it: the faces that are turned to us.
void box(const Point& centre, const Vector3& axis, double length, double breadth,
         const Projection& projection, const Finish& finish, std::vector<Mark>& marks);

/// A line with a head at its end; the shaft ends inside the head, so that the tip is sharp.
void arrow(std::vector<Point> points, const Colour& colour, double width, double pen,
           const std::vector<double>& dashes, std::vector<Mark>& marks);
double head_size(double width);  ///< the head's length for a line's width

/// Darker by the factor `light` < 1.
Colour shaded(const Colour& colour, double light);

Stroke outlined(Path path, const Colour& fill, const Colour& line, double width);

}  // namespace beeline
