#include <algorithm>
#include <array>
#include <cmath>

#include <beeline/draw/internal/axes.h>
#include <beeline/draw/internal/paper_shapes.h>
#include <beeline/draw/internal/ruler.h>
#include <beeline/draw/internal/symbols.h>
#include <beeline/draw/internal/text.h>
#include <beeline/error.h>

namespace beeline::internal {
double tick_step(double scale, double largest) {
  Scale both{-largest, largest};
  set_level_ticks(both, 2 * largest * scale, 29);
  return both.step;
}

bool has_rulers(const View& view) {
  return !axis_name(view, 0).empty() && !axis_name(view, 1).empty();
}

Scale ruler(const PaperBox& relative, int axis, double scale, double step) {
  const PaperPoint low = relative.low / scale, high = relative.high / scale;
  return axis == 0 ? Scale{low.x(), high.x(), step} : Scale{-high.y(), -low.y(), step};
}

void draw_rulers(const Plot& plot, double step, std::vector<PaperMark>& marks) {
  const auto& [projection, box] = plot;
  const PaperBox relative{box.low - projection.origin, box.high - projection.origin};
  const Scale x = ruler(relative, 0, projection.scale, step);
  const Scale y = ruler(relative, 1, projection.scale, step);
  draw_grid(box, x, y, marks);
  draw_frame(box, marks);
  draw_below(box, x, axis_name(projection.view, 0) + " [m]", marks);
  draw_side(box, y, axis_name(projection.view, 1) + " [m]", false, marks);
}

std::vector<Polyline> floor_grid(const Drawing& drawing, std::span<const Drawing> frames) {
  if (!drawing.floor) return {};
  std::vector<Footprint> footprints;
  for (const Item& item : drawing.items) add_footprints(item.shape, 0, footprints);
  for (const Drawing& frame : frames) {
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
  // The grid has at least a third of the size, so that it is not a narrow strip for an upright or
  // flat arm.
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
    lines.push_back(
        {{{x0 * step, y0 * step, *drawing.floor}, {x1 * step, y1 * step, *drawing.floor}},
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
