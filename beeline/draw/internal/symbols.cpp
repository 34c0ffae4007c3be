#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <beeline/draw/internal/labels.h>
#include <beeline/draw/internal/outline.h>
#include <beeline/draw/internal/paper_shapes.h>
#include <beeline/draw/internal/solid.h>
#include <beeline/draw/internal/symbols.h>
#include <beeline/draw/internal/text.h>

namespace beeline::internal {
namespace {

constexpr double half_height = 0.95;  // half height of a joint's cylinder, relative to its radius
constexpr double box_length = 1.45;   // half length of a prismatic joint's box, in radii
constexpr double box_width = 0.9;
constexpr double plate_radius = 15, plate_height = 5;
constexpr double foot_width = 15, foot_height = 19;  // size of a planar arm's base

struct Painter {
  const Projection& projection;
  std::vector<PaperMark>& marks;
  double pen = projection.pen;

  void operator()(const Polyline& line) const {
    if (line.points.empty()) return;
    std::vector<PaperPoint> points;
    for (const Vector3& p : line.points) points.push_back(projection(p));
    std::vector<double> dashes = line.dashes;
    for (double& dash : dashes) dash *= pen;
    if (line.outline > 0) {
      marks.emplace_back(PaperStroke{open_path(points), no_colour, line.rim,
                                     (line.width + 2 * line.outline) * pen, dashes});
    }
    if (line.arrow) return arrow(points, line.colour, line.width, pen, dashes, marks);
    marks.emplace_back(
        PaperStroke{open_path(points), no_colour, line.colour, line.width * pen, dashes});
  }

  void operator()(const Dots& dots) const {
    PaperPath path;
    for (const Vector3& p : dots.points) {
      path.move(projection(p));
      path.line(projection(p));
    }
    marks.emplace_back(PaperStroke{path, no_colour, dots.colour, dots.diameter * pen, {}});
  }

  void operator()(const Tiles& tiles) const {
    PaperPath path;
    for (const Tiles::Corners& corners : tiles.tiles) {
      path.move(projection(corners.front()));
      for (std::size_t k = 1; k < corners.size(); ++k) path.line(projection(corners[k]));
      path.close();
    }
    constexpr double overlap = 0.3;  // overlap in points, without seams between tiles
    marks.emplace_back(PaperStroke{path, tiles.colour, tiles.colour, overlap, {}});
  }

  void operator()(const Solid& solid) const {
    std::vector<PaperPoint> points;
    for (const Vector3& p : solid.points) points.push_back(projection(p));
    const std::vector<PaperPoint> outline = outline_of(points, solid.radius * projection.scale);
    add_body(outline, solid.fill, solid);
    for (const std::vector<std::size_t>& face : solid.faces) {
      const Vector3 normal = (solid.points[face[1]] - solid.points[face[0]])
                                 .cross(solid.points[face[2]] - solid.points[face[1]])
                                 .normalized();
      const double towards = projection.depth(normal);
      if (!(towards > 1e-3)) continue;
      std::vector<PaperPoint> corners;
      for (const std::size_t i : face) {
        corners.push_back(projection(solid.points[i] + solid.radius * normal));
      }
      constexpr double darkest = 0.22;
      add_body(corners, {ink.red, ink.green, ink.blue, darkest * (1 - towards)}, solid);
    }
  }

  /// A closed line with its fill, as far as it is visible.
  void add_body(const std::vector<PaperPoint>& corners, const Colour& fill,
                const Solid& solid) const {
    const double width = solid.line_width * pen;
    if (!projection.visible) {
      marks.emplace_back(PaperStroke{closed_path(corners), fill, solid.line, width, {}});
      return;
    }
    const std::vector<PaperPoint> inside = clipped(corners, *projection.visible);
    if (inside == corners) {
      marks.emplace_back(PaperStroke{closed_path(corners), fill, solid.line, width, {}});
      return;
    }
    if (!inside.empty()) marks.emplace_back(PaperStroke{closed_path(inside), fill, no_colour, 0});
    const PaperPath edges = clipped_edges(corners, *projection.visible);
    if (!edges.verbs.empty()) {
      marks.emplace_back(PaperStroke{edges, no_colour, solid.line, width, {}});
    }
  }

  void operator()(const JointSymbol& joint) const {
    const double radius = joint.size * pen;
    const PaperPoint centre =
        projection(joint.centre) + joint.shift * pen * projection.direction(joint.axis);
    const SolidStyle style{joint.fill, joint.line, 0.17 * radius};
    if (joint.kind == JointKind::prismatic) {
      box(centre, joint.axis, radius * box_length, radius * box_width, projection, style, marks);
      return;
    }
    cylinder(centre, projected_axis(joint.axis, projection), radius, half_height * radius, style,
             joint.kind == JointKind::helical, marks);
  }

  void operator()(const FrameTriad& frame) const {
    std::array<int, 3> order{0, 1, 2};
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
      return projection.depth(frame.pose.linear().col(a)) <
             projection.depth(frame.pose.linear().col(b));
    });
    const PaperPoint origin = projection(frame.pose.translation());
    for (const int axis : order) {
      const PaperPoint direction = projection.direction(frame.pose.linear().col(axis));
      if (direction.norm() < 0.1) continue;
      arrow({origin, origin + frame.length * pen * direction}, distinct_colour(axis), frame.width,
            pen, {}, marks);
    }
  }

  void operator()(const BaseSymbol& base) const {
    const PaperPoint at = projection(base.at);
    const double size = base.size * pen;
    if (!base.planar) {
      const ProjectedAxis axis = projected_axis(base.up, projection);
      const PaperPoint middle = at + pen * (base.shift - base.size * plate_height / 2) * axis.sign *
                                         axis.flat * axis.along;
      cylinder(middle, {axis.along, axis.flat, axis.towards, 1}, size * plate_radius,
               size * plate_height / 2, {shaded(steel, 0.8), base.line, 1.1 * size}, false, marks);
      return;
    }
    const double w = size * foot_width, ground = 0.74 * size * foot_height;
    marks.emplace_back(
        outlined(closed_path({at + PaperPoint(-0.3 * w, 0), at + PaperPoint(0.3 * w, 0),
                              at + PaperPoint(0.7 * w, ground), at + PaperPoint(-0.7 * w, ground)}),
                 steel, base.line, 1.1 * size));
    PaperPath hatch = open_path({at + PaperPoint(-w, ground), at + PaperPoint(w, ground)});
    for (int k = -3; k <= 3; ++k) {
      const PaperPoint top = at + PaperPoint(w * (k + 0.3) / 3.4, ground);
      hatch.move(top);
      hatch.line(top + size * foot_height * PaperPoint(-0.26, 0.26));
    }
    marks.emplace_back(outlined(hatch, no_colour, base.line, 1.1 * size));
  }

  void operator()(const Label& /*label*/) const {}
};

struct Footprints {
  double pen;
  std::vector<Footprint>& footprints;

  void add(const Vector3& at, double reach) const { footprints.push_back({at, {reach, reach}}); }
  void operator()(const Polyline& line) const {
    const double head = line.arrow ? head_size(line.width) : 0;
    for (const Vector3& p : line.points) add(p, pen * (line.width / 2 + line.outline + head));
  }
  void operator()(const Dots& dots) const {
    for (const Vector3& p : dots.points) add(p, pen * dots.diameter / 2);
  }
  void operator()(const Tiles& tiles) const {
    for (const Tiles::Corners& corners : tiles.tiles) {
      for (const Vector3& corner : corners) add(corner, 0);
    }
  }
  void operator()(const Solid& solid) const {
    for (const Vector3& p : solid.framed) add(p, pen * solid.line_width);
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
    const PaperPoint size = text_size(label.text, label.size);
    footprints.push_back({label.at, size + PaperPoint::Constant(farthest_label)});
  }
};

}  // namespace

void draw(const Primitive& shape, const Projection& projection, std::vector<PaperMark>& marks) {
  std::visit(Painter{projection, marks}, shape);
}

void add_footprints(const Primitive& shape, double pen, std::vector<Footprint>& footprints) {
  std::visit(Footprints{pen, footprints}, shape);
}

double depth(const Primitive& shape, const Projection& projection) {
  if (const auto* line = std::get_if<Polyline>(&shape)) {
    double sum = 0;
    for (const Vector3& p : line->points) sum += projection.depth(p);
    return line->points.empty() ? 0 : sum / static_cast<double>(line->points.size());
  }
  if (const auto* joint = std::get_if<JointSymbol>(&shape)) return projection.depth(joint->centre);
  if (const auto* solid = std::get_if<Solid>(&shape)) {
    // Bodies are translucent: one that extends behind others is drawn before them.
    const double sign = solid->shell ? -1 : 1;
    double first = std::numeric_limits<double>::infinity();
    for (const Vector3& p : solid->points) first = std::min(first, sign * projection.depth(p));
    return solid->points.empty() ? 0 : sign * (first - solid->radius);
  }
  return 0;
}

}  // namespace beeline::internal
