#include <algorithm>
#include <functional>
#include <iterator>
#include <set>

#include <beeline/draw/animation.h>
#include <beeline/draw/internal/animation_frames.h>
#include <beeline/draw/internal/keyframes.h>
#include <beeline/draw/internal/moving_marks.h>
#include <beeline/draw/internal/page_layout.h>
#include <beeline/draw/internal/svg.h>
#include <beeline/error.h>

namespace beeline {
using namespace internal;
namespace {

using Frames = std::vector<std::vector<FrameMark>>;

/// A mark, identified by its source and its number among the marks of this source.
struct MarkKey {
  MarkSource source;
  std::size_t number = 0;
  auto operator<=>(const MarkKey&) const = default;
};

std::vector<MarkKey> keys_of(const std::vector<FrameMark>& frame) {
  std::vector<MarkKey> keys;
  for (const FrameMark& mark : frame) {
    const bool same = !keys.empty() && keys.back().source == mark.source;
    keys.push_back({mark.source, same ? keys.back().number + 1 : 0});
  }
  return keys;
}

/// Returns the keys of `wanted` in the order of the frame.
std::vector<MarkKey> in_order_of(const std::vector<MarkKey>& frame,
                                 const std::set<MarkKey>& wanted) {
  std::vector<MarkKey> keys;
  std::copy_if(frame.begin(), frame.end(), std::back_inserter(keys),
               [&](const MarkKey& key) { return wanted.count(key) > 0; });
  return keys;
}

bool same_mark(const FrameMark& a, const FrameMark& b) {
  return a.mark == b.mark || *a.mark == *b.mark;
}

/// Returns the marks that are equal in all frames and stand in one order, in that order.
std::vector<MarkKey> still_marks(const Frames& frames,
                                 const std::vector<std::vector<MarkKey>>& keys) {
  std::set<MarkKey> still(keys.front().begin(), keys.front().end());
  for (std::size_t k = 1; k < frames.size(); ++k) {
    std::set<MarkKey> equal;
    std::size_t i = 0;
    for (std::size_t n = 0; n < frames[k].size(); ++n) {
      if (still.count(keys[k][n]) == 0) continue;
      // This is usually the next mark of the first frame.
      if (i >= keys[0].size() || keys[0][i] != keys[k][n]) {
        i = static_cast<std::size_t>(std::find(keys[0].begin(), keys[0].end(), keys[k][n]) -
                                     keys[0].begin());
      }
      if (same_mark(frames[k][n], frames[0][i])) equal.insert(keys[k][n]);
      ++i;
    }
    still = std::move(equal);
  }
  const auto one_order = [&] {
    const std::vector<MarkKey> order = in_order_of(keys.front(), still);
    return std::all_of(keys.begin(), keys.end(), [&](const std::vector<MarkKey>& frame) {
      return in_order_of(frame, still) == order;
    });
  };
  if (!one_order()) {
    std::erase_if(still,
                  [](const MarkKey& key) { return key.source.kind == MarkSource::Kind::moving; });
  }
  if (!one_order()) still.clear();
  return in_order_of(keys.front(), still);
}

/// The frames, divided at the still marks: part i of a frame stands before still mark i.
struct CutFrames {
  std::vector<std::vector<FrameSlice>> parts;  ///< for each part, its slice of each frame
  std::vector<const FrameMark*> still;         ///< still marks, one fewer than parts
};

CutFrames cut(const Frames& frames) {
  std::vector<std::vector<MarkKey>> keys;
  for (const auto& frame : frames) keys.push_back(keys_of(frame));
  const std::vector<MarkKey> still = still_marks(frames, keys);
  CutFrames result;
  result.parts.resize(still.size() + 1);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    std::size_t begin = 0, part = 0;
    for (std::size_t n = 0; n <= frames[k].size(); ++n) {
      const bool at_still =
          n < frames[k].size() && part < still.size() && keys[k][n] == still[part];
      if (n < frames[k].size() && !at_still) continue;
      result.parts[part].push_back(FrameSlice(frames[k]).subspan(begin, n - begin));
      if (at_still && k == 0) result.still.push_back(&frames[k][n]);
      begin = n + 1;
      ++part;
    }
  }
  return result;
}

/// The moving parts and the still marks between them, as elements.
struct Elements {
  std::string text;
  std::size_t moving_size = 0;  ///< bytes of the moving elements
};

Elements elements_of(const CutFrames& cut_frames, const Timeline& timeline, double tolerance,
                     const std::function<double(double)>& fraction) {
  Elements result;
  for (std::size_t i = 0; i < cut_frames.parts.size(); ++i) {
    const std::vector<FrameSlice>& part = cut_frames.parts[i];
    const bool is_empty = std::all_of(part.begin(), part.end(),
                                      [](const FrameSlice& slice) { return slice.empty(); });
    const std::string moving = is_empty ? "" : moving_elements(timeline, part, tolerance);
    result.moving_size += moving.size();
    result.text += moving;
    if (i == cut_frames.still.size()) continue;
    const FrameMark& mark = *cut_frames.still[i];
    const bool later = mark.appears > 0;
    result.text += svg_element(
        *mark.mark, later ? visible_between(timeline, fraction(mark.appears), 1) : std::string());
  }
  return result;
}

/// Returns every `stride`-th frame and the last.
std::vector<std::size_t> every(std::size_t stride, std::size_t count) {
  std::vector<std::size_t> kept;
  for (std::size_t k = 0; k + 1 < count; k += stride) kept.push_back(k);
  kept.push_back(count - 1);
  return kept;
}

/// Returns the elements with at most `max_svg_size` bytes of moving parts, or as few as possible.
std::string bounded_elements(const Frames& all, const Timeline& timeline,
                             const std::function<double(double)>& fraction) {
  Elements elements;
  for (std::size_t stride = 1; stride == 1 || stride < all.size(); stride *= 2) {
    Frames frames;
    Timeline shown{{}, timeline.seconds};
    for (const std::size_t k : every(stride, all.size())) {
      frames.push_back(all[k]);
      shown.frames.push_back(timeline.frames[k]);
    }
    const CutFrames parts = cut(frames);
    constexpr double smallest = 0.15, largest = 2;  // points
    elements = elements_of(parts, shown, largest, fraction);
    if (elements.moving_size > max_svg_size) continue;
    for (double tolerance = smallest; tolerance < largest; tolerance *= 1.6) {
      Elements finer = elements_of(parts, shown, tolerance, fraction);
      if (finer.moving_size <= max_svg_size) return std::move(finer.text);
    }
    return elements.text;
  }
  return elements.text;
}

}  // namespace

std::string animated_svg(const Animation& animation, const PlaybackOptions& options) {
  check_playback(animation, options);
  const PageLayout layout = laid_out(animation.figure, animation.frames);
  Frames frames;
  for (const Drawing& frame : animation.frames) frames.push_back(frame_marks(layout, &frame));
  Picture page;
  page.width = layout.width;
  page.height = layout.height;
  std::string svg = svg_begin(page) +
                    "<style>@media (prefers-reduced-motion: reduce) "
                    "{ .moving { display: none } .still { display: inline } }</style>\n"
                    "<g class=\"moving\">\n";
  svg += bounded_elements(frames, timeline_of(animation, options),
                          [&](double t) { return fraction_at(animation, options, t); });
  svg += "</g>\n<g class=\"still\" display=\"none\">\n";
  for (const FrameMark& mark : frames.back()) svg += svg_element(*mark.mark);
  return svg + "</g>\n" + svg_end;
}

}  // namespace beeline
