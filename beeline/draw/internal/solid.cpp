#include <algorithm>
#include <cmath>

#include <beeline/draw/internal/paper_shapes.h>
#include <beeline/draw/internal/solid.h>

namespace beeline::internal {
namespace {

void arrowhead(const PaperPoint& tip, const PaperPoint& direction, double size,
               const Colour& colour, std::vector<PaperMark>& marks) {
  const PaperPoint across(-direction.y(), direction.x());
  marks.emplace_back(outlined(
      closed_path({tip, tip - size * direction + 0.38 * size * across, tip - 0.8 * size * direction,
                   tip - size * direction - 0.38 * size * across}),
      colour, no_colour, 0));
}

Rotation box_axes(const Vector3& axis) {
  const Vector3 other = std::abs(axis.z()) < 0.9 ? Vector3::UnitZ() : Vector3::UnitX();
  Rotation axes;
  axes.col(0) = axis;
  axes.col(1) = other.cross(axis).normalized();
  axes.col(2) = axis.cross(axes.col(1));
  return axes;
}

}  // namespace

ProjectedAxis projected_axis(const Vector3& axis, const Projection& projection) {
  const double towards = projection.depth(axis);
  const double sign = towards < -1e-12 ? -1 : 1;
  const PaperPoint on_paper = sign * projection.direction(axis);
  const double flat = on_paper.norm();
  return {flat > 1e-9 ? PaperPoint(on_paper / flat) : PaperPoint(0, -1), flat, std::abs(towards),
          sign};
}

Colour shaded(const Colour& colour, double light) {
  return {colour.red * light, colour.green * light, colour.blue * light, colour.alpha};
}

PaperStroke outlined(PaperPath path, const Colour& fill, const Colour& line, double width) {
  return {std::move(path), fill, line, width, {}};
}

void cylinder(const PaperPoint& centre, const ProjectedAxis& axis, double radius, double half,
              const SolidStyle& style, bool thread, std::vector<PaperMark>& marks) {
  const PaperPoint across = radius * PaperPoint(-axis.along.y(), axis.along.x());
  const PaperPoint rise = half * axis.flat * axis.along;
  const PaperPoint cap = radius * axis.towards * axis.along;
  const Colour side = shaded(style.fill, 0.86);
  const auto line = [&](const PaperPoint& from, const PaperPoint& to, double width) {
    marks.emplace_back(outlined(open_path({from, to}), no_colour, style.line, width));
  };
  marks.emplace_back(
      outlined(ellipse(centre - rise, across, cap), side, style.line, style.line_width));
  marks.emplace_back(outlined(closed_path({centre - rise + across, centre + rise + across,
                                           centre + rise - across, centre - rise - across}),
                              side, no_colour, 0));
  line(centre - rise + across, centre + rise + across, style.line_width);
  line(centre - rise - across, centre + rise - across, style.line_width);
  for (const double height : {-0.75, -0.25, 0.25}) {
    if (!thread || axis.flat < 0.3) break;
    line(centre + height * rise - across, centre + (height + 0.5) * rise + across,
         0.7 * style.line_width);
  }
  if (axis.towards < 0.05) {  // seen from the side, the body covers half of the far cap's line
    line(centre - rise - across, centre - rise + across, style.line_width);
  }
  marks.emplace_back(
      outlined(ellipse(centre + rise, across, cap), style.fill, style.line, style.line_width));
  if (thread && axis.flat < 0.3) {
    const PaperPoint slash = radius * PaperPoint(0.7071, -0.7071);
    line(centre - slash, centre + slash, 0.8 * style.line_width);
  } else if (axis.towards > 0.25) {
    marks.emplace_back(
        outlined(ellipse(centre + rise, 0.24 * across, 0.24 * cap), style.line, no_colour, 0));
  }
}

void box(const PaperPoint& centre, const Vector3& axis, double length, double breadth,
         const Projection& projection, const SolidStyle& style, std::vector<PaperMark>& marks) {
  const Rotation axes = box_axes(axis);
  const Vector3 half(length, breadth, breadth);
  for (int normal = 0; normal < 3; ++normal) {
    const double towards = projection.depth(axes.col(normal));
    if (std::abs(towards) < 1e-3) continue;
    const Vector3 out = std::copysign(half[normal], towards) * axes.col(normal);
    const int a = (normal + 1) % 3, b = (normal + 2) % 3;
    const PaperPoint middle = centre + projection.direction(out);
    const PaperPoint u = half[a] * projection.direction(axes.col(a));
    const PaperPoint v = half[b] * projection.direction(axes.col(b));
    marks.emplace_back(outlined(
        closed_path({middle + u + v, middle + u - v, middle - u - v, middle - u + v}),
        shaded(style.fill, 0.78 + 0.22 * std::abs(towards)), style.line, style.line_width));
  }
}

double head_size(double width) { return 5 + 2 * width; }

void arrow(std::vector<PaperPoint> points, const Colour& colour, double width, double pen,
           const std::vector<double>& dashes, std::vector<PaperMark>& marks) {
  double length = 0;
  for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  const double head = std::min(head_size(width) * pen, 0.7 * length);
  const PaperPoint tip = points.back();
  while (points.size() > 1 && (points[points.size() - 2] - tip).norm() < 0.85 * head) {
    points.pop_back();
  }
  if (points.size() < 2) return;
  const PaperPoint direction = (tip - points[points.size() - 2]).normalized();
  points.back() = tip - 0.85 * head * direction;
  marks.emplace_back(PaperStroke{open_path(points), no_colour, colour, width * pen, dashes});
  arrowhead(tip, direction, head, colour, marks);
}

}  // namespace beeline::internal
