#include <algorithm>
#include <array>
#include <cmath>

#include <beeline/draw/ruler.h>
#include <beeline/draw/symbols.h>
#include <beeline/draw/text.h>
#include <beeline/error.h>

namespace beeline {
namespace {

constexpr Colour grid_grey{0.90, 0.91, 0.925};
constexpr Colour zero_grey{0.76, 0.78, 0.81};
constexpr Colour frame_grey{0.55, 0.57, 0.60};
constexpr double number_size = 7.5;
constexpr double name_size = 8.5;

/// The multiples of step within [low, high], as integers times step; none when they are too many.
std::vector<double> ticks(double step, double low, double high) {
  std::vector<double> values;
  const double first = std::ceil(low / step - 1e-9);
  const double last = std::floor(high / step + 1e-9);
  if (!(last - first < 200)) return values;
  for (double k = first; k <= last; ++k) values.push_back(k * step);
  return values;
}

std::string tick_text(double value, double step) { return fixed(value, decimals_of(step)); }

double text_width(double value, double step) {
  return text_size(tick_text(value, step), number_size).x();
}

Stroke segment(const Point& from, const Point& to, const Colour& colour, double width) {
  return {open_path({from, to}), no_colour, colour, width, {}};
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
  return widest + 9 + 1.3 * name_size;
}

bool has_rulers(const View& view) {
  return !axis_name(view, 0).empty() && !axis_name(view, 1).empty();
}

void draw_rulers(const Plot& plot, double step, std::vector<Mark>& marks) {
  const auto& [projection, box] = plot;
  const Point low = (box.low - projection.origin) / projection.scale;
  const Point high = (box.high - projection.origin) / projection.scale;
  double widest = 0;
  const std::vector<double> across = ticks(step, low.x(), high.x());
  const std::vector<double> upward = ticks(step, -high.y(), -low.y());
  for (const double value : across) {
    const double x = projection.origin.x() + projection.scale * value;
    marks.emplace_back(
        segment({x, box.low.y()}, {x, box.high.y()}, value == 0 ? zero_grey : grid_grey, 0.6));
  }
  for (const double value : upward) {
    const double y = projection.origin.y() - projection.scale * value;
    marks.emplace_back(
        segment({box.low.x(), y}, {box.high.x(), y}, value == 0 ? zero_grey : grid_grey, 0.6));
  }
  marks.emplace_back(Stroke{
      closed_path({box.low, {box.high.x(), box.low.y()}, box.high, {box.low.x(), box.high.y()}}),
      no_colour,
      frame_grey,
      0.7,
      {}});
  for (const double value : across) {
    const double x = projection.origin.x() + projection.scale * value;
    marks.emplace_back(segment({x, box.high.y()}, {x, box.high.y() + 2.5}, frame_grey, 0.7));
    const double half = text_width(value, step) / 2;
    // A number that hangs over the plot's edge has room within the margins only.
    if (x - half < box.low.x() - 8 || x + half > box.high.x() + 8) continue;
    marks.emplace_back(Text{tick_text(value, step), {x, box.high.y() + 8}, number_size});
  }
  for (const double value : upward) {
    const double y = projection.origin.y() - projection.scale * value;
    marks.emplace_back(segment({box.low.x() - 2.5, y}, {box.low.x(), y}, frame_grey, 0.7));
    const double width = text_width(value, step);
    widest = std::max(widest, width);
    marks.emplace_back(
        Text{tick_text(value, step), {box.low.x() - 4.5 - width / 2, y}, number_size});
  }
  const Point middle = (box.low + box.high) / 2;
  marks.emplace_back(Text{axis_name(projection.view, 0) + " [m]",
                          {middle.x(), box.high.y() + ruler_height - 0.7 * name_size},
                          name_size});
  Text name{axis_name(projection.view, 1) + " [m]",
            {box.low.x() - 9 - widest - 0.6 * name_size, middle.y()},
            name_size};
  name.upright = true;
  marks.emplace_back(name);
}

std::vector<Polyline> floor_grid(const Scene& scene) {
  if (!scene.floor) return {};
  std::vector<Foot> feet;
  for (const Item& item : scene.items) add_feet(item.shape, 0, feet);
  if (feet.empty()) return {};
  Vector3 low = feet.front().at, high = low;
  for (const Foot& foot : feet) {
    low = low.cwiseMin(foot.at);
    high = high.cwiseMax(foot.at);
  }
  const double largest = std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff());
  const double size = std::max((high - low).maxCoeff(), 1e-9 * largest);
  if (size < 1e-12) return {};
  const double step = round_step(size / 8);
  // Not a narrow strip, where the arm is upright or in one plane.
  const double least = size / 3;
  const auto first = [&](int axis) {
    return std::floor(std::min(low[axis], (low[axis] + high[axis]) / 2 - least) / step - 0.1);
  };
  const auto last = [&](int axis) {
    return std::ceil(std::max(high[axis], (low[axis] + high[axis]) / 2 + least) / step + 0.1);
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

void draw_scale_bar(const Plot& plot, std::vector<Mark>& marks) {
  const auto& [projection, box] = plot;
  const Point origin(box.low.x() + 24, box.high.y() - 14);
  for (int axis = 0; axis < 3; ++axis) {
    const Point way = projection.direction(Vector3::Unit(axis));
    if (way.norm() < 0.1) continue;
    const Point tip = origin + 20 * way;
    marks.emplace_back(segment(origin, tip, distinct_colour(axis), 1.4));
    marks.emplace_back(Text{std::string(1, "xyz"[axis]), tip + 6 * way.normalized(), number_size,
                            distinct_colour(axis)});
  }
  const double length = round_step(45 / projection.scale);
  const double width = length * projection.scale;
  const Point right(box.high.x() - 12, box.high.y() - 8);
  const Point left = right - Point(width, 0);
  marks.emplace_back(segment(left, right, ink, 1.2));
  for (const Point& end : {left, right}) {
    marks.emplace_back(segment(end - Point(0, 3), end + Point(0, 3), ink, 1.2));
  }
  marks.emplace_back(Text{fixed(length, decimals_of(length)) + " m",
                          (left + right) / 2 - Point(0, 8), number_size});
}

}  // namespace beeline
