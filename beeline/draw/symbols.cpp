#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <beeline/draw/labels.h>
#include <beeline/draw/symbols.h>
#include <beeline/draw/text.h>

namespace beeline {
namespace {

constexpr double half_height = 0.95;  // of a joint's cylinder, in radii
constexpr double box_length = 1.45;   // half the length of a slide's box, in radii
constexpr double box_width = 0.9;
constexpr double plate_radius = 15, plate_height = 5;
constexpr double foot_width = 15, foot_height = 19;  // of a planar arm's base

Colour shaded(const Colour& colour, double light) {
  return {colour.red * light, colour.green * light, colour.blue * light, colour.alpha};
}

Stroke outlined(Path path, const Colour& fill, const Colour& line, double width) {
  return {std::move(path), fill, line, width, {}};
}

/// The direction on paper of an axis seen in projection, and how much of it points at the viewer.
struct Seen {
  Point along;     ///< of unit length
  double flat;     ///< length on paper of a unit of the axis, in [0, 1]
  double towards;  ///< in [0, 1]: the axis is turned to the viewer if need be
  double sign;     ///< -1 where it was turned
};

Seen seen(const Vector3& axis, const Projection& projection) {
  const double towards = projection.depth(axis);
  const double sign = towards < -1e-12 ? -1 : 1;
  const Point on_paper = sign * projection.direction(axis);
  const double flat = on_paper.norm();
  return {flat > 1e-9 ? Point(on_paper / flat) : Point(0, -1), flat, std::abs(towards), sign};
}

/// A cylinder whose middle is at `centre`; the thread makes it a helical joint.
void cylinder(const Point& centre, const Seen& axis, double radius, double half, double pen,
              const Colour& fill, const Colour& line, bool thread, std::vector<Mark>& marks) {
  const Point across = radius * Point(-axis.along.y(), axis.along.x());
  const Point rise = half * axis.flat * axis.along;
  const Point cap = radius * axis.towards * axis.along;
  const double width = 1.1 * pen;
  marks.emplace_back(
      outlined(ellipse(centre - rise, across, cap), shaded(fill, 0.86), line, width));
  marks.emplace_back(outlined(closed_path({centre - rise + across, centre + rise + across,
                                           centre + rise - across, centre - rise - across}),
                              shaded(fill, 0.86), no_colour, 0));
  for (const double side : {1.0, -1.0}) {
    marks.emplace_back(
        outlined(open_path({centre - rise + side * across, centre + rise + side * across}),
                 no_colour, line, width));
  }
  for (const double height : {-0.75, -0.25, 0.25}) {
    if (!thread || axis.flat < 0.3) break;
    marks.emplace_back(outlined(
        open_path({centre + height * rise - across, centre + (height + 0.5) * rise + across}),
        no_colour, line, 0.8 * pen));
  }
  marks.emplace_back(outlined(ellipse(centre + rise, across, cap), fill, line, width));
  if (thread && axis.flat < 0.3) {
    const Point slash = radius * Point(0.7071, -0.7071);
    marks.emplace_back(
        outlined(open_path({centre - slash, centre + slash}), no_colour, line, 0.9 * pen));
  } else if (axis.towards > 0.25) {
    const double dot = 0.24 * radius;
    marks.emplace_back(outlined(ellipse(centre + rise, dot * across / radius, dot * cap / radius),
                                line, no_colour, 0));
  }
}

/// A box of these half lengths along three orthogonal directions: the faces that are turned to us.
void box(const Point& centre, const Rotation& axes, const Vector3& half, double pen,
         const Projection& projection, const Colour& fill, const Colour& line,
         std::vector<Mark>& marks) {
  for (int normal = 0; normal < 3; ++normal) {
    const double towards = projection.depth(axes.col(normal));
    if (std::abs(towards) < 1e-3) continue;
    const Vector3 out = std::copysign(half[normal], towards) * axes.col(normal);
    const int a = (normal + 1) % 3, b = (normal + 2) % 3;
    const Point middle = centre + projection.direction(out);
    const Point u = half[a] * projection.direction(axes.col(a));
    const Point v = half[b] * projection.direction(axes.col(b));
    marks.emplace_back(
        outlined(closed_path({middle + u + v, middle + u - v, middle - u - v, middle - u + v}),
                 shaded(fill, 0.78 + 0.22 * std::abs(towards)), line, 1.1 * pen));
  }
}

Rotation box_axes(const Vector3& axis) {
  const Vector3 other = std::abs(axis.z()) < 0.9 ? Vector3::UnitZ() : Vector3::UnitX();
  Rotation axes;
  axes.col(0) = axis;
  axes.col(1) = other.cross(axis).normalized();
  axes.col(2) = axis.cross(axes.col(1));
  return axes;
}

void arrowhead(const Point& tip, const Point& way, double size, const Colour& colour,
               std::vector<Mark>& marks) {
  const Point across(-way.y(), way.x());
  marks.emplace_back(
      outlined(closed_path({tip, tip - size * way + 0.38 * size * across, tip - 0.8 * size * way,
                            tip - size * way - 0.38 * size * across}),
               colour, no_colour, 0));
}

double head_size(double width) { return 5 + 2 * width; }

/// A line with a head at its end; the shaft ends inside the head, so that the tip is sharp.
void arrow(std::vector<Point> points, const Colour& colour, double width, double pen,
           const std::vector<double>& dashes, std::vector<Mark>& marks) {
  double length = 0;
  for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  const double head = std::min(head_size(width) * pen, 0.7 * length);
  const Point tip = points.back();
  while (points.size() > 1 && (points[points.size() - 2] - tip).norm() < 0.85 * head) {
    points.pop_back();
  }
  if (points.size() < 2) return;
  const Point way = (tip - points[points.size() - 2]).normalized();
  points.back() = tip - 0.85 * head * way;
  marks.emplace_back(Stroke{open_path(points), no_colour, colour, width * pen, dashes});
  arrowhead(tip, way, head, colour, marks);
}

struct Painter {
  const Projection& projection;
  std::vector<Mark>& marks;
  double pen = projection.pen;

  void operator()(const Polyline& line) const {
    if (line.points.empty()) return;
    std::vector<Point> points;
    for (const Vector3& p : line.points) points.push_back(projection(p));
    std::vector<double> dashes = line.dashes;
    for (double& dash : dashes) dash *= pen;
    if (line.outline > 0) {
      marks.emplace_back(Stroke{open_path(points), no_colour, line.rim,
                                (line.width + 2 * line.outline) * pen, dashes});
    }
    if (line.arrow) return arrow(points, line.colour, line.width, pen, dashes, marks);
    marks.emplace_back(Stroke{open_path(points), no_colour, line.colour, line.width * pen, dashes});
  }

  void operator()(const Dots& dots) const {
    Path path;
    for (const Vector3& p : dots.points) {
      path.move(projection(p));
      path.line(projection(p));
    }
    marks.emplace_back(Stroke{path, no_colour, dots.colour, dots.diameter * pen, {}});
  }

  void operator()(const JointSymbol& joint) const {
    const double radius = joint.size * pen;
    const Point centre =
        projection(joint.centre) + joint.shift * pen * projection.direction(joint.axis);
    if (joint.kind == JointKind::prismatic) {
      box(centre, box_axes(joint.axis), radius * Vector3(box_length, box_width, box_width), pen,
          projection, joint.fill, joint.line, marks);
      return;
    }
    cylinder(centre, seen(joint.axis, projection), radius, half_height * radius, pen, joint.fill,
             joint.line, joint.kind == JointKind::helical, marks);
  }

  void operator()(const FrameTriad& frame) const {
    std::array<int, 3> order{0, 1, 2};
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
      return projection.depth(frame.pose.linear().col(a)) <
             projection.depth(frame.pose.linear().col(b));
    });
    const Point origin = projection(frame.pose.translation());
    for (const int axis : order) {
      const Point way = projection.direction(frame.pose.linear().col(axis));
      if (way.norm() < 0.1) continue;
      arrow({origin, origin + frame.length * pen * way}, distinct_colour(axis), 1.6, pen, {},
            marks);
    }
  }

  void operator()(const BaseSymbol& base) const {
    const Point at = projection(base.at);
    const double size = base.size * pen;
    if (!base.planar) {
      const Seen axis = seen(base.up, projection);
      const Point middle = at + pen * (base.shift - base.size * plate_height / 2) * axis.sign *
                                    axis.flat * axis.along;
      cylinder(middle, {axis.along, axis.flat, axis.towards, 1}, size * plate_radius,
               size * plate_height / 2, size, shaded(steel, 0.8), base.line, false, marks);
      return;
    }
    const double w = size * foot_width, ground = 0.74 * size * foot_height;
    marks.emplace_back(
        outlined(closed_path({at + Point(-0.3 * w, 0), at + Point(0.3 * w, 0),
                              at + Point(0.7 * w, ground), at + Point(-0.7 * w, ground)}),
                 steel, base.line, 1.1 * size));
    Path hatch = open_path({at + Point(-w, ground), at + Point(w, ground)});
    for (int k = -3; k <= 3; ++k) {
      const Point top = at + Point(w * (k + 0.3) / 3.4, ground);
      hatch.move(top);
      hatch.line(top + size * foot_height * Point(-0.26, 0.26));
    }
    marks.emplace_back(outlined(hatch, no_colour, base.line, 1.1 * size));
  }

  void operator()(const Label& /*label*/) const {}
};

struct Feet {
  double pen;
  std::vector<Foot>& feet;

  void add(const Vector3& at, double reach) const { feet.push_back({at, {reach, reach}}); }
  void operator()(const Polyline& line) const {
    const double head = line.arrow ? head_size(line.width) : 0;
    for (const Vector3& p : line.points) add(p, pen * (line.width / 2 + line.outline + head));
  }
  void operator()(const Dots& dots) const {
    for (const Vector3& p : dots.points) add(p, pen * dots.diameter / 2);
  }
  void operator()(const JointSymbol& joint) const {
    add(joint.centre, pen * (std::abs(joint.shift) + 2 * joint.size + 1));
  }
  void operator()(const FrameTriad& frame) const {
    add(frame.pose.translation(), pen * (frame.length + 3));
  }
  void operator()(const BaseSymbol& base) const {
    const double reach = std::max(plate_radius, 1.3 * foot_width) + 3;
    add(base.at, pen * (base.size * reach + std::abs(base.shift)));
  }
  void operator()(const Label& label) const {
    const Point size = text_size(label.text, label.size);
    feet.push_back({label.at, size + Point::Constant(farthest_label)});
  }
};

}  // namespace

void draw(const Primitive& shape, const Projection& projection, std::vector<Mark>& marks) {
  std::visit(Painter{projection, marks}, shape);
}

void add_feet(const Primitive& shape, double pen, std::vector<Foot>& feet) {
  std::visit(Feet{pen, feet}, shape);
}

double depth(const Primitive& shape, const Projection& projection) {
  if (const auto* line = std::get_if<Polyline>(&shape)) {
    double sum = 0;
    for (const Vector3& p : line->points) sum += projection.depth(p);
    return line->points.empty() ? 0 : sum / static_cast<double>(line->points.size());
  }
  if (const auto* joint = std::get_if<JointSymbol>(&shape)) return projection.depth(joint->centre);
  return 0;
}

}  // namespace beeline
