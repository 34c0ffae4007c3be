#include <tests/reason/said.h>

namespace beeline::testing {

std::vector<Said> said_of_paths() {
  using enum ReasonField;
  const Fields passes = with(of_joint, {{is_upper, true}, {limit, 1.0}});
  const Reason unreachable{ReasonCode::position_unreachable,
                           {{distance, 0.1},
                            {arm, "ur5"},
                            {refined, false},
                            {nearest, Eigen::Vector3d(1, 2, 3)},
                            {fraction, 1.0},
                            {position, Eigen::Vector3d(0.4, 0.5, 0.6)}}};
  const std::string at_end =
      "at its end, at x 0.4, y 0.5, z 0.6 m, the position is out of reach by 0.1 m: the tool of "
      "arm "
      "ur5 was found to come as near as (1, 2, 3)";
  return {
      {{ReasonCode::would_pass_limits,
        with(stop, passes),
        {{ReasonCode::would_pass_limits, passes}}},
       stops + "joint j2 would have to pass its upper limit of 1 rad (57.2958 deg), and joint j2 "
               "would have to pass its upper limit of 1 rad (57.2958 deg)"},
      {{ReasonCode::step_not_proved, stop},
       stops + "no step is proved to keep the tolerance; allow a larger one"},
      {{ReasonCode::singular_at_start, with(stop, with(of_joint, {{value, 0.0}}))},
       stops + "the arm is singular at this start, with joint j2 at 0 rad (0 deg), so the tool can "
               "leave it in this direction only with a jump of the joints; with another value of "
               "this joint it is not singular"},
      {{ReasonCode::singular_on_path, stop},
       stops + "the arm is singular there; it could continue only by jumping to another branch, "
               "such as another elbow"},
      {{ReasonCode::pose_outside_limits, stop, {unreachable}}, stops + at_end},
      {{ReasonCode::path_leaves_workspace, with(stop, {{search_limited, true}}), {unreachable}},
       stops + "the path leaves the arm's workspace; " + at_end +
           "; a larger tolerance does not help; the search for paths near it ended at its limit of "
           "work"},
      {{ReasonCode::path_loses_orientation, stop, {unreachable}},
       stops + "the arm cannot keep the path's orientation; " + at_end +
           "; a larger tolerance does not help, a task that leaves rotations free may"},
      {{ReasonCode::ended_at_pose, stop, {{ReasonCode::ended_before_best_solution, late}}},
       stops + "the time limit ended the search before the best solution was known; the one given "
               "is the best so far; allow more time"},
      {{ReasonCode::no_configuration_found, with(stop, {{near_singular, true}}), {unreachable}},
       stops +
           "no configuration was found to continue with, and the arm is singular there, as at "
           "the edge of its workspace; " +
           at_end},
      {{ReasonCode::too_many_samples,
        {{segment_name, "line 2 of 3"}, {max_samples, std::size_t{200}}}},
       "line 2 of 3 needs more than 200 samples in all; allow a larger tolerance or more samples"},
      {{ReasonCode::path_not_proved, with(off, {{move_name, "moves 1 to 2"},
                                                {proof_rate, 100.0},
                                                {proved_rate, 500.0},
                                                {proved_speed, 0.5}})},
       "moves 1 to 2: at 100 samples per second the tool is only proved to stay within " + by_both +
           " of its path; allow a larger tolerance, or a rate of 500, or 0.5 times the speed"},
      {{ReasonCode::program_too_long,
        {{move_name, "move 3 (line)"}, {max_samples, std::size_t{10'000'000}}}},
       "move 3 (line): the motion up to here needs more than 10000000 samples; lower the rate"},
  };
}

std::vector<Said> said_near_singularities() {
  using enum ReasonField;
  const std::string near =
      "; the arm passes near a singularity, where another tolerance rarely helps: begin in another "
      "configuration, move the path away from it, or use a task that leaves rotations free";
  return {
      {{ReasonCode::path_not_proved, with(off, {{near_singular, true}, {proved_rate, 500.0}})},
       "the tool is only proved to stay within " + by_both + " of its path" + near +
           ", or a rate of 500"},
      {{ReasonCode::step_not_proved, {{near_singular, true}}},
       "no step is proved to keep the tolerance" + near},
      {{ReasonCode::spline_outside_limits, with(outside, {{planned, true}, {near_singular, true}})},
       "between two samples the spline through them leaves the limits: " + is_outside + near},
  };
}

}  // namespace beeline::testing
