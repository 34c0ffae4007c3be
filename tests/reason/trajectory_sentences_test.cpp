#include <tests/reason/said.h>

namespace beeline::testing {

namespace {

Fields near_its_limit() {
  using enum ReasonField;
  return with(of_joint, {{value, 1.00000001}, {lower, -1.0}, {upper, 1.0}});
}

Said off_beyond_blend() {
  using enum ReasonField;
  const Fields blend = with(of_joint, {{limit, 0.02}, {angle_limit, 0.1}, {error, 0.5}});
  return {{ReasonCode::off_path, with(with(off, {{segment_name, "line 1"}}), blend)},
          "the tool is off line 1 by " + by_both +
              "; its blend allows 0.02 m and 0.1 rad, and joint j2 is 0.5 rad from the waypoint's "
              "value"};
}

}  // namespace

std::vector<Said> said_of_trajectories() {
  using enum ReasonField;
  const std::string at = "at 0.5 s, sample 51: ";
  const Fields above = with(of_joint, {{quantity, "acceleration"}, {value, 2.0}, {limit, 1.0}});
  const Fields named = with(at_sample, {{segment_name, "line 1"}});
  const Fields jumps = with(with(at_sample, off), {{is_line, true}, {change, 0.7}});
  return {
      {{ReasonCode::outside_limits, with(at_sample, outside)},
       at + "joint j2 is at 2 rad, outside its limits of -1 to 1 rad"},
      {{ReasonCode::outside_limits, near_its_limit()},
       "joint j2 is at 1 rad, outside its limits of -1 to 1 rad by 1e-08 rad"},
      {{ReasonCode::moves_outside_limits, with(outside, {{interpolation, "cubic"}})},
       "joint j2 moves to 2 rad before the next sample, by the cubic with its velocities: outside "
       "its limits of -1 to 1 rad"},
      {{ReasonCode::excess_rises, with(outside, {{change, 0.5}})},
       "joint j2 starts outside its limits and does not return steadily: at 2 rad, outside its "
       "limits of -1 to 1 rad, it moves out by 0.5 rad"},
      {{ReasonCode::rotates_too_far, with(of_joint, {{change, 3.2}})},
       "joint j2 rotates by 3.2 rad to the next sample, 0.509296 revolutions"},
      {{ReasonCode::derivative_needed, above},
       "joint j2 needs 2 rad/s^2 over the next samples; its limit is 1 rad/s^2"},
      {{ReasonCode::derivative_reached, with(above, {{assumed, true}})},
       "joint j2 reaches 2 rad/s^2 before the next sample; its limit is not known, 1 rad/s^2 is "
       "assumed; give the joint's acceleration limit"},
      {{ReasonCode::starts_moving, with(of_joint, {{value, 0.1}})},
       "joint j2 starts at 0.1 rad/s, not at rest"},
      {{ReasonCode::ends_moving, with(of_joint, {{value, 0.1}})},
       "joint j2 ends at 0.1 rad/s, not at rest"},
      {{ReasonCode::off_path, with(named, off)}, at + "the tool is off line 1 by " + by_both},
      off_beyond_blend(),
      {{ReasonCode::moves_backwards, with(named, off)},
       at + "the tool moves backwards on line 1 by " + by_both},
      {{ReasonCode::may_move_backwards, with(named, off)},
       at + "up to the next sample the tool moves backwards on line 1 by up to " + by_both},
      {{ReasonCode::deviation_unproved, jumps},
       at + "up to the next sample the tool is only proved to stay within " + by_both +
           " of the line; a joint moves by 0.7, as at a change of branch"},
      {{ReasonCode::deviation_unproved,
        with(at_sample,
             {{distance, 0.01234561}, {angle, 0.1234561}, {is_line, true}, {change, 1.0}})},
       at + "up to the next sample the tool is only proved to stay within 0.0123457 m and 0.123457 "
            "rad (7.07352 deg) of the line; a joint moves by 1, as at a change of branch"},
      {{ReasonCode::leaves_path, with(off, {{more_samples, std::size_t{200}}})},
       "up to the next sample the tool leaves the path by " + by_both +
           ", or more than 200 samples"},
      {{ReasonCode::leaves_last_waypoint, off}, "the tool leaves the last waypoint by " + by_both},
      {{ReasonCode::leaves_last_waypoint, {}}, "the arm leaves the last waypoint"},
      {{ReasonCode::waypoint_not_reached, with(off, {{segment_name, "waypoint 4"}})},
       "waypoint 4 is not reached; at the end the tool is " + by_both + " from it"},
      {{ReasonCode::passes_without_rest, {{segment_name, "move 1 (joint)"}}},
       "the arm passes the waypoint of move 1 (joint), where it has to be at rest"},
      {{ReasonCode::dwell_too_short,
        {{segment_name, "move 1 (line)"}, {duration, 0.5}, {dwell, 2.0}, {beyond_dwells, true}}},
       "the arm is at rest for 0.5 s at the waypoint of move 1 (line), 1.5 s less than the dwell "
       "of "
       "2 s, beyond the dwells before"},
      {{ReasonCode::tool_too_fast, {{segment_name, "move 1 (line)"}, {speed, 0.3}, {limit, 0.25}}},
       "on move 1 (line) the tool's speed is up to 0.3 m/s, above 0.25 m/s"},
  };
}

}  // namespace beeline::testing
