#pragma once

#include <vector>

#include <beeline/draw/internal/projection.h>

namespace beeline::internal {

/// The projection of an axis: its direction on paper and its component towards the viewer.
struct ProjectedAxis {
  PaperPoint along;  ///< unit direction on paper
  double flat;       ///< length on paper of the unit axis, in [0, 1]
  double towards;    ///< component towards the viewer, in [0, 1]
  double sign;       ///< -1 if the axis was reversed to point towards the viewer
};
ProjectedAxis projected_axis(const Vector3& axis, const Projection& projection);

/// Colours and line width of a solid, points.
struct SolidStyle {
  Colour fill = paper_white;
  Colour line = ink;
  double line_width = 1.1;
};

/// Draws a cylinder about `centre`, from -`half` to `half` along the axis, with or without a
/// thread.
void cylinder(const PaperPoint& centre, const ProjectedAxis& axis, double radius, double half,
              const SolidStyle& style, bool thread, std::vector<PaperMark>& marks);

/// Draws the visible faces of a box with these half lengths along and across `axis`.
void box(const PaperPoint& centre, const Vector3& axis, double length, double breadth,
         const Projection& projection, const SolidStyle& style, std::vector<PaperMark>& marks);

/// Draws a line with an arrowhead at its end. The shaft ends inside the head, so that the tip is
/// sharp.
void arrow(std::vector<PaperPoint> points, const Colour& colour, double width, double pen,
           const std::vector<double>& dashes, std::vector<PaperMark>& marks);
double head_size(double width);  ///< length of the arrowhead for a line width, points

/// Returns the colour times `light` < 1.
Colour shaded(const Colour& colour, double light);

PaperStroke outlined(PaperPath path, const Colour& fill, const Colour& line, double width);

}  // namespace beeline::internal
