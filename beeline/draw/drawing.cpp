#include <array>
#include <cmath>

#include <beeline/draw/drawing.h>
#include <beeline/error.h>

namespace beeline {
namespace {

constexpr double max_coordinate = 1e12;  // metres; larger coordinates would overflow the scale

void check_point(const Vector3& point, const char* what) {
  for (const double value : point) {
    if (std::abs(value) <= max_coordinate) continue;  // the comparison is false for NaN
    throw Error(std::string("the figure has a ") + what + " at (" + number(point.x()) + ", " +
                number(point.y()) + ", " + number(point.z()) +
                "); coordinates must be finite and within 1e12 m");
  }
}

void check_points(const std::vector<Vector3>& points, const char* what) {
  for (const Vector3& point : points) check_point(point, what);
}

struct Check {
  void operator()(const Polyline& line) const { check_points(line.points, "line"); }
  void operator()(const Dots& dots) const { check_points(dots.points, "dot"); }
  void operator()(const Tiles& tiles) const {
    for (const Tiles::Corners& corners : tiles.tiles) {
      for (const Vector3& corner : corners) check_point(corner, "tile");
    }
  }
  void operator()(const Solid& solid) const {
    check_points(solid.points, "body");
    check_points(solid.framed, "body");
    check_point({solid.radius, 0, 0}, "body's radius");
  }
  void operator()(const JointSymbol& joint) const {
    check_point(joint.centre, "joint");
    check_point(joint.axis, "joint's axis");
  }
  void operator()(const FrameTriad& frame) const {
    check_point(frame.pose.translation(), "frame");
    for (int i = 0; i < 3; ++i) check_point(frame.pose.linear().col(i), "frame's axis");
  }
  void operator()(const BaseSymbol& base) const { check_point(base.at, "base"); }
  void operator()(const Label& label) const { check_point(label.at, "label"); }
};

}  // namespace

Colour distinct_colour(int k) {
  constexpr std::array<Colour, 8> row{{{0.83, 0.13, 0.15},
                                       {0.11, 0.58, 0.22},
                                       {0.10, 0.35, 0.80},
                                       {0.90, 0.55, 0.00},
                                       {0.54, 0.27, 0.70},
                                       {0.00, 0.60, 0.63},
                                       {0.50, 0.33, 0.18},
                                       {0.85, 0.35, 0.65}}};
  return row[static_cast<std::size_t>(k) % row.size()];
}

Colour faded(const Colour& colour) {
  constexpr double whiteness = 0.68;
  return {colour.red + whiteness * (1 - colour.red), colour.green + whiteness * (1 - colour.green),
          colour.blue + whiteness * (1 - colour.blue), colour.alpha};
}

void check_drawing(const Drawing& drawing) {
  for (const Item& item : drawing.items) std::visit(Check{}, item.shape);
  if (drawing.floor) check_point({0, 0, *drawing.floor}, "floor");
}

}  // namespace beeline
