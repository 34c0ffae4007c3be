#include <algorithm>

#include <beeline/draw/internal/axes.h>
#include <beeline/draw/internal/text.h>

namespace beeline::internal {
namespace {

double x_of(const PaperBox& plot, const Scale& scale, double value) {
  return on_paper(scale, value, plot.low.x(), plot.high.x());
}

double y_of(const PaperBox& plot, const Scale& scale, double value) {
  return on_paper(scale, value, plot.high.y(), plot.low.y());
}

}  // namespace

double on_paper(const Scale& scale, double value, double from, double to) {
  const double fraction = std::clamp((value - scale.low) / (scale.high - scale.low), 0.0, 1.0);
  return from + fraction * (to - from);
}

double side_width(const Scale& scale) { return 9 + widest_tick(scale) + 1.3 * axis_name_size; }

void draw_grid(const PaperBox& plot, const Scale& x, const Scale& y,
               std::vector<PaperMark>& marks) {
  const auto& [low, high] = plot;
  const auto line = [&](const PaperPoint& from, const PaperPoint& to, bool zero) {
    marks.emplace_back(line_stroke(from, to, zero ? zero_grey : grid_grey, 0.6));
  };
  for (const double value : ticks(x)) {
    const double at = x_of(plot, x, value);
    line({at, low.y()}, {at, high.y()}, value == 0);
  }
  for (const double value : ticks(y)) {
    const double at = y_of(plot, y, value);
    line({low.x(), at}, {high.x(), at}, value == 0);
  }
}

void draw_frame(const PaperBox& plot, std::vector<PaperMark>& marks) {
  const auto& [low, high] = plot;
  marks.emplace_back(PaperStroke{closed_path({low, {high.x(), low.y()}, high, {low.x(), high.y()}}),
                                 no_colour,
                                 frame_grey,
                                 0.7,
                                 {}});
}

void draw_side(const PaperBox& plot, const Scale& scale, const std::string& name, bool right,
               std::vector<PaperMark>& marks) {
  const double edge = right ? plot.high.x() : plot.low.x(), out = right ? 1 : -1;
  for (const double value : ticks(scale)) {
    const double y = y_of(plot, scale, value);
    const std::string text = tick_text(scale, value);
    marks.emplace_back(line_stroke({edge, y}, {edge + 2.5 * out, y}, frame_grey, 0.7));
    const double half = text_size(text, tick_size).x() / 2;
    marks.emplace_back(PaperText{text, {edge + out * (4.5 + half), y}, tick_size});
  }
  PaperText text{cut_to(with_power(name, scale.exponent), axis_name_size, plot.size().y() + 12),
                 {edge + out * (8 + widest_tick(scale) + 0.6 * axis_name_size),
                  (plot.low.y() + plot.high.y()) / 2},
                 axis_name_size};
  text.upright = true;
  marks.emplace_back(text);
}

void draw_below(const PaperBox& plot, const Scale& scale, const std::string& name,
                std::vector<PaperMark>& marks) {
  const double bottom = plot.high.y();
  for (const double value : ticks(scale)) {
    const double x = x_of(plot, scale, value);
    const std::string text = tick_text(scale, value);
    marks.emplace_back(line_stroke({x, bottom}, {x, bottom + 2.5}, frame_grey, 0.7));
    const double half = text_size(text, tick_size).x() / 2;
    // A label may extend past the edge of the plot only within the margins.
    if (x - half < plot.low.x() - 8 || x + half > plot.high.x() + 8) continue;
    marks.emplace_back(PaperText{text, {x, bottom + 8}, tick_size});
  }
  marks.emplace_back(
      PaperText{cut_to(with_power(name, scale.exponent), axis_name_size, plot.size().x()),
                {(plot.low.x() + plot.high.x()) / 2, bottom + 18.5},
                axis_name_size});
}

}  // namespace beeline::internal
