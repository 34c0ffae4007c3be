#include <algorithm>
#include <array>
#include <cmath>

#include <beeline/draw/internal/axis_scale.h>
#include <beeline/draw/internal/paper_shapes.h>
#include <beeline/draw/internal/ruler.h>
#include <beeline/draw/internal/symbols.h>
#include <beeline/draw/internal/text.h>
#include <beeline/error.h>

namespace beeline::internal {
namespace {

double text_width(double value, double step) {
  return text_size(tick_text(value, step), tick_size).x();
}

}  // namespace

double tick_step(double scale, double largest) {
  double step = round_step(29 / scale);
  for (int widened = 0; widened < 6; ++widened) {
    const double widest = text_width(-std::ceil(largest / step) * step, step);
    if (step * scale >= widest + 8) break;
    step = round_step(1.5 * step);
  }
  return step;
}

double ruler_width(double step, double low, double high) {
  double widest = 0;
  for (const double value : ticks(step, low, high)) {
    widest = std::max(widest, text_width(value, step));
  }
  return widest + 9 + 1.3 * axis_name_size;
}

bool has_rulers(const View& view) {
  return !axis_name(view, 0).empty() && !axis_name(view, 1).empty();
}

void draw_rulers(const Plot& plot, double step, std::vector<PaperMark>& marks) {
  const auto& [projection, box] = plot;
  const PaperPoint low = (box.low - projection.origin) / projection.scale;
  const PaperPoint high = (box.high - projection.origin) / projection.scale;
  double widest = 0;
  const std::vector<double> across = ticks(step, low.x(), high.x());
  const std::vector<double> upward = ticks(step, -high.y(), -low.y());
  for (const double value : across) {
    const double x = projection.origin.x() + projection.scale * value;
    marks.emplace_back(
        line_stroke({x, box.low.y()}, {x, box.high.y()}, value == 0 ? zero_grey : grid_grey, 0.6));
  }
  for (const double value : upward) {
    const double y = projection.origin.y() - projection.scale * value;
    marks.emplace_back(
        line_stroke({box.low.x(), y}, {box.high.x(), y}, value == 0 ? zero_grey : grid_grey, 0.6));
  }
  marks.emplace_back(PaperStroke{
      closed_path({box.low, {box.high.x(), box.low.y()}, box.high, {box.low.x(), box.high.y()}}),
      no_colour,
      frame_grey,
      0.7,
      {}});
  for (const double value : across) {
    const double x = projection.origin.x() + projection.scale * value;
    marks.emplace_back(line_stroke({x, box.high.y()}, {x, box.high.y() + 2.5}, frame_grey, 0.7));
    const double half = text_width(value, step) / 2;
    // A label may extend past the edge of the plot only within the margins.
    if (x - half < box.low.x() - 8 || x + half > box.high.x() + 8) continue;
    marks.emplace_back(PaperText{tick_text(value, step), {x, box.high.y() + 8}, tick_size});
  }
  for (const double value : upward) {
    const double y = projection.origin.y() - projection.scale * value;
    marks.emplace_back(line_stroke({box.low.x() - 2.5, y}, {box.low.x(), y}, frame_grey, 0.7));
    const double width = text_width(value, step);
    widest = std::max(widest, width);
    marks.emplace_back(
        PaperText{tick_text(value, step), {box.low.x() - 4.5 - width / 2, y}, tick_size});
  }
  const PaperPoint middle = (box.low + box.high) / 2;
  marks.emplace_back(PaperText{axis_name(projection.view, 0) + " [m]",
                               {middle.x(), box.high.y() + ruler_height - 0.7 * axis_name_size},
                               axis_name_size});
  PaperText name{axis_name(projection.view, 1) + " [m]",
                 {box.low.x() - 9 - widest - 0.6 * axis_name_size, middle.y()},
                 axis_name_size};
  name.upright = true;
  marks.emplace_back(name);
}

std::vector<Polyline> floor_grid(const Scene& scene, std::span<const Scene> frames) {
  if (!scene.floor) return {};
  std::vector<Footprint> footprints;
  for (const Item& item : scene.items) add_footprints(item.shape, 0, footprints);
  for (const Scene& frame : frames) {
    for (const Item& item : frame.items) add_footprints(item.shape, 0, footprints);
  }
  if (footprints.empty()) return {};
  Vector3 low = footprints.front().at, high = low;
  for (const Footprint& footprint : footprints) {
    low = low.cwiseMin(footprint.at);
    high = high.cwiseMax(footprint.at);
  }
  const double largest = std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff());
  const double size = std::max((high - low).maxCoeff(), 1e-9 * largest);
  if (size < 1e-12) return {};
  const double step = round_step(size / 8);
  // At least a third of the size, so that the grid of an upright or flat arm is not a narrow strip.
  const double min_half = size / 3;
  const auto first = [&](int axis) {
    return std::floor(std::min(low[axis], (low[axis] + high[axis]) / 2 - min_half) / step - 0.1);
  };
  const auto last = [&](int axis) {
    return std::ceil(std::max(high[axis], (low[axis] + high[axis]) / 2 + min_half) / step + 0.1);
  };
  const double first_x = first(0), last_x = last(0), first_y = first(1), last_y = last(1);
  std::vector<Polyline> lines;
  const auto line = [&](double x0, double y0, double x1, double y1) {
    lines.push_back({{{x0 * step, y0 * step, *scene.floor}, {x1 * step, y1 * step, *scene.floor}},
                     grid_grey,
                     0.7});
  };
  for (double x = first_x; x <= last_x; ++x) line(x, first_y, x, last_y);
  for (double y = first_y; y <= last_y; ++y) line(first_x, y, last_x, y);
  return lines;
}

void draw_scale_bar(const Plot& plot, std::vector<PaperMark>& marks) {
  const auto& [projection, box] = plot;
  const PaperPoint origin(box.low.x() + 24, box.high.y() - 14);
  for (int axis = 0; axis < 3; ++axis) {
    const PaperPoint direction = projection.direction(Vector3::Unit(axis));
    if (direction.norm() < 0.1) continue;
    const PaperPoint tip = origin + 20 * direction;
    marks.emplace_back(line_stroke(origin, tip, distinct_colour(axis), 1.4));
    marks.emplace_back(PaperText{std::string(1, "xyz"[axis]), tip + 6 * direction.normalized(),
                                 tick_size, distinct_colour(axis)});
  }
  const double length = round_step(45 / projection.scale);
  const double width = length * projection.scale;
  const PaperPoint right(box.high.x() - 12, box.high.y() - 8);
  const PaperPoint left = right - PaperPoint(width, 0);
  marks.emplace_back(line_stroke(left, right, ink, 1.2));
  for (const PaperPoint& end : {left, right}) {
    marks.emplace_back(line_stroke(end - PaperPoint(0, 3), end + PaperPoint(0, 3), ink, 1.2));
  }
  marks.emplace_back(PaperText{fixed(length, decimals_of(length)) + " m",
                               (left + right) / 2 - PaperPoint(0, 8), tick_size});
}

}  // namespace beeline::internal
