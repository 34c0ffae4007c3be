#include <algorithm>
#include <cmath>
#include <functional>

#include <beeline/draw/internal/moving_marks.h>
#include <beeline/draw/internal/svg.h>

namespace beeline::internal {
namespace {

constexpr double same_colour = 0.0157;  // four steps of 255

/// Returns whether two marks differ only in the positions of points and in colours.
bool correspond(const FrameMark& a, const FrameMark& b) {
  if (a.source != b.source || a.appears != b.appears) return false;
  const auto *stroke_a = std::get_if<PaperStroke>(a.mark.get()),
             *stroke_b = std::get_if<PaperStroke>(b.mark.get());
  if (stroke_a == nullptr || stroke_b == nullptr) return *a.mark == *b.mark;
  return stroke_a->path.verbs == stroke_b->path.verbs && stroke_a->width == stroke_b->width &&
         stroke_a->dashes == stroke_b->dashes && stroke_a->fill.alpha == stroke_b->fill.alpha &&
         stroke_a->line.alpha == stroke_b->line.alpha;
}

bool correspond(const FrameSlice& a, const FrameSlice& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const FrameMark& x, const FrameMark& y) { return correspond(x, y); });
}

/// Returns the marks of each source; marks of one source are consecutive.
std::vector<FrameSlice> by_source(const FrameSlice& marks) {
  std::vector<FrameSlice> groups;
  for (std::size_t begin = 0; begin < marks.size();) {
    std::size_t end = begin + 1;
    while (end < marks.size() && marks[end].source == marks[begin].source) ++end;
    groups.push_back(marks.subspan(begin, end - begin));
    begin = end;
  }
  return groups;
}

bool same_sources(const std::vector<FrameSlice>& a, const std::vector<FrameSlice>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const FrameSlice& x, const FrameSlice& y) {
                      return x.front().source == y.front().source;
                    });
}

double distance(const Colour& a, const Colour& b) {
  return std::max(
      {std::abs(a.red - b.red), std::abs(a.green - b.green), std::abs(a.blue - b.blue)});
}

Colour blend_of(const Colour& a, const Colour& b, double t) {
  return {a.red + t * (b.red - a.red), a.green + t * (b.green - a.green),
          a.blue + t * (b.blue - a.blue), a.alpha};
}

/// Consecutive frames first..last whose marks correspond.
class Run {
 public:
  Run(const Timeline& timeline, const std::vector<FrameSlice>& frames, std::size_t first,
      std::size_t last, double tolerance)
      : timeline_(timeline), frames_(frames), first_(first), last_(last), tolerance_(tolerance) {}

  std::string elements() const {
    std::string text;
    const FrameSlice& end = frames_[last_];
    for (std::size_t j = 0; j < end.size(); ++j) text += svg_element(*end[j].mark, animations(j));
    return text;
  }

 private:
  const PaperStroke* stroke(std::size_t k, std::size_t j) const {
    return std::get_if<PaperStroke>(frames_[k][j].mark.get());
  }

  bool keeps_colours(std::size_t j) const {
    for (std::size_t k = first_; k <= last_; ++k) {
      if (distance(stroke(k, j)->fill, stroke(last_, j)->fill) > same_colour ||
          distance(stroke(k, j)->line, stroke(last_, j)->line) > same_colour) {
        return false;
      }
    }
    return true;
  }

  std::string animations(std::size_t j) const {
    if (stroke(last_, j) == nullptr) return "";
    std::string text = path_animation(j);
    if (keeps_colours(j)) return text;
    text += colour_animation(j, "fill", &PaperStroke::fill);
    return text + colour_animation(j, "stroke", &PaperStroke::line);
  }

  /// Returns the animation of the attribute `name` of mark j: `text(k)` is its value in frame k.
  std::string animation(const char* name, double tolerance, const auto& off,
                        const auto& text) const {
    const std::vector<std::size_t> keys =
        thinned_keyframes(timeline_, first_, last_, tolerance, off);
    std::vector<std::string> values;
    for (const std::size_t k : keys) values.push_back(text(k));
    if (std::adjacent_find(values.begin(), values.end(), std::not_equal_to<>()) == values.end()) {
      return "";
    }
    return std::string("<animate attributeName=\"") + name + "\" " +
           animation_values(timeline_, keys, values) + "/>";
  }

  std::string path_animation(std::size_t j) const {
    const auto off = [&](std::size_t i, std::size_t a, std::size_t b, double t) {
      const auto &from = stroke(a, j)->path.points, &to = stroke(b, j)->path.points,
                 &at = stroke(i, j)->path.points;
      double largest = 0;
      for (std::size_t n = 0; n < at.size(); ++n) {
        largest = std::max(largest, (at[n] - from[n] - t * (to[n] - from[n])).squaredNorm());
      }
      return std::sqrt(largest);
    };
    const auto text = [&](std::size_t k) { return path_data(stroke(k, j)->path); };
    return animation("d", tolerance_, off, text);
  }

  std::string colour_animation(std::size_t j, const char* name, Colour PaperStroke::*part) const {
    if ((stroke(last_, j)->*part).alpha == 0) return "";
    const auto off = [&](std::size_t i, std::size_t a, std::size_t b, double t) {
      return distance(stroke(i, j)->*part, blend_of(stroke(a, j)->*part, stroke(b, j)->*part, t));
    };
    return animation(name, same_colour, off,
                     [&](std::size_t k) { return svg_colour(stroke(k, j)->*part); });
  }

  const Timeline& timeline_;
  const std::vector<FrameSlice>& frames_;
  std::size_t first_, last_;
  double tolerance_;
};

/// Returns the group that shows these elements in the frames first..last.
std::string shown_in(const Timeline& timeline, std::size_t first, std::size_t last,
                     const std::string& elements) {
  const bool at_end = last + 1 == timeline.frames.size();
  const std::string visible = visible_between(timeline, first == 0 ? 0 : timeline.frames[first],
                                              at_end ? 1 : timeline.frames[last + 1]);
  if (visible.empty() || elements.empty()) return elements;
  return std::string(at_end ? "<g>" : "<g visibility=\"hidden\">") + visible + "\n" + elements +
         "</g>\n";
}

/// Returns the elements of one source in the frames first..last.
std::string source_elements(const Timeline& timeline, const std::vector<FrameSlice>& frames,
                            std::size_t first, std::size_t last, double tolerance) {
  std::string text;
  for (std::size_t begin = first; begin <= last;) {
    std::size_t end = begin;
    while (end < last && correspond(frames[end], frames[end + 1])) ++end;
    const std::string elements = Run(timeline, frames, begin, end, tolerance).elements();
    const bool whole = begin == first && end == last;
    text += whole ? elements : shown_in(timeline, begin, end, elements);
    begin = end + 1;
  }
  return text;
}

}  // namespace

std::string moving_elements(const Timeline& timeline, const std::vector<FrameSlice>& frames,
                            double tolerance) {
  std::vector<std::vector<FrameSlice>> groups;
  for (const FrameSlice& frame : frames) groups.push_back(by_source(frame));
  std::string text;
  for (std::size_t first = 0; first < frames.size();) {
    std::size_t last = first;
    while (last + 1 < frames.size() && same_sources(groups[last], groups[last + 1])) ++last;
    std::string elements;
    for (std::size_t i = 0; i < groups[first].size(); ++i) {
      std::vector<FrameSlice> source(frames.size());
      for (std::size_t k = first; k <= last; ++k) source[k] = groups[k][i];
      elements += source_elements(timeline, source, first, last, tolerance);
    }
    text += shown_in(timeline, first, last, elements);
    first = last + 1;
  }
  return text;
}

}  // namespace beeline::internal
