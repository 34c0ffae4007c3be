#include <gtest/gtest.h>
#include <set>

#include <beeline/control/player.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/planning/move_along.h>
#include <beeline/reason.h>

#include <tests/refusal.h>

namespace beeline {
namespace {

using enum ReasonField;

// Sentences stand here alone: other tests ask for codes and fields, and pass where every sentence
// is "X".

struct Said {
  Reason reason;
  std::string sentence;
};

using Fields = std::vector<std::pair<ReasonField, ReasonValue>>;

Fields with(Fields fields, const Fields& more) {
  fields.insert(fields.end(), more.begin(), more.end());
  return fields;
}

const Fields of_joint{{joint, "j2"}, {unit, "rad"}};
const Fields outside = with(of_joint, {{value, 2.0}, {lower, -1.0}, {upper, 1.0}});
const std::string is_outside =
    "joint j2 at 2 rad (114.592 deg) is outside its limits -1 rad (-57.2958 deg) to 1 rad "
    "(57.2958 deg)";
const Fields late{{ending, Ending::time_limit}};
const Fields off{{distance, 0.1}, {ReasonField::angle, 0.2}};
const std::string by_both = "0.1 m and 0.2 rad (11.4592 deg)";
const Fields stop{{segment, std::size_t{2}},
                  {segment_name, "line 2 of 3"},
                  {is_line, true},
                  {fraction, 0.631},
                  {position, Eigen::Vector3d(0.1, 1e-15, 0.3)}};
const std::string stops = "line 2 of 3 stops after 63.1 % of its length, at x 0.1, y 0, z 0.3 m: ";
const Fields at_sample{{sample, std::size_t{51}}, {time, 0.5}};

std::vector<Said> budgets() {
  const std::string time = "the time limit ended the search", more = "; allow more time";
  return {
      {{ReasonCode::ended, late}, time + more},
      {{ReasonCode::ended, {{ending, Ending::cancelled}}}, "the search was cancelled"},
      {{ReasonCode::ended, {{ending, Ending::work_limit}}},
       "the limit of work ended the search; allow more work"},
      {{ReasonCode::ended_before_solution, with(late, {{distance, 0.1}})},
       time + " before a solution was found; the nearest misses by 0.1 m" + more},
      {{ReasonCode::ended_before_all_solutions, with(late, {{count, std::size_t{3}}})},
       time + " after 3 solution(s); others may exist" + more},
      {{ReasonCode::ended_before_best_solution, late},
       time + " before the best solution was known; the one given is the best so far" + more},
      {{ReasonCode::ended_on_path, late}, time + more},
      {{ReasonCode::ended_on_path, with(late, {{fraction, 1.0}})},
       time + " after it had followed the whole path" + more},
      {{ReasonCode::ended_on_path, with(late, stop)},
       time + " after it had followed line 2 of 3 to 63.1 %" + more},
      {{ReasonCode::ended_before_timing, late},
       time + " after the whole path was planned, before the motion was timed and proved" + more},
      {{ReasonCode::ended_before_check, late},
       time + " before the whole trajectory was checked" + more},
      {{ReasonCode::ended_before_sampling, late}, time + " before the motion was sampled" + more},
      {{ReasonCode::ended_before_samples, late},
       time + " before samples within the limits were found" + more},
      {{ReasonCode::ended_in_simulation, with(late, {{step, std::size_t{7}}, {error, 0.5}})},
       time + " after 7 steps, with an error of 0.5" + more},
      {{ReasonCode::ended_in_retiming, with(late, {{count, std::size_t{1}}, {of, std::size_t{3}}})},
       time + " after 1 of 3 sections between stops" + more},
      {{ReasonCode::ended_in_batch, with(late, {{count, std::size_t{9}}, {without_file, true}})},
       time + " after 9 rows; no file is written" + more},
      {{ReasonCode::ended_in_map, with(late, {{parts, "map.h5.parts"}})},
       time + ": the slabs computed so far are in map.h5.parts; the same command continues, with a "
              "larger limit if it has completed no slab"},
  };
}

std::vector<Said> inverse_kinematics() {
  const Fields beyond =
      with(of_joint, {{value, 2.0}, {excess, 1.0}, {is_upper, true}, {limit, 1.0}});
  const std::string nearest_one =
      "; in the nearest one joint j2 would be at 2 rad (114.592 deg), 1 rad (57.2958 deg) above "
      "its "
      "upper limit 1 rad (57.2958 deg)";
  const Fields ur5{{arm, "ur5"}};
  const Eigen::Vector3d point(0.5, 1e-12, 0.25);
  const Fields along{{direction, "wx 1"}, {frame, "base"}};
  const std::string damping =
      " along wx 1 (base frame), a part of the velocity; damping gives rates of a velocity near it";
  return {
      {{ReasonCode::all_solutions_outside_limits, beyond},
       "every solution is outside the joint limits" + nearest_one},
      {{ReasonCode::solutions_outside_limits, beyond},
       "no solution within the joint limits was found" + nearest_one},
      {{ReasonCode::no_solution_found, with(off, {{starts, std::size_t{65}}})},
       "no solution was found from 65 starts; the nearest misses by " + by_both +
           "; a solution may still exist"},
      {{ReasonCode::no_closed_form_solution, {{ReasonField::angle, 0.2}}},
       "no solution was found by the closed form, though a numerical search finds one; the nearest "
       "misses by 0.2 rad (11.4592 deg); a solution may still exist"},
      {{ReasonCode::position_unreachable,
        with(ur5, {{distance, 0.1}, {refined, true}, {nearest, point}})},
       "the position is out of reach by 0.1 m: the tool of arm ur5 comes no nearer than (0.5, 0, "
       "0.25)"},
      {{ReasonCode::orientation_unreachable,
        with(ur5,
             {{has_position, true}, {ReasonField::angle, 0.2}, {within_pose_tolerance, true}})},
       "the tool of arm ur5 can come to the position, but not with that orientation: the nearest "
       "that was found is off by 0.2 rad (11.4592 deg); nor was one found within pose_tolerance"},
      {{ReasonCode::beyond_reach,
        with(ur5, {{excess, 0.1}, {distance, 1.1}, {centre, point}, {radius, 1.0}})},
       "the pose is 0.1 m beyond the reach of arm ur5: 1.1 m from (0.5, 0, 0.25), which the tool "
       "never leaves by more than 1 m"},
      {{ReasonCode::tilted_off_axes, with(ur5, {{ReasonField::angle, 0.2}})},
       "the pose is tilted by 0.2 rad (11.4592 deg) against every orientation of the tool: all "
       "joint axes of arm ur5 have one direction, about which alone it rotates"},
      {{ReasonCode::off_plane, with(ur5, {{distance, 0.1}})},
       "the pose is 0.1 m off the plane that the tool of arm ur5 never leaves: all axes are normal "
       "to it, and no joint moves along them"},
      {{ReasonCode::fixed_orientation, with(ur5, {{ReasonField::angle, 0.2}})},
       "the orientation differs by 0.2 rad (11.4592 deg) from the tool's, which no joint of arm "
       "ur5 "
       "rotates"},
      {{ReasonCode::off_slides, with(ur5, {{distance, 0.1}})},
       "the position is 0.1 m from the nearest that the prismatic joints of arm ur5 reach, limits "
       "ignored"},
      {{ReasonCode::self_motion, with(ur5, {{branches_complete, true}})},
       "singular: arm ur5 can move with the tool at rest, so there are infinitely many solutions; "
       "the solution nearest to the seed is given for each branch"},
      {{ReasonCode::singular_velocity, along},
       "the arm is singular: no joint rates move its tool" + damping},
      {{ReasonCode::too_few_joints, along}, "no joints of the arm move its tool" + damping},
  };
}

std::vector<Said> paths() {
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
      {{ReasonCode::program_too_long, {{move_name, "move 3 (line)"}, {max_samples, 1e7}}},
       "move 3 (line): the motion up to here needs more than 1e+07 samples; lower the rate"},
  };
}

std::vector<Said> times() {
  return {
      {{ReasonCode::spline_outside_limits, outside},
       "between two samples the spline through them leaves the limits: " + is_outside +
           "; samples closer together would guide it"},
      {{ReasonCode::spline_outside_limits, with(outside, {{planned, true}})},
       "between two samples the spline through them leaves the limits: " + is_outside +
           "; a smaller tolerance takes samples closer together"},
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
        {{rate, 100.0}, {max_samples, 201.0}, {duration, 9.0}, {possible_rate, 20.0}}},
       "100 samples per second make more than 201 in 9 s; a rate of 20 works"},
      {{ReasonCode::no_motion_at_rate, {{rate, 100.0}}},
       "no motion within the limits was found at 100 samples per second"},
      {{ReasonCode::too_many_samples_given,
        {{count, std::size_t{200'001}}, {max_samples, std::size_t{200'000}}}},
       "the trajectory has 200001 samples, more than max_samples, 200000"},
      {{ReasonCode::duration_too_short, {{duration, 1.0}, {shortest_duration, 2.00000049}}},
       "a duration of 1 s is too short: the shortest within the limits is 2.00001 s"},
  };
}

std::vector<Said> trajectories() {
  const std::string at = "at 0.5 s, sample 51: ";
  const Fields above = with(of_joint, {{quantity, "acceleration"}, {value, 2.0}, {limit, 1.0}});
  const Fields near_limit = with(of_joint, {{value, 1.00000001}, {lower, -1.0}, {upper, 1.0}});
  const Fields named = with(at_sample, {{segment_name, "line 1"}});
  const Fields jumps = with(with(at_sample, off), {{is_line, true}, {change, 0.7}});
  return {
      {{ReasonCode::outside_limits, with(at_sample, outside)},
       at + "joint j2 is at 2 rad, outside its limits of -1 to 1 rad"},
      {{ReasonCode::outside_limits, near_limit},
       "joint j2 is at 1 rad, outside its limits of -1 to 1 rad by 1e-08 rad"},
      {{ReasonCode::moves_outside_limits, with(outside, {{interpolation, "cubic"}})},
       "joint j2 moves to 2 rad before the next sample, by the cubic with its velocities: outside "
       "its limits of -1 to 1 rad"},
      {{ReasonCode::rotates_too_far, with(of_joint, {{change, 3.2}})},
       "joint j2 rotates by 3.2 rad to the next sample, 0.509296 revolutions"},
      {{ReasonCode::derivative_needed, above},
       "joint j2 needs 2 rad/s^2 over the next samples; its limit is 1 rad/s^2"},
      {{ReasonCode::derivative_reached, with(above, {{assumed, true}})},
       "joint j2 reaches 2 rad/s^2 before the next sample; its limit is not known, 1 rad/s^2 is "
       "assumed (--limits or --acceleration gives it)"},
      {{ReasonCode::starts_moving, with(of_joint, {{value, 0.1}})},
       "joint j2 starts at 0.1 rad/s, not at rest"},
      {{ReasonCode::ends_moving, with(of_joint, {{value, 0.1}})},
       "joint j2 ends at 0.1 rad/s, not at rest"},
      {{ReasonCode::off_path, with(named, off)}, at + "the tool is off line 1 by " + by_both},
      {{ReasonCode::moves_backwards, with(named, off)},
       at + "the tool moves backwards on line 1 by " + by_both},
      {{ReasonCode::may_move_backwards, with(named, off)},
       at + "up to the next sample the tool moves backwards on line 1 by up to " + by_both},
      {{ReasonCode::deviation_unproved, jumps},
       at + "up to the next sample the tool is only proved to stay within " + by_both +
           " of the line; a joint moves by 0.7, as at a change of branch"},
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

std::vector<Said> controllers() {
  const Fields uses = with({{time, 0.5}}, with(of_joint, {{quantity, "velocity"}, {use, 1.25}}));
  const std::string exceeds = "at 0.5 s joint j2 uses 1.25 times its velocity limit";
  return {
      {{ReasonCode::joint_outside_limits, outside}, is_outside},
      {{ReasonCode::goal_outside_limits, outside}, "the goal is outside the limits: " + is_outside},
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

std::vector<Said> mounts() {
  return {
      {{ReasonCode::poses_too_far_apart, {}}, "the poses are farther apart than the arm reaches"},
      {{ReasonCode::no_mount_reaches, {{count, std::size_t{5}}, {of, std::size_t{9}}}},
       "the arm reaches all poses from none of the 5 mounts that the map ranks first"},
      {{ReasonCode::no_mount_moves_in_lines, {{count, std::size_t{1}}, {of, std::size_t{1}}}},
       "the arm reaches all poses from 1 mount, but moves in straight lines from none of the 1 "
       "best"},
  };
}

TEST(Sentence, SaysWhatAReasonMeans) {
  std::set<ReasonCode> seen{ReasonCode::none};
  for (const auto& group : {budgets(), inverse_kinematics(), paths(), times(), trajectories(),
                            controllers(), mounts()}) {
    for (const Said& said : group) {
      EXPECT_EQ(sentence(said.reason), said.sentence) << name(said.reason.code);
      seen.insert(said.reason.code);
    }
  }
  for (int code = 0; code <= static_cast<int>(ReasonCode::no_mount_moves_in_lines); ++code) {
    const auto unseen = static_cast<ReasonCode>(code);
    EXPECT_TRUE(seen.contains(unseen)) << name(unseen);
    EXPECT_EQ(reason_code_named(name(unseen)), unseen);
  }
}

// A reason that a program made may lack what its sentence needs.
TEST(Sentence, RefusesAReasonThatLacksAFieldOrADetail) {
  for (int number = 1; number <= static_cast<int>(ReasonCode::no_mount_moves_in_lines); ++number) {
    const auto code = static_cast<ReasonCode>(number);
    for (const Fields& fields : {Fields(), stop}) {
      try {
        EXPECT_NE(sentence({code, fields}), "") << name(code);
      } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find(name(code)), std::string::npos) << error.what();
      }
    }
  }
  for (const ReasonCode code :
       {ReasonCode::ended_at_pose, ReasonCode::pose_outside_limits,
        ReasonCode::path_leaves_workspace, ReasonCode::path_loses_orientation,
        ReasonCode::no_configuration_found}) {
    EXPECT_REFUSED(sentence({code}), name(code) + " needs details");
  }
  EXPECT_THROW(name(static_cast<ReasonCode>(100'000)), std::out_of_range);
}

// A refusal quotes the reason.
TEST(Sentence, StandsInTheErrorOfALimit) {
  const Arm arm = built_in("panda");
  const Configuration q = Configuration::Zero(7);  // joint4 is below 0
  EXPECT_REFUSED(move_in_lines(arm, q, {forward_kinematics(arm, q)}),
                 "the motion cannot start: joint joint4 at 0 rad");
  EXPECT_REFUSED(Player(arm, at_rest(arm, q), middle_configuration(arm)), "at 0 s joint joint4");
}

TEST(Reason, HasAFieldOnce) {
  Reason reason{ReasonCode::ended, {{ending, Ending::cancelled}}};
  reason.set(ending, Ending::time_limit).set(count, std::size_t{2});
  EXPECT_EQ(reason.fields.size(), 2);
  EXPECT_EQ(std::get<Ending>(*reason.find(ending)), Ending::time_limit);
  EXPECT_FALSE(reason.has(arm));
  EXPECT_TRUE(reason && !Reason());
  EXPECT_EQ(sentence(Reason()), "");
  EXPECT_EQ(reason_field_named("move_name"), move_name);
  EXPECT_REFUSED(reason_field_named("speedy"), "speed");
}

}  // namespace
}  // namespace beeline
