#include <tests/reason/said.h>

namespace beeline::testing {

namespace {

/// Poses with more conditions than the arm has joints.
std::vector<Said> with_said_of_few_joints(std::vector<Said> all) {
  using enum ReasonField;
  const std::string chance =
      " joints meet the 6 conditions of a pose only by chance: ask for fewer, by the task ";
  all.push_back({{ReasonCode::no_solution_found,
                  with(off, {{joints, std::size_t{4}}, {conditions, std::size_t{6}}})},
                 "no solution was found; the nearest misses by " + by_both +
                     "; a solution may still exist; 4" + chance + "position"});
  all.push_back({{ReasonCode::orientation_unreachable,
                  {{arm, "px150"},
                   {has_position, true},
                   {ReasonField::angle, 0.2},
                   {joints, std::size_t{5}},
                   {conditions, std::size_t{6}}}},
                 "the tool of arm px150 can come to the position, but not with that orientation: "
                 "the nearest that was found is off by 0.2 rad (11.4592 deg); 5" +
                     chance + "direction, approach:xy or position"});
  return all;
}

}  // namespace

std::vector<Said> said_of_inverse_kinematics() {
  using enum ReasonField;
  const Fields beyond =
      with(of_joint, {{value, 2.0}, {excess, 1.0}, {is_upper, true}, {limit, 1.0}});
  const std::string nearest_one =
      "; in the nearest one joint j2 would be at 2 rad (114.592 deg), 1 rad (57.2958 deg) above "
      "its upper limit 1 rad (57.2958 deg)";
  const Fields ur5{{arm, "ur5"}};
  const Eigen::Vector3d nearest_point(0.5, 1e-12, 0.25);
  const Fields along{{direction, "wx 1"}, {frame, "base"}};
  const std::string damping =
      " along wx 1 (base frame), a part of the velocity; damping gives rates of a velocity near it";
  return with_said_of_few_joints({
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
        with(ur5, {{distance, 0.1}, {refined, true}, {nearest, nearest_point}})},
       "the position is out of reach by 0.1 m: the tool of arm ur5 comes no nearer than (0.5, 0, "
       "0.25)"},
      {{ReasonCode::orientation_unreachable,
        with(ur5,
             {{has_position, true}, {ReasonField::angle, 0.2}, {within_pose_tolerance, true}})},
       "the tool of arm ur5 can come to the position, but not with that orientation: the nearest "
       "that was found is off by 0.2 rad (11.4592 deg); nor was one found within the pose "
       "tolerance"},
      {{ReasonCode::tilted_off_axes, with(ur5, {{ReasonField::angle, 0.2}})},
       "the pose is tilted by 0.2 rad (11.4592 deg) against every orientation of the tool: all "
       "joint axes of arm ur5 have one direction, about which alone it rotates"},
      {{ReasonCode::off_plane, with(ur5, {{distance, 0.1}})},
       "the pose is 0.1 m off the plane that the tool of arm ur5 never leaves: all axes are normal "
       "to it, and no joint moves along them"},
      {{ReasonCode::fixed_orientation, with(ur5, {{ReasonField::angle, 0.2}})},
       "the orientation differs by 0.2 rad (11.4592 deg) from the tool's, which no joint of arm "
       "ur5 rotates"},
      {{ReasonCode::off_slides, with(ur5, {{distance, 0.1}, {in_millimetres, true}})},
       "the position is 0.1 m from the nearest that the prismatic joints of arm ur5 reach, limits "
       "ignored; positions are in metres, and these numbers are probably in millimetres"},
      {{ReasonCode::poses_unsolved, {{count, std::size_t{2}}, {of, std::size_t{7}}}},
       "2 of 7 poses without a solution: their rows are nan"},
      {{ReasonCode::self_motion, with(ur5, {{branches_complete, true}})},
       "singular: arm ur5 can move with the tool at rest, so there are infinitely many solutions; "
       "the solution nearest to the seed is given for each branch"},
      {{ReasonCode::singular_velocity, along},
       "the arm is singular: no joint rates move its tool" + damping},
      {{ReasonCode::too_few_joints, along}, "no joints of the arm move its tool" + damping},
  });
}

}  // namespace beeline::testing
