#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <beeline/model/joint.h>

namespace beeline {

/// Red, green, blue and opacity, each in [0, 1].
struct Colour {
  double red = 0;
  double green = 0;
  double blue = 0;
  double alpha = 1;
};

constexpr Colour ink{0.13, 0.15, 0.18};    ///< outlines and text
constexpr Colour steel{0.66, 0.74, 0.82};  ///< the links of an arm
constexpr Colour paper_white{1, 1, 1};
constexpr Colour amber{0.85, 0.37, 0.01};  ///< trails and goals

/// Colour k of a fixed row of distinct ones, without end: 0 red, 1 green, 2 blue (the axes x, y, z
/// and the joints 1, 2, 3), then others.
Colour distinct_colour(int k);

/// The same colour as if seen through mist; still opaque, so that overlaps do not show.
Colour faded(const Colour& colour);

/// A line through points. Its width, and all other sizes below, are in points on paper (1/72 inch),
/// so that a picture looks right whatever the size of the arm.
struct Polyline {
  std::vector<Vector3> points;
  Colour colour = ink;
  double width = 1;
  std::vector<double> dashes = {};  ///< lengths of strokes and gaps in turn; empty: a solid line
  double outline = 0;               ///< width of a darker rim around the line; 0: none
  Colour rim = ink;
  bool arrow = false;  ///< an arrowhead at the last point
};

/// A round dot at each point.
struct Dots {
  std::vector<Vector3> points;
  Colour colour = ink;
  double diameter = 3;
};

/// A revolute joint is a short cylinder along its axis (a circle when seen along it), a prismatic
/// one a box that its link slides through, a helical one a cylinder with a thread.
struct JointSymbol {
  JointKind kind = JointKind::revolute;
  Vector3 centre = Vector3::Zero();
  Vector3 axis = Vector3::UnitZ();  ///< of unit length
  double shift = 0;                 ///< the symbol stands this far along the axis
  double size = 6.5;                ///< the cylinder's radius
  Colour fill = paper_white;
  Colour line = ink;
};

/// x red, y green, z blue; an axis that points at the viewer is left out.
struct FrameTriad {
  Pose pose = Pose::Identity();
  double length = 26;
};

/// What an arm stands on: a plate under a spatial arm, a hatched foot under a planar one.
struct BaseSymbol {
  Vector3 at = Vector3::Zero();
  Vector3 up = Vector3::UnitZ();
  bool planar = false;
  double shift = 0;  ///< the plate's upper face stands this far along `up`
  double size = 1;
  Colour line = ink;
};

/// Text beside a point. It is put on the side where it covers least.
struct Label {
  Vector3 at = Vector3::Zero();
  std::string text;
  Colour colour = ink;
  double size = 9;
  double right = 1, up = 1;  ///< the direction in which to try first, on paper
};

using Primitive = std::variant<Polyline, Dots, JointSymbol, FrameTriad, BaseSymbol, Label>;

/// Drawn in this order; within `body` from the far to the near, else in the order of adding.
enum class Layer { ground, ghost, base, trail, body, mark, note };

struct Item {
  Layer layer = Layer::body;
  Primitive shape;
};

/// What is to be seen, in world coordinates, metres. Plain data: knows no view and no paper.
struct Scene {
  std::vector<Item> items;
  std::optional<double> floor;  ///< height of the ground plane; none: do not show one

  void add(Layer layer, Primitive shape) { items.push_back({layer, std::move(shape)}); }
};

/// Throws Error when a point is not finite or farther than 1e12 m away.
void check_scene(const Scene& scene);

}  // namespace beeline
