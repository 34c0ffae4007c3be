#pragma once

#include <string>
#include <variant>
#include <vector>

#include <beeline/draw/scene.h>

namespace beeline {

/// A place on paper, in points (1/72 inch): x to the right, y down from the upper left corner.
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

/// The ellipse around `centre` with these two half axes.
Path ellipse(const Point& centre, const Point& half_axis, const Point& other_half_axis);
Path circle(const Point& centre, double radius);

constexpr Colour no_colour{0, 0, 0, 0};

/// A path, first filled, then stroked with round ends and corners; a line without length is a dot.
struct Stroke {
  Path path;
  Colour fill = no_colour;
  Colour line = no_colour;
  double width = 0;
  std::vector<double> dashes = {};
};

/// One line of text centred at a point, horizontal or read from below to above.
struct Text {
  std::string text;
  Point centre = Point::Zero();
  double size = 9;
  Colour colour = ink;
  bool bold = false;
  bool upright = false;
  bool halo = false;  ///< a white rim, to stand out from what is below
};

using Mark = std::variant<Stroke, Text>;

/// A rectangle on paper.
struct Box {
  Point low = Point::Constant(1e300), high = Point::Constant(-1e300);  ///< empty at first

  void include(const Point& p, const Point& around = Point::Zero());
  Point size() const { return high - low; }
};

/// What one mark covers, at most.
Box box_of(const Mark& mark);

/// A page, in order of drawing.
struct Drawing {
  double width = 0;
  double height = 0;
  std::vector<Mark> marks;
};

}  // namespace beeline
