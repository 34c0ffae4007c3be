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
struct Fields<ArmFigureOptions>
    : Members<&ArmFigureOptions::title, &ArmFigureOptions::caption, &ArmFigureOptions::frames,
              &ArmFigureOptions::jacobian, &ArmFigureOptions::azimuth, &ArmFigureOptions::elevation,
              &ArmFigureOptions::small_views, &ArmFigureOptions::ghosts, &ArmFigureOptions::dots> {
};

template <>
struct Fields<TimingFigureOptions> : Members<&TimingFigureOptions::title> {};

template <>
struct Fields<PlaybackOptions>
    : Members<&PlaybackOptions::speed, &PlaybackOptions::rest_before, &PlaybackOptions::rest_after,
              &PlaybackOptions::frames_per_second> {};

}  // namespace beeline::python
