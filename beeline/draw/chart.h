#pragma once

#include <string>
#include <vector>

#include <beeline/draw/chart_scale.h>
#include <beeline/draw/paper.h>

namespace beeline {

/// Straight lines from value to value; one value alone is a dot.
struct Curve {
  std::string name = {};  ///< in the key; empty: not there
  std::vector<double> x = {}, y = {};
  Colour colour = ink;
  double width = 1;
  std::vector<double> dashes = {};
  bool right = false;  ///< goes by the scale on the right
};

/// A limit, dashed from side to side. Where the curves stay below a sixth of it, it is left off the
/// scale and the key says so.
struct Level {
  std::string name = {};
  double y = 0;
  bool right = false;
};

/// A thin upright line, with its name on top.
struct Station {
  double x = 0;
  std::string name = {};
};

/// Curves over one axis. Plain data: knows no paper.
struct Chart {
  std::string heading = {};
  std::string x_name = {}, left_name = {}, right_name = {};  ///< what the scales count
  std::vector<Curve> curves = {};
  std::vector<Level> levels = {};
  std::vector<Station> stations = {};
  double least = 1e-6;     ///< a scale spans so much at least: smaller changes are noise
  bool from_zero = false;  ///< the scales begin at zero
};

/// A chart on its way to paper.
struct ChartCell {
  const Chart* chart = nullptr;
  Scale x = {}, left = {}, right = {};
  bool has_right = false;
  bool numbers_below = true;  ///< numbers and the name of the x axis
  Box plot = {};
};

/// Room above the plot, for the heading and the stations' names.
double heading_height(const ChartCell& cell);
constexpr double numbers_height = 26;  ///< below it, where it has numbers there

/// The scales that hold all of the chart. Throws Error when a value cannot be drawn, or a curve has
/// not as many x as y.
ChartCell cell_of(const Chart& chart);

/// Room for the numbers and the name on one side.
double side_width(const ChartCell& cell, bool right);

void draw(const ChartCell& cell, std::vector<Mark>& marks);

/// A key's entries in rows from `corner` on; the height that they take. Nothing is drawn without
/// `marks`.
double draw_key(const std::vector<Curve>& curves, const Point& corner, double width,
                std::vector<Mark>* marks);

}  // namespace beeline
