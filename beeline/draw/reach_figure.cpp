#include <algorithm>
#include <array>
#include <cmath>

#include <beeline/draw/arm_figure.h>
#include <beeline/draw/internal/arm_drawing.h>
#include <beeline/draw/timing_figure.h>

namespace beeline {
namespace {

constexpr int shades = 16;

/// From dark blue for 0 to yellow for 1; the lightness rises evenly, so that it is legible in grey.
Colour shade(double fraction) {
  constexpr std::array<Colour, 5> stops{{{0.20, 0.12, 0.42},
                                         {0.17, 0.36, 0.62},
                                         {0.10, 0.58, 0.60},
                                         {0.45, 0.78, 0.40},
                                         {0.98, 0.90, 0.25}}};
  const double place = std::clamp(fraction, 0.0, 1.0) * (stops.size() - 1);
  const auto k = std::min(static_cast<std::size_t>(place), stops.size() - 2);
  const double t = place - static_cast<double>(k);
  const auto mix = [t](double a, double b) { return a + t * (b - a); };
  return {mix(stops[k].red, stops[k + 1].red), mix(stops[k].green, stops[k + 1].green),
          mix(stops[k].blue, stops[k + 1].blue)};
}

int shade_of(float value, double most) {
  if (std::isnan(value)) return -1;
  return std::min(shades - 1, static_cast<int>(shades * static_cast<double>(value) / most));
}

Colour colour_of(int k) { return shade((k + 0.5) / shades); }

/// Adds the cells of one shade; runs along the second axis become one rectangle.
std::array<Tiles, shades> tiles_of(const ReachSlice& slice, double most) {
  std::array<Tiles, shades> tiles;
  for (int k = 0; k < shades; ++k) tiles[static_cast<std::size_t>(k)].colour = colour_of(k);
  const double half = slice.grid[0].step / 2;
  for (Eigen::Index i = 0; i < slice.values.rows(); ++i) {
    for (Eigen::Index j = 0; j < slice.values.cols();) {
      const int k = shade_of(slice.values(i, j), most);
      Eigen::Index end = j + 1;
      while (end < slice.values.cols() && shade_of(slice.values(i, end), most) == k) ++end;
      if (k >= 0) {
        const double x = slice.grid[0].centre(i);
        const double low = slice.grid[1].centre(j) - half,
                     high = slice.grid[1].centre(end - 1) + half;
        Tiles::Corners corners;
        const std::array<std::array<double, 2>, 4> flat{
            {{x - half, low}, {x + half, low}, {x + half, high}, {x - half, high}}};
        for (std::size_t c = 0; c < 4; ++c) {
          corners[c][slice.normal] = slice.at;
          corners[c][slice.axes[0]] = flat[c][0];
          corners[c][slice.axes[1]] = flat[c][1];
        }
        tiles[static_cast<std::size_t>(k)].tiles.push_back(corners);
      }
      j = end;
    }
  }
  return tiles;
}

/// Adds the shades from 0 to `most`, as high as the slice.
Panel scale_of(const ReachSlice& slice, double most) {
  const double height = slice.grid[1].upper() - slice.grid[1].lower;
  Panel panel{.axes = false};
  const double step = height / shades, width = height / 14;
  for (int k = 0; k < shades; ++k) {
    Tiles tiles{.colour = colour_of(k)};
    tiles.tiles.push_back({Vector3(0, k * step, 0), Vector3(width, k * step, 0),
                           Vector3(width, (k + 1) * step, 0), Vector3(0, (k + 1) * step, 0)});
    panel.drawing.add(Layer::ground, tiles);
  }
  for (int k = 0; k <= shades; k += shades / 4) {
    panel.drawing.add(
        Layer::note,
        Label{.at = Vector3(width, k * step, 0), .text = number(most * k / shades), .up = 0});
  }
  return panel;
}

std::string caption_of(const ReachSlice& slice) {
  const std::string plane = std::string(1, "xyz"[slice.normal]) + " = " + number(slice.at) + " m";
  switch (slice.measure) {
    case ReachMeasure::directions:
      return plane + ", fraction of the tool directions that are reached";
    case ReachMeasure::branches:
      return plane + ", largest number of solutions";
    case ReachMeasure::manipulability:
      return plane + ", largest manipulability";
    case ReachMeasure::margin:
      break;
  }
  return plane + ", largest margin to the joint limits";
}

/// Returns the value of the last shade.
double largest_of(const ReachSlice& slice) {
  double most = slice.measure == ReachMeasure::directions ? 1 : 0;
  for (const float value : slice.values.reshaped()) {
    if (value > most) most = static_cast<double>(value);
  }
  return most;
}

Panel panel_of(const ReachSlice& slice, double most) {
  Panel panel{.view = slice.normal == 2   ? top_view()
                      : slice.normal == 1 ? front_view()
                                          : side_view()};
  for (Tiles& tiles : tiles_of(slice, most)) {
    if (!tiles.tiles.empty()) panel.drawing.add(Layer::ground, std::move(tiles));
  }
  internal::add_arm(panel.drawing, slice.arm, display_configuration(slice.arm), {.tool = false});
  return panel;
}

}  // namespace

Figure reach_figure(const ReachSlice& slice) {
  const double largest = largest_of(slice), most = largest > 0 ? largest : 1;
  Panel panel = panel_of(slice, most);
  panel.caption = caption_of(slice);
  return {.title = slice.title, .columns = {{panel}, {scale_of(slice, most)}}};
}

Figure reach_figure(const std::array<ReachSlice, 2>& slices) {
  if (caption_of(slices[0]) != caption_of(slices[1])) {
    throw Error("the slices differ: " + caption_of(slices[0]) + "; " + caption_of(slices[1]));
  }
  const double largest = std::max(largest_of(slices[0]), largest_of(slices[1]));
  const double most = largest > 0 ? largest : 1;
  Figure figure{.title = caption_of(slices[0]), .columns = {}, .width = 900};
  for (const ReachSlice& slice : slices) {
    Panel panel = panel_of(slice, most);
    panel.caption = slice.title;
    figure.columns.push_back({panel});
  }
  figure.columns.push_back({scale_of(slices[0], most)});
  return figure;
}

}  // namespace beeline
