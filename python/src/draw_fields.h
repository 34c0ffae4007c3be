#pragma once

#include <beeline/draw/arm_figure.h>
#include <beeline/draw/timing_figure.h>

#include "interruption.h"
#include "record.h"

namespace beeline::python {

/// An animation and how it is played.
struct PlayedAnimation {
  Animation animation;
  PlaybackOptions playback;

  /// Throws Error for options that it cannot be played with.
  PlayedAnimation(Animation made, const PlaybackOptions& options);
};

template <class Work>
auto without_lock(Work work) {
  const LockRelease release;
  return work();
}

/// The picture for notebooks, not wider than their cells.
nb::str notebook_svg(const Picture& picture);

void bind_pages(nb::module_& module);

template <>
struct Fields<ArmFigureOptions> {
  static constexpr auto all() {
    using Options = ArmFigureOptions;
    return std::tuple(
        field("title", &Options::title, "Default: the arm's name."),
        field("caption", &Options::caption, "Default: the tool's position."),
        field("frames", &Options::frames, "Draw the frame of every link: x red, y green, z blue."),
        field("jacobian", &Options::jacobian,
              "Draw the Jacobian's columns as arrows at the tool: joint 1 red, 2 green, 3 blue."),
        field("azimuth", &Options::azimuth,
              "Of the viewer of a spatial arm, from x towards y, rad."),
        field("elevation", &Options::elevation, "Of the viewer above the ground, rad."),
        field("small_views", &Options::small_views,
              "Add small views from above and from the front (spatial arms)."),
        field("ghosts", &Options::ghosts,
              "Number of earlier configurations of a motion, drawn faded, 0 to 1000."),
        field("dots", &Options::dots,
              "Number of dots on the trail of a motion, at equal times, up to 100000."));
  }
};

template <>
struct Fields<PlaybackOptions> {
  static constexpr auto all() {
    using Options = PlaybackOptions;
    return std::tuple(
        field("speed", &Options::speed, "Relative to the motion's times, from 1e-3 to 1e3."),
        field("rest_before", &Options::rest_before, "Seconds at rest at the start, 0 to 60."),
        field("rest_after", &Options::rest_after, "Seconds at rest at the end, 0 to 60."),
        field("frames_per_second", &Options::frames_per_second,
              "Of .gif, .mp4 and .webp, from 1 to 60."));
  }
};

}  // namespace beeline::python
