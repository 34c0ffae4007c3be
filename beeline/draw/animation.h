#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <beeline/draw/figure.h>
#include <beeline/error.h>

namespace beeline {

/// A figure that moves: its still part, and items that change with time.
struct Animation {
  Figure figure;              ///< still part; Item::appears counts in the units of `times`
  std::vector<double> times;  ///< times of the frames, seconds, strictly increasing
  /// For each time, the drawing that every panel shows beside its own.
  std::vector<Drawing> frames;
};

/// Playback of an animation: a loop of at most a day, at rest before it begins and after it ends.
struct PlaybackOptions {
  double speed = 1;          ///< playback speed relative to the animation's times, from 1e-3 to 1e3
  double rest_before = 0.5;  ///< seconds at rest at the start, 0 to 60
  double rest_after = 1.5;   ///< seconds at rest at the end, 0 to 60
  double frames_per_second = 25;  ///< frame rate of .gif, .mp4 and .webp, from 1 to 60 1/s
};

/// Throws Error for an animation without frames, for times that do not fit them or do not increase,
/// and for options out of range.
void check_playback(const Animation& animation, const PlaybackOptions& options);

enum class AnimationFormat { svg, gif, mp4, webp };

/// Returns the format that the file extension names, in upper or lower case. Throws Error for any
/// other extension.
AnimationFormat animation_format_of(std::string_view path);

/// Returns the animation as an SVG file that plays in any browser (SMIL; no script). Between its
/// keyframes points move linearly in time, within 0.15 points of their positions at all times of
/// the animation. If the moving part would exceed `max_svg_size`, the tolerance increases up to 2
/// points, and frames are omitted. Viewers that do not animate, and readers who prefer reduced
/// motion, see the last frame. Equal animations give equal files. Throws Error where compose()
/// does, and for options out of range.
std::string animated_svg(const Animation& animation, const PlaybackOptions& options = {});
constexpr std::size_t max_svg_size =
    400'000;  ///< max size of the moving part of an SVG animation, bytes

/// Writes the animation in the format that the path's extension names, as save() of a figure does.
/// The library writes SVG. The program `ffmpeg` encodes gif, mp4 and webp from frames drawn by
/// Cairo, at most 1500 of them: a longer animation has fewer frames per second. An mp4 ends at the
/// point where other formats begin again. Throws Error when the program is missing or fails.
void save(const Animation& animation, const std::string& path, const PlaybackOptions& options = {});

}  // namespace beeline
