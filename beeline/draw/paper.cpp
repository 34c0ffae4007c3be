#include <beeline/draw/internal/text.h>
#include <beeline/draw/paper.h>

namespace beeline {
using namespace internal;

void Path::move(const Point& p) {
  verbs.push_back(Verb::move);
  points.push_back(p);
}

void Path::line(const Point& p) {
  verbs.push_back(Verb::line);
  points.push_back(p);
}

void Path::curve(const Point& a, const Point& b, const Point& p) {
  verbs.push_back(Verb::curve);
  points.insert(points.end(), {a, b, p});
}

void Path::close() { verbs.push_back(Verb::close); }

Path open_path(const std::vector<Point>& points) {
  Path path;
  for (const Point& p : points) path.verbs.empty() ? path.move(p) : path.line(p);
  return path;
}

Path closed_path(const std::vector<Point>& points) {
  Path path = open_path(points);
  path.close();
  return path;
}

Path ellipse(const Point& centre, const Point& semi_axis, const Point& other_semi_axis) {
  const Point &u = semi_axis, &v = other_semi_axis;
  constexpr double k = 0.5522847498;  // a Bezier curve within 3e-4 of a quarter of the unit circle
  Path path;
  path.move(centre + u);
  path.curve(centre + u + k * v, centre + v + k * u, centre + v);
  path.curve(centre + v - k * u, centre - u + k * v, centre - u);
  path.curve(centre - u - k * v, centre - v - k * u, centre - v);
  path.curve(centre - v + k * u, centre + u - k * v, centre + u);
  path.close();
  return path;
}

Path circle(const Point& centre, double radius) {
  return ellipse(centre, {radius, 0}, {0, radius});
}

Stroke line_stroke(const Point& from, const Point& to, const Colour& colour, double width,
                   const std::vector<double>& dashes) {
  return {open_path({from, to}), no_colour, colour, width, dashes};
}

void Box::include(const Point& p, const Point& around) {
  low = low.cwiseMin(p - around);
  high = high.cwiseMax(p + around);
}

Box box_of(const Mark& mark) {
  Box box;
  if (const auto* stroke = std::get_if<Stroke>(&mark)) {
    const double rim = stroke->line.alpha > 0 ? stroke->width / 2 : 0;
    for (const Point& p : stroke->path.points) box.include(p, {rim, rim});
  } else {
    const Text& text = std::get<Text>(mark);
    Point half = text_size(text.text, text.size, text.bold) / 2;
    if (text.upright) std::swap(half.x(), half.y());
    box.include(text.centre, half);
  }
  return box;
}

}  // namespace beeline
