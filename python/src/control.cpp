#include "bindings.h"
#include "control_fields.h"
#include "interruption.h"
#include "plane_poses.h"

namespace beeline::python {
namespace {

Configuration configuration_from(nb::handle value, const char* name) {
  return Value<Configuration>::from(value, name);
}

void bind_joint_control(nb::module_& m) {
  Signature joints("control_joints", "ControlledMotion",
                   "Simulates joint-space motion control from `start` to `goal` (Dellaert, *Serial "
                   "Link Manipulators*, eq. 1.3). With kp alone the motion is a straight line in "
                   "joint space, which is a curve of the tool. Joint values are plain numbers; "
                   "angles are not wrapped. A goal outside the limits has the status "
                   "`outside_limits`.");
  joints.takes("arm", "Arm", "The arm.")
      .takes("start", array_like, "Configuration (n,) within the limits.")
      .takes("goal", array_like, "Configuration (n,).")
      .options<PidGains>()
      .options<SimulationOptions>();
  define(
      m,
      [](const Arm& arm, nb::handle start, nb::handle goal, const nb::kwargs& keywords) {
        const Configuration from = configuration_from(start, "start");
        const Configuration to = configuration_from(goal, "goal");
        auto [gains, simulation] = options<PidGains, SimulationOptions>(keywords);
        const PidGains& pid = gains;
        SimulationOptions& asked = simulation;
        return unlocked(asked.budget, [&] { return control_joints(arm, from, to, pid, asked); });
      },
      joints, nb::arg("arm"), nb::arg("start"), nb::arg("goal"), nb::arg("keywords"));
}

void bind_joint_moves(nb::module_& m) {
  Signature moved("move_joints", "ControlledMotion",
                  "Moves the joints from rest at `start` to rest at `goal` in minimum time under "
                  "the limits of velocity, acceleration and jerk, or in `duration`: a joint "
                  "trajectory in one call. The start may be outside the position limits by up to "
                  "0.1 rad or 0.01 m: the motion leads back in. A goal outside the limits, and a "
                  "duration that is too short, have the status `outside_limits`.");
  moved.takes("arm", "Arm", "The arm.")
      .takes("start", array_like, "Configuration (n,).")
      .takes("goal", array_like, "Configuration (n,).")
      .options<JointMoveOptions>();
  define(
      m,
      [](const Arm& arm, nb::handle start, nb::handle goal, const nb::kwargs& keywords) {
        const Configuration from = configuration_from(start, "start");
        const Configuration to = configuration_from(goal, "goal");
        auto asked = options<JointMoveOptions>(keywords);
        return unlocked(asked.budget, [&] { return move_joints(arm, from, to, asked); });
      },
      moved, nb::arg("arm"), nb::arg("start"), nb::arg("goal"), nb::arg("keywords"));
}

void bind_cartesian_control(nb::module_& m) {
  Signature lines(
      "control_in_lines", "ControlledMotion",
      "Simulates Cartesian control (Dellaert, *Serial Link Manipulators*, section 1.8): "
      "moves the tool towards each waypoint in turn by feedback. The tool's path is "
      "straight only approximately; move_in_lines() is the motion with a proved bound.");
  lines.takes("arm", "Arm", "The arm.")
      .takes("start", array_like, "Configuration (n,) within the limits.")
      .takes("waypoints", arm_poses_like, arm_poses_doc)
      .options<CartesianOptions>()
      .options<SimulationOptions>();
  define(
      m,
      [](const Arm& arm, nb::handle start, nb::handle waypoints, const nb::kwargs& keywords) {
        const Configuration from = configuration_from(start, "start");
        const std::vector<Pose> poses = PosePlane(arm).poses(waypoints, "waypoints");
        auto given = options<CartesianOptions, SimulationOptions>(keywords);
        CartesianOptions asked = std::get<0>(given);
        asked.simulation = std::get<1>(given);
        return unlocked(asked.simulation.budget,
                        [&] { return control_in_lines(arm, from, poses, asked); });
      },
      lines, nb::arg("arm"), nb::arg("start"), nb::arg("waypoints"), nb::arg("keywords"));
}

void bind_overshoot(nb::module_& m) {
  Signature over("joint_overshoot", "float",
                 "Returns the largest distance of any joint beyond the goal, relative to its "
                 "distance from the first sample to the goal; 0 when no joint overshoots.");
  over.takes("samples", array_like, "Configurations (N, n).")
      .takes("goal", array_like, "Configuration (n,).");
  define(
      m,
      [](nb::handle samples, nb::handle goal) {
        const auto rows = Value<std::vector<Configuration>>::from(samples, "samples");
        const Configuration to = configuration_from(goal, "goal");
        if (!rows.empty() && rows[0].size() != to.size()) {
          throw Error("goal has " + std::to_string(to.size()) + " values; the samples have " +
                      std::to_string(rows[0].size()));
        }
        return rows.empty() ? 0.0 : joint_overshoot(rows, to);
      },
      over, nb::arg("samples"), nb::arg("goal"));
}

}  // namespace

void bind_control(nb::module_& m) {
  bind_record<ControlledMotion>(m);
  bind_joint_control(m);
  bind_joint_moves(m);
  bind_cartesian_control(m);
  bind_overshoot(m);
  bind_record<SpeedChange>(m);
  bind_record<Replay>(m);
  Signature replayed("replay", "Replay",
                     "Replays a recording on the arm, at another speed or rate, with a motion that "
                     "leads to its first sample. Stops of the recording remain, each a sample; "
                     "where polynomials through the samples would exceed limits that the recording "
                     "keeps, it is slowed down, to half the speed at most. The status is "
                     "`outside_limits` when the recording leaves the position limits or is too "
                     "fast at this speed. Raises Error for a recording that does not fit the arm.");
  replayed.summary_has_motions()
      .takes("arm", "Arm", "The arm.")
      .takes("recording", "Trajectory", "Its joints are matched by name.")
      .options<ReplayOptions>();
  define(
      m,
      [](const Arm& arm, const Trajectory& recording, const nb::kwargs& keywords) {
        auto asked = options<ReplayOptions>(keywords);
        return unlocked(asked.budget, [&] { return replay(arm, recording, asked); });
      },
      replayed, nb::arg("arm"), nb::arg("recording"), nb::arg("keywords"));
}

}  // namespace beeline::python
