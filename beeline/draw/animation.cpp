#include <algorithm>
#include <cmath>

#include <beeline/draw/animation.h>
#include <beeline/draw/internal/animation_frames.h>
#include <beeline/draw/internal/cairo.h>
#include <beeline/draw/internal/movie.h>
#include <beeline/draw/internal/page_layout.h>
#include <beeline/error.h>
#include <beeline/io/text/file.h>

namespace beeline {
namespace {

using namespace internal;

#ifdef BEELINE_CAIRO
/// Draws the images of the loop at equal steps of time.
class LoopImages {
 public:
  LoopImages(const Animation& animation, const PlaybackOptions& options)
      : animation_(animation),
        options_(options),
        layout_(laid_out(animation.figure, animation.frames)),
        timeline_(timeline_of(animation, options)) {}

  MovieFrames frames() {
    constexpr int max_frames = 1500;
    MovieFrames frames;
    frames.width = even(layout_.width);
    frames.height = even(layout_.height);
    frames.per_second = std::min(options_.frames_per_second, max_frames / timeline_.seconds);
    frames.count = std::max(1, static_cast<int>(std::ceil(timeline_.seconds * frames.per_second)));
    frames.pixels = [this, count = frames.count](int i) { return image(i, count); };
    return frames;
  }

 private:
  static constexpr double scale = 1.5;  // pixels per point

  static int even(double points) { return 2 * static_cast<int>(std::ceil(points * scale / 2)); }

  std::string image(int i, int count) {
    const double at = (i + 0.5) / count;
    const auto later = std::upper_bound(timeline_.frames.begin(), timeline_.frames.end(), at);
    const auto shown = later == timeline_.frames.begin()
                           ? std::size_t{0}
                           : static_cast<std::size_t>(later - timeline_.frames.begin()) - 1;
    if (pixels_.empty() || shown != shown_) pixels_ = drawn(shown);
    shown_ = shown;
    return pixels_;
  }

  std::string drawn(std::size_t k) const {
    Picture picture;
    picture.width = layout_.width;
    picture.height = layout_.height;
    for (const FrameMark& mark : frame_marks(layout_, &animation_.frames[k])) {
      const bool hidden = mark.appears > 0 && mark.appears > animation_.times[k];
      if (!hidden) picture.marks.push_back(*mark.mark);
    }
    return pixels_of(picture, even(layout_.width), even(layout_.height), scale);
  }

  const Animation& animation_;
  const PlaybackOptions& options_;
  PageLayout layout_;
  Timeline timeline_;
  std::size_t shown_ = 0;
  std::string pixels_;
};

std::string movie_of(const Animation& animation, AnimationFormat format,
                     const PlaybackOptions& options) {
  LoopImages images(animation, options);
  return movie(images.frames(), format);
}
#else
std::string movie_of(const Animation&, AnimationFormat, const PlaybackOptions&) {
  throw Error(
      "this build writes animations as .svg only: configure it with -DBEELINE_CAIRO=ON, which "
      "needs Cairo (Debian: libcairo2-dev)");
}
#endif

}  // namespace

AnimationFormat animation_format_of(std::string_view path) {
  const std::string ending = extension(path);
  if (ending == "svg") return AnimationFormat::svg;
  if (ending == "gif") return AnimationFormat::gif;
  if (ending == "mp4") return AnimationFormat::mp4;
  if (ending == "webp") return AnimationFormat::webp;
  throw Error("unknown format of animations in \"" + std::string(path) +
              "\"; it must end in .svg, .gif, .mp4 or .webp");
}

void save(const Animation& animation, const std::string& path, const PlaybackOptions& options) {
  const AnimationFormat format = animation_format_of(path);
  check_playback(animation, options);
  write_file(path, format == AnimationFormat::svg ? animated_svg(animation, options)
                                                  : movie_of(animation, format, options));
}

}  // namespace beeline
