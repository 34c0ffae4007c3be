#pragma once

#include <string>
#include <variant>
#include <vector>

#include <beeline/draw/drawing.h>

namespace beeline {

/// A position on paper, points (1/72 inch): x to the right, y down from the upper left corner.
using PaperPoint = Eigen::Vector2d;

/// Straight lines and cubic Bezier curves. `move` and `line` take one point, `curve` three.
struct PaperPath {
  enum class Verb : char { move, line, curve, close };
  std::vector<Verb> verbs;
  std::vector<PaperPoint> points;

  void move(const PaperPoint& p);
  void line(const PaperPoint& p);
  void curve(const PaperPoint& a, const PaperPoint& b, const PaperPoint& p);
  void close();
  bool operator==(const PaperPath&) const = default;
};

constexpr Colour no_colour{0, 0, 0, 0};

/// A path that is filled, then stroked with round caps and joins; a line of zero length is a dot.
struct PaperStroke {
  PaperPath path;
  Colour fill = no_colour;
  Colour line = no_colour;
  double width = 0;
  std::vector<double> dashes = {};

  bool operator==(const PaperStroke&) const = default;
};

/// One line of text centred at a point; `upright` text is rotated and reads from bottom to top.
struct PaperText {
  std::string text;
  PaperPoint centre = PaperPoint::Zero();
  double size = 9;
  Colour colour = ink;
  bool bold = false;
  bool upright = false;
  bool halo = false;  ///< a white outline, for contrast with marks below

  bool operator==(const PaperText&) const = default;
};

using PaperMark = std::variant<PaperStroke, PaperText>;

/// A picture on paper: marks in order of drawing.
struct Picture {
  double width = 0;
  double height = 0;
  std::vector<PaperMark> marks;
};

}  // namespace beeline
