#include <tests/reason/said.h>

namespace beeline::testing {

std::vector<Said> said_of_times() {
  using enum ReasonField;
  return {
      {{ReasonCode::spline_outside_limits, outside},
       "between two samples the spline through them leaves the limits: " + is_outside +
           "; straight joint motions with blends stay within them"},
      {{ReasonCode::spline_outside_limits, with(outside, {{planned, true}})},
       "between two samples the spline through them leaves the limits: " + is_outside +
           "; begin and stop farther inside them"},
      {{ReasonCode::end_speed_too_high, {{speed, 2.0}, {needed_speed, 1.0}}},
       "the speed at the path's end is above its limits: 2 instead of 1"},
      {{ReasonCode::end_speed_unreachable, {{s, 0.5}}},
       "the speed at the path's end cannot be reached: no speed at s = 0.5 leads to it within the "
       "limits"},
      {{ReasonCode::begin_speed_too_high, {{speed, 2.0}, {needed_speed, 1.0}}},
       "the speed at the path's beginning, 2, is too high for the rest of the path, which needs 1"},
      {{ReasonCode::begin_speed_too_low, {{speed, 0.0}, {needed_speed, 1.0}}},
       "the speed at the path's beginning, 0, is too low for the rest of the path, which needs 1"},
      {{ReasonCode::path_not_traversable, {{s, 0.5}, {segment_name, "segment 2"}}},
       "up to the end of segment 2: the path cannot be traversed from s = 0.5"},
      {{ReasonCode::too_many_samples_at_rate,
        {{rate, 100.0}, {max_samples, std::size_t{200}}, {duration, 9.0}, {possible_rate, 20.0}}},
       "100 samples per second make more than 200 in 9 s; a rate of 20 works"},
      {{ReasonCode::no_motion_at_rate, {{rate, 100.0}}},
       "no motion within the limits was found at 100 samples per second"},
      {{ReasonCode::too_many_samples_given,
        {{count, std::size_t{200'001}}, {max_samples, std::size_t{200'000}}}},
       "the trajectory has 200001 samples, more than 200000; allow more samples"},
      {{ReasonCode::duration_too_short, {{duration, 1.0}, {shortest_duration, 2.00000049}}},
       "a duration of 1 s is too short: the shortest within the limits is 2.00001 s"},
  };
}

}  // namespace beeline::testing
