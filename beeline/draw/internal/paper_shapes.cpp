#include <beeline/draw/internal/paper_shapes.h>

namespace beeline::internal {

PaperPath open_path(const std::vector<PaperPoint>& points) {
  PaperPath path;
  for (const PaperPoint& p : points) path.verbs.empty() ? path.move(p) : path.line(p);
  return path;
}

PaperPath closed_path(const std::vector<PaperPoint>& points) {
  PaperPath path = open_path(points);
  path.close();
  return path;
}

PaperPath ellipse(const PaperPoint& centre, const PaperPoint& semi_axis,
                  const PaperPoint& other_semi_axis) {
  const PaperPoint &u = semi_axis, &v = other_semi_axis;
  constexpr double k = 0.5522847498;  // a Bezier curve within 3e-4 of a quarter of the unit circle
  PaperPath path;
  path.move(centre + u);
  path.curve(centre + u + k * v, centre + v + k * u, centre + v);
  path.curve(centre + v - k * u, centre - u + k * v, centre - u);
  path.curve(centre - u - k * v, centre - v - k * u, centre - v);
  path.curve(centre - v + k * u, centre + u - k * v, centre + u);
  path.close();
  return path;
}

PaperStroke line_stroke(const PaperPoint& from, const PaperPoint& to, const Colour& colour,
                        double width, const std::vector<double>& dashes) {
  return {open_path({from, to}), no_colour, colour, width, dashes};
}

void PaperBox::include(const PaperPoint& p, const PaperPoint& around) {
  low = low.cwiseMin(p - around);
  high = high.cwiseMax(p + around);
}

}  // namespace beeline::internal
