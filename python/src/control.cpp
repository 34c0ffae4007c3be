#include "bindings.h"
#include "collision_fields.h"
#include "control_fields.h"
#include "interruption.h"
#include "plane_poses.h"

namespace beeline::python {
namespace {

Configuration configuration_from(nb::handle value, const char* name) {
  return Value<Configuration>::from(value, name);
}

void bind_joint_control(nb::module_& m) {
  Signature joints(
      "control_joints", "ControlledMotion",
      "Simulates joint-space motion control from `start` to `goal` (Dellaert, *Serial Link "
      "Manipulators*, eq. 1.3). With kp alone the motion is a straight line in joint space, which "
      "is a curve of the tool. Joint values are plain numbers; angles are not wrapped. A goal "
      "outside the limits has the status `outside_limits`.");
  joints.takes_arm()
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
  Signature moved("move_joints", "ControlledMotion", comment("move_joints"));
  moved.takes_arm()
      .takes("start", array_like, "Configuration (n,).")
      .takes("goal", array_like, "Configuration (n,).")
      .options<JointMoveOptions>();
  define_on_arm(
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
  Signature lines("control_in_lines", "ControlledMotion", comment("control_in_lines"));
  lines.takes_arm()
      .takes("start", array_like, "Configuration (n,) within the limits.")
      .takes("waypoints", arm_poses_like, arm_poses_doc)
      .options<CartesianOptions>()
      .options<SimulationOptions>();
  define(
      m,
      [](const Arm& arm, nb::handle start, nb::handle waypoints, const nb::kwargs& keywords) {
        const Configuration from = configuration_from(start, "start");
        const std::vector<Pose> poses = PosePlane(arm).poses(waypoints, "waypoints");
        check_options_of(arm, keywords);
        auto given = options<CartesianOptions, SimulationOptions>(keywords);
        CartesianOptions asked = std::get<0>(given);
        asked.simulation = std::get<1>(given);
        return unlocked(asked.simulation.budget,
                        [&] { return control_in_lines(arm, from, poses, asked); });
      },
      lines, nb::arg("arm"), nb::arg("start"), nb::arg("waypoints"), nb::arg("keywords"));
}

void bind_overshoot(nb::module_& m) {
  Signature over("joint_overshoot", "float", comment("joint_overshoot"));
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
  bind_record<StartJump>(m);
  bind_record<ControlledMotion>(m);
  bind_joint_control(m);
  bind_joint_moves(m);
  bind_cartesian_control(m);
  bind_overshoot(m);
  bind_record<SpeedChange>(m);
  bind_record<Replay>(m);
  Signature replayed("replay", "Replay", comment("replay"));
  replayed.summary_has_motions()
      .takes_arm()
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
