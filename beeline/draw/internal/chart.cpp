#include <algorithm>
#include <cmath>

#include <beeline/draw/internal/axes.h>
#include <beeline/draw/internal/chart.h>
#include <beeline/draw/internal/paper_shapes.h>
#include <beeline/draw/internal/simplification.h>
#include <beeline/draw/internal/text.h>
#include <beeline/error.h>

namespace beeline::internal {
namespace {

constexpr Colour reference_grey{0.35, 0.37, 0.40};
constexpr double heading_size = 8.5, legend_size = 7.5;
constexpr double stroke_length = 16, row_height = 11;
constexpr double padding = 0.07;  // padding above and below the curves, as a fraction of their span

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

bool shown(const Chart& chart, const ReferenceLine& line) {
  return largest_of(chart, line.right) >= std::abs(line.y) / 6;
}

Scale upright_scale(const Chart& chart, bool right) {
  Range range = range_of(chart, right);
  for (const ReferenceLine& line : chart.reference_lines) {
    if (line.right == right && shown(chart, line)) range.include(line.y);
  }
  if (chart.from_zero) range.include(0);
  double min_span = chart.min_span;
  if (range.low == range.high)
    min_span = std::max(min_span, range.low == 0 ? 1 : std::abs(range.low));
  Scale scale = spanning(range.low, range.high, min_span);
  const double span = scale.high - scale.low;
  scale = spanning(scale.low - (chart.from_zero && range.low >= 0 ? 0 : padding * span),
                   scale.high + padding * span, min_span);
  if (chart.from_zero && range.low >= 0) scale.low = 0;
  return scale;
}

/// Maps values to paper.
struct ToPaper {
  const ChartCell& cell;
  double x(double value) const {
    return on_paper(cell.x, value, cell.plot.low.x(), cell.plot.high.x());
  }
  double y(double value, bool right) const {
    const Scale& scale = right ? cell.right : cell.left;
    return on_paper(scale, value, cell.plot.high.y(), cell.plot.low.y());
  }
};

PaperText text_right_of(const std::string& text, const PaperPoint& left, double size) {
  return {text, {left.x() + text_size(text, size).x() / 2, left.y()}, size};
}

Curve as_curve(const ReferenceLine& line) {
  return {.name = line.name, .colour = reference_grey, .width = 0.8, .dashes = {6, 3}};
}

/// Returns the entries of the legend above the plot.
std::vector<Curve> legend_of(const Chart& chart) {
  std::vector<Curve> legend;
  for (const Curve& curve : chart.curves) {
    if (!curve.name.empty()) legend.push_back(curve);
  }
  for (const ReferenceLine& line : chart.reference_lines) {
    if (line.name.empty()) continue;
    legend.push_back(as_curve(line));
    if (!shown(chart, line)) legend.back().name += " (off scale)";
  }
  return legend;
}

double entry_width(const Curve& curve, double width) {
  const std::string name = cut_to(curve.name, legend_size, width - stroke_length - 4);
  return stroke_length + 4 + text_size(name, legend_size).x();
}

void draw_markers(const ChartCell& cell, std::vector<PaperMark>& marks) {
  double before = -1e300, named = -1e300;
  for (const Marker& marker : cell.chart->markers) {
    const double x = ToPaper{cell}.x(marker.x);
    if (std::abs(x - before) < 1) continue;
    before = x;
    marks.emplace_back(
        line_stroke({x, cell.plot.low.y()}, {x, cell.plot.high.y()}, faded(amber), 0.9));
    const double half = text_size(marker.name, tick_size).x() / 2;
    if (marker.name.empty() || x - half < named + 3) continue;
    named = x + half;
    marks.emplace_back(PaperText{marker.name, {x, cell.plot.low.y() - 5}, tick_size, amber});
  }
}

constexpr double strip = 0.5;  // width of a strip whose extremes are kept, points

/// Keeps the first, lowest, highest and last point of each run within one vertical strip.
std::vector<PaperPoint> strip_extremes(const std::vector<PaperPoint>& points) {
  std::vector<PaperPoint> kept;
  for (std::size_t begin = 0; begin < points.size();) {
    const double at = std::floor(points[begin].x() / strip);
    std::size_t end = begin + 1;
    while (end < points.size() && std::floor(points[end].x() / strip) == at) ++end;
    std::size_t low = begin, high = begin;
    for (std::size_t i = begin; i < end; ++i) {
      if (points[i].y() < points[low].y()) low = i;
      if (points[i].y() > points[high].y()) high = i;
    }
    std::vector<std::size_t> few{begin, std::min(low, high), std::max(low, high), end - 1};
    few.erase(std::unique(few.begin(), few.end()), few.end());
    for (const std::size_t i : few) kept.push_back(points[i]);
    begin = end;
  }
  return kept;
}

void draw_curve(const ChartCell& cell, const Curve& curve, std::vector<PaperMark>& marks) {
  std::vector<PaperPoint> points;
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    points.emplace_back(ToPaper{cell}.x(curve.x[i]), ToPaper{cell}.y(curve.y[i], curve.right));
  }
  points = thinned(points);
  if (points.empty()) return;
  const bool dot = points.size() == 1;
  if (dot) points.push_back(points.front());
  marks.emplace_back(PaperStroke{open_path(points), no_colour, curve.colour,
                                 dot ? 3 * curve.width : curve.width,
                                 dot ? std::vector<double>{} : curve.dashes});
}

}  // namespace

std::vector<PaperPoint> thinned(const std::vector<PaperPoint>& points) {
  const std::vector<PaperPoint> all = strip_extremes(points);
  if (all.size() < 3) return all;
  const auto off = [&](std::size_t i, std::size_t a, std::size_t b) {
    return distance_from_chord(all[i], all[a], all[b]);
  };
  std::vector<PaperPoint> few;
  for (const std::size_t i : simplified(0, all.size() - 1, 0.1, off)) few.push_back(all[i]);
  return few;
}

ChartCell cell_of(const Chart& chart) {
  ChartCell cell{.chart = &chart};
  Range across;
  for (const Curve& curve : chart.curves) {
    if (curve.x.size() != curve.y.size()) {
      throw Error("a curve has " + std::to_string(curve.x.size()) + " x values and " +
                  std::to_string(curve.y.size()) + " y values");
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
  const auto& markers = cell.chart->markers;
  const bool names = std::any_of(markers.begin(), markers.end(),
                                 [](const Marker& marker) { return !marker.name.empty(); });
  return names ? 24 : 15;
}

void add_numbered_markers(std::vector<Chart>& charts, const std::vector<double>& values) {
  for (std::size_t w = 0; w < values.size(); ++w) {
    for (Chart& chart : charts) {
      const bool first = &chart == charts.data();
      chart.markers.push_back({values[w], first ? std::to_string(w + 1) : ""});
    }
  }
}

double draw_legend(const std::vector<Curve>& curves, const PaperPoint& corner, double width,
                   std::vector<PaperMark>* marks) {
  PaperPoint at = corner + PaperPoint(0, row_height / 2);
  for (const Curve& curve : curves) {
    const double entry = entry_width(curve, width);
    if (at.x() > corner.x() && at.x() + entry > corner.x() + width) {
      at = {corner.x(), at.y() + row_height};
    }
    if (marks != nullptr) {
      marks->emplace_back(line_stroke(at, at + PaperPoint(stroke_length, 0), curve.colour,
                                      std::max(1.2, curve.width), curve.dashes));
      const std::string name = cut_to(curve.name, legend_size, width - stroke_length - 4);
      marks->emplace_back(text_right_of(name, at + PaperPoint(stroke_length + 4, 0), legend_size));
    }
    at.x() += entry + 10;
  }
  return curves.empty() ? 0 : at.y() + row_height / 2 - corner.y();
}

void draw(const ChartCell& cell, std::vector<PaperMark>& marks) {
  const auto& [low, high] = cell.plot;
  draw_grid(cell.plot, cell.x, cell.left, marks);
  draw_markers(cell, marks);
  for (const ReferenceLine& line : cell.chart->reference_lines) {
    if (!shown(*cell.chart, line)) continue;
    const double y = ToPaper{cell}.y(line.y, line.right);
    const Curve curve = as_curve(line);
    marks.emplace_back(
        line_stroke({low.x(), y}, {high.x(), y}, curve.colour, curve.width, curve.dashes));
  }
  for (const Curve& curve : cell.chart->curves) draw_curve(cell, curve, marks);
  draw_frame(cell.plot, marks);
  draw_side(cell.plot, cell.left, cell.chart->left_name, false, marks);
  if (cell.has_right) draw_side(cell.plot, cell.right, cell.chart->right_name, true, marks);
  if (cell.numbers_below) draw_below(cell.plot, cell.x, cell.chart->x_name, marks);

  std::vector<Curve> legend = legend_of(*cell.chart);
  const auto legend_width = [&legend, whole = high.x() - low.x()] {
    double width = 0;
    for (const Curve& curve : legend) width += entry_width(curve, whole) + 10;
    return std::max(0.0, width - 10);
  };
  const double above = low.y() - heading_height(cell);
  while (!legend.empty() && legend_width() > 0.86 * (high.x() - low.x())) legend.pop_back();
  const double available = high.x() - low.x() - (legend.empty() ? 0 : legend_width() + 10);
  draw_legend(legend, {high.x() - legend_width(), above + 1}, legend_width() + 1, &marks);
  const std::string heading = cut_to(cell.chart->heading, heading_size, available, true);
  PaperText text{
      heading,
      {low.x() + text_size(heading, heading_size, true).x() / 2, above + 1 + row_height / 2},
      heading_size};
  text.bold = true;
  marks.emplace_back(text);
}

}  // namespace beeline::internal
