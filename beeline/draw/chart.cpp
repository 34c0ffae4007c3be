#include <algorithm>
#include <cmath>

#include <beeline/draw/chart.h>
#include <beeline/draw/chart_curve.h>
#include <beeline/draw/text.h>
#include <beeline/error.h>

namespace beeline {
namespace {

constexpr Colour grid_grey{0.90, 0.91, 0.925};
constexpr Colour zero_grey{0.76, 0.78, 0.81};
constexpr Colour frame_grey{0.55, 0.57, 0.60};
constexpr Colour level_grey{0.35, 0.37, 0.40};
constexpr double name_size = 8.5, heading_size = 8.5, key_size = 7.5;
constexpr double stroke_length = 16, row_height = 11;
constexpr double air = 0.07;  // of the curves' span, above and below them

/// As much of one line as fits.
std::string cut_to(const std::string& text, double size, double width, bool bold = false) {
  const std::vector<std::string> lines = wrapped(text, size, width, bold);
  if (lines.empty()) return "";
  return lines.size() == 1 ? lines.front() : lines.front() + "…";
}

struct Range {
  double low = 0, high = 0;
  bool empty = true;
  void include(double value) {
    if (empty) low = high = value;
    empty = false;
    low = value < low || std::isnan(value) ? value : low;
    high = value > high || std::isnan(value) ? value : high;
  }
};

Range range_of(const Chart& chart, bool right) {
  Range range;
  for (const Curve& curve : chart.curves) {
    if (curve.right != right) continue;
    for (const double y : curve.y) range.include(y);
  }
  return range;
}

double largest_of(const Chart& chart, bool right) {
  const Range range = range_of(chart, right);
  return std::max(std::abs(range.low), std::abs(range.high));
}

bool shown(const Chart& chart, const Level& level) {
  return largest_of(chart, level.right) >= std::abs(level.y) / 6;
}

Scale upright_scale(const Chart& chart, bool right) {
  Range range = range_of(chart, right);
  for (const Level& level : chart.levels) {
    if (level.right == right && shown(chart, level)) range.include(level.y);
  }
  if (chart.from_zero) range.include(0);
  double least = chart.least;
  if (range.low == range.high) least = std::max(least, range.low == 0 ? 1 : std::abs(range.low));
  Scale scale = spanning(range.low, range.high, least);
  const double span = scale.high - scale.low;
  scale = spanning(scale.low - (chart.from_zero && range.low >= 0 ? 0 : air * span),
                   scale.high + air * span, least);
  if (chart.from_zero && range.low >= 0) scale.low = 0;
  return scale;
}

double on_paper(const Scale& scale, double value, double from, double to) {
  const double share = std::clamp((value - scale.low) / (scale.high - scale.low), 0.0, 1.0);
  return from + share * (to - from);
}

struct Place {
  const ChartCell& cell;
  double x(double value) const {
    return on_paper(cell.x, value, cell.plot.low.x(), cell.plot.high.x());
  }
  double y(double value, bool right) const {
    const Scale& scale = right ? cell.right : cell.left;
    return on_paper(scale, value, cell.plot.high.y(), cell.plot.low.y());
  }
};

Stroke segment(const Point& from, const Point& to, const Colour& colour, double width,
               const std::vector<double>& dashes = {}) {
  return {open_path({from, to}), no_colour, colour, width, dashes};
}

Text text_right_of(const std::string& text, const Point& left, double size) {
  return {text, {left.x() + text_size(text, size).x() / 2, left.y()}, size};
}

Curve as_curve(const Level& level) {
  return {.name = level.name, .colour = level_grey, .width = 0.8, .dashes = {6, 3}};
}

/// What the key above the plot lists.
std::vector<Curve> key_of(const Chart& chart) {
  std::vector<Curve> key;
  for (const Curve& curve : chart.curves) {
    if (!curve.name.empty()) key.push_back(curve);
  }
  for (const Level& level : chart.levels) {
    if (level.name.empty()) continue;
    key.push_back(as_curve(level));
    if (!shown(chart, level)) key.back().name += " (off scale)";
  }
  return key;
}

double entry_width(const Curve& curve, double width) {
  const std::string name = cut_to(curve.name, key_size, width - stroke_length - 4);
  return stroke_length + 4 + text_size(name, key_size).x();
}

void draw_side(const ChartCell& cell, bool right, std::vector<Mark>& marks) {
  const Scale& scale = right ? cell.right : cell.left;
  const double edge = right ? cell.plot.high.x() : cell.plot.low.x(), out = right ? 1 : -1;
  for (const double value : ticks(scale)) {
    const double y = Place{cell}.y(value, right);
    const std::string text = tick_text(scale, value);
    marks.emplace_back(segment({edge, y}, {edge + 2.5 * out, y}, frame_grey, 0.7));
    const double half = text_size(text, tick_size).x() / 2;
    marks.emplace_back(Text{text, {edge + out * (4.5 + half), y}, tick_size});
  }
  const std::string name =
      with_power(right ? cell.chart->right_name : cell.chart->left_name, scale.exponent);
  const double middle = (cell.plot.low.y() + cell.plot.high.y()) / 2;
  Text text{cut_to(name, name_size, cell.plot.size().y() + 12),
            {edge + out * (8 + widest_tick(scale) + 0.6 * name_size), middle},
            name_size};
  text.upright = true;
  marks.emplace_back(text);
}

void draw_below(const ChartCell& cell, std::vector<Mark>& marks) {
  const double bottom = cell.plot.high.y();
  for (const double value : ticks(cell.x)) {
    const double x = Place{cell}.x(value);
    const std::string text = tick_text(cell.x, value);
    marks.emplace_back(segment({x, bottom}, {x, bottom + 2.5}, frame_grey, 0.7));
    const double half = text_size(text, tick_size).x() / 2;
    if (x - half < cell.plot.low.x() - 8 || x + half > cell.plot.high.x() + 8) continue;
    marks.emplace_back(Text{text, {x, bottom + 8}, tick_size});
  }
  const std::string name =
      cut_to(with_power(cell.chart->x_name, cell.x.exponent), name_size, cell.plot.size().x());
  marks.emplace_back(
      Text{name, {(cell.plot.low.x() + cell.plot.high.x()) / 2, bottom + 18.5}, name_size});
}

void draw_grid(const ChartCell& cell, std::vector<Mark>& marks) {
  const auto& [low, high] = cell.plot;
  for (const double value : ticks(cell.x)) {
    const double x = Place{cell}.x(value);
    marks.emplace_back(segment({x, low.y()}, {x, high.y()}, grid_grey, 0.6));
  }
  for (const double value : ticks(cell.left)) {
    const double y = Place{cell}.y(value, false);
    const Colour& grey = value == 0 ? zero_grey : grid_grey;
    marks.emplace_back(segment({low.x(), y}, {high.x(), y}, grey, 0.6));
  }
}

void draw_stations(const ChartCell& cell, std::vector<Mark>& marks) {
  double before = -1e300, named = -1e300;
  for (const Station& station : cell.chart->stations) {
    const double x = Place{cell}.x(station.x);
    if (std::abs(x - before) < 1) continue;
    before = x;
    marks.emplace_back(segment({x, cell.plot.low.y()}, {x, cell.plot.high.y()}, faded(amber), 0.9));
    const double half = text_size(station.name, tick_size).x() / 2;
    if (station.name.empty() || x - half < named + 3) continue;
    named = x + half;
    marks.emplace_back(Text{station.name, {x, cell.plot.low.y() - 5}, tick_size, amber});
  }
}

void draw_curve(const ChartCell& cell, const Curve& curve, std::vector<Mark>& marks) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    points.emplace_back(Place{cell}.x(curve.x[i]), Place{cell}.y(curve.y[i], curve.right));
  }
  points = thinned(points);
  if (points.empty()) return;
  const bool dot = points.size() == 1;
  if (dot) points.push_back(points.front());
  marks.emplace_back(Stroke{open_path(points), no_colour, curve.colour,
                            dot ? 3 * curve.width : curve.width,
                            dot ? std::vector<double>{} : curve.dashes});
}

}  // namespace

ChartCell cell_of(const Chart& chart) {
  ChartCell cell{.chart = &chart};
  Range across;
  for (const Curve& curve : chart.curves) {
    if (curve.x.size() != curve.y.size()) {
      throw Error("a curve has " + std::to_string(curve.x.size()) + " places and " +
                  std::to_string(curve.y.size()) + " values");
    }
    for (const double x : curve.x) across.include(x);
    cell.has_right = cell.has_right || curve.right;
  }
  cell.x = spanning(across.low, across.high, across.low == across.high ? 1 : 0);
  cell.left = upright_scale(chart, false);
  if (cell.has_right) cell.right = upright_scale(chart, true);
  return cell;
}

double heading_height(const ChartCell& cell) {
  const auto& stations = cell.chart->stations;
  const bool names = std::any_of(stations.begin(), stations.end(),
                                 [](const Station& station) { return !station.name.empty(); });
  return names ? 24 : 15;
}

double side_width(const ChartCell& cell, bool right) {
  if (right && !cell.has_right) return 0;
  return 9 + widest_tick(right ? cell.right : cell.left) + 1.3 * name_size;
}

double draw_key(const std::vector<Curve>& curves, const Point& corner, double width,
                std::vector<Mark>* marks) {
  Point at = corner + Point(0, row_height / 2);
  for (const Curve& curve : curves) {
    const double entry = entry_width(curve, width);
    if (at.x() > corner.x() && at.x() + entry > corner.x() + width) {
      at = {corner.x(), at.y() + row_height};
    }
    if (marks != nullptr) {
      marks->emplace_back(segment(at, at + Point(stroke_length, 0), curve.colour,
                                  std::max(1.2, curve.width), curve.dashes));
      const std::string name = cut_to(curve.name, key_size, width - stroke_length - 4);
      marks->emplace_back(text_right_of(name, at + Point(stroke_length + 4, 0), key_size));
    }
    at.x() += entry + 10;
  }
  return curves.empty() ? 0 : at.y() + row_height / 2 - corner.y();
}

void draw(const ChartCell& cell, std::vector<Mark>& marks) {
  const auto& [low, high] = cell.plot;
  draw_grid(cell, marks);
  draw_stations(cell, marks);
  for (const Level& level : cell.chart->levels) {
    if (!shown(*cell.chart, level)) continue;
    const double y = Place{cell}.y(level.y, level.right);
    const Curve curve = as_curve(level);
    marks.emplace_back(
        segment({low.x(), y}, {high.x(), y}, curve.colour, curve.width, curve.dashes));
  }
  for (const Curve& curve : cell.chart->curves) draw_curve(cell, curve, marks);
  marks.emplace_back(Stroke{closed_path({low, {high.x(), low.y()}, high, {low.x(), high.y()}}),
                            no_colour,
                            frame_grey,
                            0.7,
                            {}});
  draw_side(cell, false, marks);
  if (cell.has_right) draw_side(cell, true, marks);
  if (cell.numbers_below) draw_below(cell, marks);

  std::vector<Curve> key = key_of(*cell.chart);
  const auto width_of_key = [&key, whole = high.x() - low.x()] {
    double width = 0;
    for (const Curve& curve : key) width += entry_width(curve, whole) + 10;
    return std::max(0.0, width - 10);
  };
  const double above = low.y() - heading_height(cell);
  while (!key.empty() && width_of_key() > 0.86 * (high.x() - low.x())) key.pop_back();
  const double room = high.x() - low.x() - (key.empty() ? 0 : width_of_key() + 10);
  draw_key(key, {high.x() - width_of_key(), above + 1}, width_of_key() + 1, &marks);
  const std::string heading = cut_to(cell.chart->heading, heading_size, room, true);
  Text text{heading,
            {low.x() + text_size(heading, heading_size, true).x() / 2, above + 1 + row_height / 2},
            heading_size};
  text.bold = true;
  marks.emplace_back(text);
}

}  // namespace beeline
