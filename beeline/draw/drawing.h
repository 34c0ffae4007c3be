#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <beeline/error.h>
#include <beeline/model/joint.h>

namespace beeline {

/// Red, green, blue and opacity, each in [0, 1].
struct Colour {
  double red = 0;
  double green = 0;
  double blue = 0;
  double alpha = 1;

  bool operator==(const Colour&) const = default;
};

constexpr Colour ink{0.13, 0.15, 0.18};    ///< outlines and text
constexpr Colour steel{0.66, 0.74, 0.82};  ///< the links of an arm
constexpr Colour sand{0.82, 0.70, 0.50};   ///< obstacles
constexpr Colour paper_white{1, 1, 1};
constexpr Colour amber{0.85, 0.37, 0.01};             ///< trails and goals
constexpr Colour construction_grey{0.45, 0.47, 0.5};  ///< construction lines and commanded paths

/// Returns colour k of a cycle of eight distinct colours: 0 red, 1 green, 2 blue (the axes x, y, z
/// and joints 1, 2, 3), then five others.
Colour distinct_colour(int k);

/// Returns a lighter, opaque colour, so that overlaps do not show.
Colour faded(const Colour& colour);

/// A line through points of the world, metres. Widths and all other sizes below are in points on
/// paper (1/72 inch), so they do not depend on the size of the arm.
struct Polyline {
  std::vector<Vector3> points;
  Colour colour = ink;
  double width = 1;
  std::vector<double> dashes = {};  ///< lengths of dashes and gaps, alternating; empty: solid
  double outline = 0;               ///< width of an outline around the line; 0: no outline
  Colour rim = ink;
  bool arrow = false;  ///< whether to draw an arrowhead at the last point
};

/// A round dot at each point.
struct Dots {
  std::vector<Vector3> points;
  Colour colour = ink;
  double diameter = 3;
};

/// Filled quadrilaterals of one colour, without outlines.
struct Tiles {
  using Corners = std::array<Vector3, 4>;
  std::vector<Corners> tiles = {};
  Colour colour = steel;
};

/// A convex body: the points within `radius` of the convex hull of `points`. Its outline in the
/// view is filled, and its faces that are turned to the viewer are drawn in it. What exceeds the
/// plot of a panel is cut off.
struct Solid {
  std::vector<Vector3> points;
  double radius = 0;  ///< m
  /// Plane faces of the hull: indices of points, anticlockwise seen from outside.
  std::vector<std::vector<std::size_t>> faces = {};
  Colour fill = steel;
  Colour line = ink;
  double line_width = 0.8;
  std::vector<Vector3> framed = {};  ///< points that the page must contain
  bool shell = false;  ///< whether it is drawn over what is inside it, not under what is before it
};

/// The symbol of a joint: a short cylinder along the axis of a revolute joint (a circle when seen
/// along it), a box for a prismatic one, a cylinder with a thread for a helical one.
struct JointSymbol {
  JointKind kind = JointKind::revolute;
  Vector3 centre = Vector3::Zero();
  Vector3 axis = Vector3::UnitZ();  ///< unit direction of the axis
  double shift = 0;                 ///< displacement of the symbol along the axis
  double size = 6.5;                ///< the cylinder's radius
  Colour fill = paper_white;
  Colour line = ink;
};

/// The axes of a frame: x red, y green, z blue. An axis that points at the viewer is omitted.
struct FrameTriad {
  Pose pose = Pose::Identity();
  double length = 26;
  double width = 1.6;  ///< width of the lines
};

/// The base of an arm: a plate for a spatial arm, a hatched support for a planar one.
struct BaseSymbol {
  Vector3 at = Vector3::Zero();
  Vector3 up = Vector3::UnitZ();
  bool planar = false;
  double shift = 0;  ///< displacement of the plate's upper face along `up`
  double size = 1;
  Colour line = ink;
};

/// Text beside a point, on the side where it covers the least.
struct Label {
  Vector3 at = Vector3::Zero();
  std::string text;
  Colour colour = ink;
  double size = 9;
  double right = 1, up = 1;  ///< preferred direction from the point, on paper
};

using Primitive =
    std::variant<Polyline, Dots, Tiles, Solid, JointSymbol, FrameTriad, BaseSymbol, Label>;

/// Layers are drawn in this order. Items of `ghost` and `body` are drawn from far to near, other
/// items in the order in which they were added.
enum class Layer { ground, ghost, base, trail, body, mark, note };

struct Item {
  Layer layer = Layer::body;
  Primitive shape;
  double appears = 0;  ///< time at which an Animation shows the item first, seconds
};

/// Primitives in world coordinates, metres; plain data, independent of view and paper.
struct Drawing {
  std::vector<Item> items;
  std::optional<double> floor;  ///< height of the ground plane, metres; none: it is not drawn

  void add(Layer layer, Primitive shape, double appears = 0) {
    items.push_back({layer, std::move(shape), appears});
  }
};

/// Throws Error when a coordinate is not finite or above 1e12 m in size.
void check_drawing(const Drawing& drawing);

}  // namespace beeline
