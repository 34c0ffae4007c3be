#include <tests/reason/said.h>

namespace beeline::testing {

std::vector<Said> said_of_control() {
  using enum ReasonField;
  const Fields uses = with({{time, 0.5}}, with(of_joint, {{quantity, "velocity"}, {use, 1.25}}));
  const std::string exceeds = "at 0.5 s joint j2 uses 1.25 times its velocity limit";
  return {
      {{ReasonCode::joint_outside_limits, outside}, is_outside},
      {{ReasonCode::goal_outside_limits, with(outside, {{in_degrees, true}})},
       "the goal is outside the limits: " + is_outside +
           "; angles are in radians, and this one is probably in degrees"},
      {{ReasonCode::start_outside_limits, outside}, "the start: " + is_outside},
      {{ReasonCode::step_outside_limits,
        with(outside, {{step, std::size_t{3}}, {overshoots, true}})},
       "step 3 would leave the limits: " + is_outside +
           "; the controller overshoots: the gains are too large"},
      {{ReasonCode::recording_outside_limits, with(outside, {{time, 0.5}})},
       "at 0.5 s " + is_outside},
      {{ReasonCode::recording_outside_limits_between, with(outside, {{time, 0.5}})},
       "after 0.5 s " + is_outside + ", by the velocities of the recording"},
      {{ReasonCode::step_not_finite, {}}, "the step of the controller is not finite"},
      {{ReasonCode::not_converged,
        {{line, std::size_t{1}}, {lines, std::size_t{2}}, {step, std::size_t{1}}, {error, 0.5}}},
       "line 1 of 2: after 1 step the error is 0.5: the gain is too small, or allow more steps"},
      {{ReasonCode::stagnates, {{error, 0.5}, {count, std::size_t{1000}}, {at_singularity, true}}},
       "the error has stayed at 0.5 or above for 1000 steps: the arm is stuck; the arm is at a "
       "singularity, where the Jacobian has no motion towards the goal"},
      {{ReasonCode::diverges, {{error, 0.5}, {step, std::size_t{7}}}},
       "the error diverges, to 0.5 after 7 steps: the gain is too large"},
      {{ReasonCode::next_solution_far,
        {{pose, std::size_t{2}}, {poses, std::size_t{9}}, {change, 2.0}}},
       "at intermediate pose 2 of 9: the nearest solution is another branch, 2 rad (114.592 deg) "
       "away; more intermediate poses may help"},
      {{ReasonCode::recording_too_fast,
        {{time, 0.5}, {joint, "j2"}, {use, 1.25}, {kept_speed, 0.8}}},
       "at 0.5 s joint j2 moves at 1.25 times its velocity limit; a speed of 0.8 keeps the limits"},
      {{ReasonCode::limit_exceeded,
        with(uses, {{rate, 50.0}, {kept_speed, 0.8}, {kept_at_rate, true}, {kept_rate, 100.0}})},
       "with 50 samples per second " + exceeds +
           "; a speed of 0.8 at this rate, or a rate of 100 keeps the limits"},
      {{ReasonCode::limit_exceeded,
        with(uses, {{speed, 3.0}, {kept_speed, 0.8}, {speed_changes, true}})},
       exceeds + " at a speed of 3; speeds of at most 0.8 keep the limits"},
      {{ReasonCode::moves_after_lead_in, with(uses, {{none_kept, true}})},
       "after the lead-in, " + exceeds +
           ": the recording does not start at rest; no other rate, ramp or speed was found that "
           "keeps the limits"},
  };
}

}  // namespace beeline::testing
