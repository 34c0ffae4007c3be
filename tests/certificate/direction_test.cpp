#include <beeline/certificate/verify.h>

#include <tests/planning/motion_promises.h>

/// The direction of motion on a line, compared with a dense evaluation.
namespace beeline {
namespace {

using namespace testing;

/// A motion along one line with samples at a rate, whose joints have no limits that matter.
struct LineMotion {
  Arm arm;
  Pose from, to;
  Trajectory trajectory;
};

Arm without_limits(const Arm& given) {
  constexpr double enough = 1e9;
  std::vector<Joint> joints = given.joints();
  for (Joint& joint : joints) {
    joint.limits.velocity = joint.limits.acceleration = joint.limits.jerk = enough;
  }
  return {given.name(), joints, given.tool(), given.base()};
}

std::optional<LineMotion> random_motion(Random& random, const std::string& name) {
  const Arm arm = built_in(name);
  const Configuration start = inner_configuration(random, arm);
  const Pose from = forward_kinematics(arm, start), to = nearby_pose(random, arm, from);
  const PathMotion motion =
      move_in_lines(arm, start, std::vector{to}, {.tolerance = 1e-6, .rate = 100});
  if (!motion || motion.trajectory.size() < 20) return {};
  return LineMotion{without_limits(arm), from, to, motion.trajectory};
}

/// By how much the tool falls behind its largest earlier projection on the line, metres.
double retreat(const LineMotion& motion) {
  constexpr int parts = 200;
  const Vector3 direction = (motion.to.translation() - motion.from.translation()).normalized();
  double furthest = 0, most = 0;
  for (std::size_t k = 0; k + 1 < motion.trajectory.size(); ++k) {
    for (int i = 0; i <= parts; ++i) {
      const Configuration q = motion_between(motion.trajectory, k, double(i) / parts);
      const Vector3 moved =
          forward_kinematics(motion.arm, q).translation() - motion.from.translation();
      furthest = std::max(furthest, moved.dot(direction));
      most = std::max(most, furthest - moved.dot(direction));
    }
  }
  return most;
}

/// Whether verify() finds that the tool moves backwards by more than the tolerance, with any
/// deviation across the line allowed.
bool is_refused(const LineMotion& motion, double tolerance) {
  const Verification found = verify(motion.arm, motion.trajectory, std::vector{motion.to},
                                    {.tolerance = tolerance, .orientation_tolerance = 3});
  const bool backwards = found.fault == Fault::backwards;
  EXPECT_EQ(backwards, !found) << found.reason;
  return backwards;
}

// A false velocity at one sample makes the tool move back before it, after it, or on both sides.
TEST(Direction, IsRefusedAsSoonAsTheToolMovesBackByTheTolerance) {
  Random random;
  int tried = 0, moved_back = 0;
  for (int i = 0; i < cases(120); ++i) {
    for (const char* name : {"rrr", "ur5", "panda", "puma560"}) {
      auto motion = random_motion(random, name);
      if (!motion) continue;
      const auto k = static_cast<std::size_t>(
          random.integer(4, static_cast<int>(motion->trajectory.size()) - 5));
      motion->trajectory.velocities[k] *= -random.uniform(0, 4);
      const double back = retreat(*motion);
      ++tried;
      if (back < 1e-5) continue;  // less than the deviation across the line
      ++moved_back;
      EXPECT_TRUE(is_refused(*motion, 0.999 * back)) << name << " " << back;
      EXPECT_FALSE(is_refused(*motion, 1.25 * back)) << name << " " << back;  // 2 errors above
    }
  }
  EXPECT_GT(4 * moved_back, tried);
}

// The path parameter s(u) between two samples may run ahead of the tool: that is no motion back.
TEST(Direction, OfWhatMovesForwardsPassesAtEveryTolerance) {
  Random random;
  for (int i = 0; i < cases(60); ++i) {
    for (const char* name : {"rrr", "ur5"}) {
      auto motion = random_motion(random, name);
      if (!motion) continue;
      // Few samples: the quintics leave the time scaling of the motion.
      Trajectory sparse{motion->trajectory.joint_names, {}, {}, {}, {}};
      for (std::size_t k = 0; k < motion->trajectory.size(); ++k) {
        if (k % 8 != 0 && k + 1 != motion->trajectory.size()) continue;
        sparse.times.push_back(motion->trajectory.times[k]);
        sparse.positions.push_back(motion->trajectory.positions[k]);
        sparse.velocities.push_back(motion->trajectory.velocities[k]);
        sparse.accelerations.push_back(motion->trajectory.accelerations[k]);
      }
      motion->trajectory = sparse;
      if (retreat(*motion) > 1e-13) continue;
      const Verification whole = verify(motion->arm, sparse, std::vector{motion->to},
                                        {.tolerance = 1, .orientation_tolerance = 3});
      ASSERT_TRUE(whole) << whole.reason;
      const double across = std::max(whole.deviation.bound.position, 1e-10);
      EXPECT_FALSE(is_refused(*motion, 1.01 * across)) << name;
    }
  }
}

}  // namespace
}  // namespace beeline
