#pragma once

#include <string>
#include <variant>
#include <vector>

#include <beeline/draw/scene.h>

namespace beeline {

/// A position on paper, points (1/72 inch): x to the right, y down from the upper left corner.
using Point = Eigen::Vector2d;

/// Straight lines and cubic Bezier curves. `move` and `line` take one point, `curve` three.
struct Path {
  enum class Verb : char { move, line, curve, close };
  std::vector<Verb> verbs;
  std::vector<Point> points;

  void move(const Point& p);
  void line(const Point& p);
  void curve(const Point& a, const Point& b, const Point& p);
  void close();
};

Path open_path(const std::vector<Point>& points);
Path closed_path(const std::vector<Point>& points);

/// Returns the ellipse about `centre` with these two semi-axes.
Path ellipse(const Point& centre, const Point& semi_axis, const Point& other_semi_axis);
Path circle(const Point& centre, double radius);

constexpr Colour no_colour{0, 0, 0, 0};

/// A path that is filled, then stroked with round caps and joins; a line of zero length is a dot.
struct Stroke {
  Path path;
  Colour fill = no_colour;
  Colour line = no_colour;
  double width = 0;
  std::vector<double> dashes = {};
};

/// One line of text centred at a point; `upright` text is rotated and reads from bottom to top.
struct Text {
  std::string text;
  Point centre = Point::Zero();
  double size = 9;
  Colour colour = ink;
  bool bold = false;
  bool upright = false;
  bool halo = false;  ///< a white outline, for contrast with marks below
};

/// Returns the stroke of a straight line.
Stroke line_stroke(const Point& from, const Point& to, const Colour& colour, double width,
                   const std::vector<double>& dashes = {});

using Mark = std::variant<Stroke, Text>;

/// A rectangle on paper.
struct Box {
  Point low = Point::Constant(1e300), high = Point::Constant(-1e300);  ///< empty at first

  void include(const Point& p, const Point& around = Point::Zero());
  Point size() const { return high - low; }
};

/// Returns a rectangle that contains the mark.
Box box_of(const Mark& mark);

/// A page: marks in order of drawing.
struct Drawing {
  double width = 0;
  double height = 0;
  std::vector<Mark> marks;
};

}  // namespace beeline
