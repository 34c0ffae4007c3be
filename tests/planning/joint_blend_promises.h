#pragma once

#include <algorithm>
#include <vector>

#include <beeline/planning/program.h>
#include <beeline/trajectory/internal/limit_fraction.h>

#include <tests/planning/motion_promises.h>
#include <tests/random.h>

/// What a program with blends at joint moves must keep, checked from outside.
namespace beeline::testing {

constexpr int dense = 20;  // times in an interval between samples

inline Configuration near_middle(Random& random, const Arm& arm, double part) {
  const Configuration middle = middle_configuration(arm);
  return middle + part * (random.configuration(arm) - middle);
}

/// The pose of the tool at q, moved along x and y of the world.
inline Pose moved_tool(const Arm& arm, const Configuration& q, double x, double y) {
  Pose pose = forward_kinematics(arm, q);
  pose.translation() += Vector3(x, y, 0);
  return pose;
}

inline Program with_stops(Program program) {
  for (Move& move : program.moves) move.blend = 0;
  return program;
}

/// The least distance of a motion from the waypoint of a move between two samples.
inline Deviation least_deviation(const Arm& arm, const Trajectory& motion, const Move& move,
                                 std::size_t first, std::size_t last) {
  const Pose waypoint = move.q ? forward_kinematics(arm, *move.q) : move.target;
  const Task task = default_task(arm);
  Deviation least{1e9, 1e9};
  const auto size = [&](const Deviation& d) {
    return std::max(d.position / move.blend, d.orientation / (5 * move.blend));
  };
  for (std::size_t k = first; k <= last; ++k) {
    constexpr int parts = 500;
    for (int i = 0; i < parts && (k < last || i == 0); ++i) {
      const Configuration q =
          k < last ? motion_between(motion, k, double(i) / parts) : motion.positions[k];
      const Deviation here = task_deviation(task, waypoint, forward_kinematics(arm, q));
      if (size(here) < size(least)) least = here;
    }
  }
  return least;
}

/// The largest fraction of a limit of velocity, acceleration or jerk that the quintics use.
inline double largest_fraction(const Arm& arm, const Trajectory& motion) {
  const auto& [names, t, q, v, a] = motion;
  const std::vector<Limits> limits = internal::motion_limits_of(arm);
  double largest = 0;
  for (std::size_t k = 0; k + 1 < motion.size(); ++k) {
    const double h = t[k + 1] - t[k];
    for (int i = 0; i < arm.dof(); ++i) {
      const double d = q[k + 1][i] - q[k][i], v0 = h * v[k][i], v1 = h * v[k + 1][i];
      const double a0 = h * h * a[k][i], a1 = h * h * a[k + 1][i];
      const double c3 = 10 * d - 6 * v0 - 4 * v1 - 1.5 * a0 + 0.5 * a1;
      const double c4 = -15 * d + 8 * v0 + 7 * v1 + 1.5 * a0 - a1;
      const double c5 = 6 * d - 3 * (v0 + v1) - 0.5 * (a0 - a1);
      const Limits& limit = limits[static_cast<std::size_t>(i)];
      for (int part = 0; part <= dense; ++part) {
        const double u = double(part) / dense;
        const double velocity = (v0 + u * (a0 + u * (3 * c3 + u * (4 * c4 + u * 5 * c5)))) / h;
        const double acceleration = (a0 + u * (6 * c3 + u * (12 * c4 + u * 20 * c5))) / (h * h);
        const double jerk = (6 * c3 + u * (24 * c4 + u * 60 * c5)) / (h * h * h);
        largest = std::max({largest, std::abs(velocity) / limit.velocity,
                            std::abs(acceleration) / limit.acceleration});
        if (arm.limits(i).jerk < Limits::none)
          largest = std::max(largest, std::abs(jerk) / limit.jerk);
      }
    }
  }
  return largest;
}

inline bool blends_with_joint_move(const Program& program, std::size_t i) {
  return program.moves[i].blend > 0 &&
         (program.moves[i].kind == MoveKind::joint || program.moves[i + 1].kind == MoveKind::joint);
}

inline Pose waypoint_of(const Arm& arm, const Move& move) {
  return move.q ? forward_kinematics(arm, *move.q) : move.target;
}

/// Whether the tool is within a blend of the waypoint of a move.
inline bool in_blend(const Arm& arm, const Move& move, const Pose& tool) {
  return within(task_deviation(default_task(arm), waypoint_of(arm, move), tool),
                {move.blend, 5 * move.blend});
}

/// Checks that the tool is on the line of move i, except in blends with joint moves at its ends.
inline void expect_line(const Arm& arm, const Pose& start, const Program& program,
                        const ProgramMotion& motion, std::size_t i) {
  const Move& move = program.moves[i];
  const Move before = i > 0 ? program.moves[i - 1] : Move{.target = start};
  const Line line{waypoint_of(arm, before), move.target};
  if ((line.to.translation() - line.from.translation()).norm() < 1e-9) return;
  const PlannedMove& planned = motion.moves[i];
  std::vector<Pose> tool;
  for (std::size_t k = planned.begin; k < planned.end; ++k) {
    for (int part = 0; part < dense; ++part) {
      tool.push_back(
          forward_kinematics(arm, motion_between(motion.trajectory, k, double(part) / dense)));
    }
  }
  // The interval between samples with the passage of a waypoint belongs to both moves.
  auto first = tool.begin(), last = tool.end();
  const auto in_first = [&](const Pose& pose) { return in_blend(arm, before, pose); };
  const auto in_last = [&](const Pose& pose) { return in_blend(arm, move, pose); };
  if (before.blend > 0) first = std::find_if(first, last, in_first);
  if (move.blend > 0) last = std::find_if(tool.rbegin(), tool.rend(), in_last).base();
  ASSERT_LT(first, last);
  for (; first < last; ++first) {
    if ((before.blend > 0 && in_first(*first)) || (move.blend > 0 && in_last(*first))) continue;
    const Deviation off = off_segment(line, *first);
    ASSERT_LE(off.position, 1e-4) << "at " << double(first - tool.begin()) / dense;
    ASSERT_LE(off.orientation, 1e-4) << "at " << double(first - tool.begin()) / dense;
  }
}

/// Checks the waypoints, lines and limits of a motion at many times.
inline void expect_blended(const Arm& arm, const Pose& start, const Program& program,
                           const ProgramMotion& motion) {
  expect_within_limits(arm, motion.trajectory);
  EXPECT_LE(largest_fraction(arm, motion.trajectory), 1 + 1e-5);
  for (std::size_t i = 0; i < program.moves.size(); ++i) {
    SCOPED_TRACE(move_name(program, i));
    const PlannedMove& planned = motion.moves[i];
    const Move& move = program.moves[i];
    EXPECT_GE(planned.begin, i > 0 ? motion.moves[i - 1].end : 0);
    EXPECT_GE(planned.end, planned.begin);
    EXPECT_EQ(planned.blend == BlendOutcome::none, move.blend == 0);
    const auto is_blend_of_lines = [&](std::size_t k) {
      return program.moves[k].blend > 0 && !blends_with_joint_move(program, k);
    };
    const bool line = move.kind == MoveKind::line && !is_blend_of_lines(i) &&
                      (i == 0 || !is_blend_of_lines(i - 1));
    if (line) expect_line(arm, start, program, motion, i);
    if (!blends_with_joint_move(program, i)) continue;
    EXPECT_EQ(planned.joint_blend_radius > 0, planned.blend != BlendOutcome::stop);
    const std::size_t first = planned.end > 0 ? planned.end - 1 : 0;
    const std::size_t last = std::min(planned.end + 1, motion.trajectory.size() - 1);
    const Deviation least = least_deviation(arm, motion.trajectory, move, first, last);
    EXPECT_LE(least.position, move.blend * (1 + 1e-9));
    EXPECT_LE(least.orientation, 5 * move.blend * (1 + 1e-9));
  }
}

/// Checks that verify() accepts a motion, at the samples that its plan has.
inline void expect_proved(const Arm& arm, const Program& program, const ProgramMotion& motion) {
  const Verification proof = verify(arm, motion.trajectory, program);
  ASSERT_TRUE(proof) << proof;
  for (std::size_t i = 0; i < program.moves.size(); ++i) {
    const bool stops = program.moves[i].blend == 0 || blends_with_joint_move(program, i);
    if (stops) {
      // Samples next to a rest may be as near to the waypoint.
      EXPECT_NEAR(double(proof.arrivals[i]), double(motion.moves[i].end), 1);
    }
  }
}

inline int blend_count(const ProgramMotion& motion) {
  return static_cast<int>(
      std::count_if(motion.moves.begin(), motion.moves.end(),
                    [](const PlannedMove& move) { return move.joint_blend_radius > 0; }));
}

}  // namespace beeline::testing
