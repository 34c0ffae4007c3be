#include <beeline/certificate/verify.h>
#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/kinematics/jacobian.h>
#include <beeline/math/minimum_norm.h>

#include <tests/planning/motion_promises.h>
#include <tests/reason.h>

namespace beeline {
namespace {

using namespace testing;

struct Made {
  Arm arm;
  std::vector<Pose> poses;
  Trajectory trajectory;
};

/// Two lines of an arm, as `line` makes them.
Made made(const std::string& name, const PathMotionOptions& options = {}) {
  const Arm arm = built_in(name);
  Configuration q = Configuration::Zero(arm.dof());
  const std::vector<double> six = name == "puma560"
                                      ? std::vector<double>{0.2, -0.6, 0.3, 0.4, 0.7, 0}
                                      : std::vector<double>{0.2, -1.2, 1.5, -0.5, 1.2, 0};
  const std::vector<double> seven{0, 0.3, 0, -1.6, 0, 1.2, 0.785};
  const std::vector<double>& from = arm.dof() == 7 ? seven : six;
  for (int k = 0; k < arm.dof(); ++k) q[k] = from[k];
  Pose a = forward_kinematics(arm, q), b = a, c = a;
  b.translation() += Vector3(0.05, 0.1, -0.08);
  b.linear() = so3_exp(Vector3(0.1, -0.2, 0.3)) * a.linear();
  c.translation() += Vector3(-0.06, 0.02, 0.05);
  std::vector<Pose> poses{a, b, c};
  PathMotion motion = move_in_lines(arm, poses, options);
  EXPECT_FALSE(motion.reason);
  return {arm, poses, motion.trajectory};
}

Verification told(const Made& motion) {
  return verify(motion.arm, motion.trajectory, motion.poses);
}

constexpr const char* arms[] = {"puma560", "ur5", "panda", "iiwa14"};

TEST(Verify, PassesWhatLineMakes) {
  for (const std::string name : arms) {
    for (const Profile profile :
         {Profile::fastest, Profile::trapezoidal, Profile::quintic, Profile::s_curve}) {
      const bool jerky = profile == Profile::fastest || profile == Profile::trapezoidal;
      for (const double rate : {0.0, 125.0, 1000.0}) {
        const Verification found = told(made(name, {.profile = profile, .rate = rate}));
        if (name == "panda" && jerky && found.fault == Fault::jerk) continue;  // it has jerk limits
        EXPECT_FALSE(found.reason) << name << ' ' << beeline::name(profile) << ' ' << rate;
        EXPECT_EQ(found.arrivals.size(), 3);
      }
    }
  }
}

TEST(Verify, TellsASampleThatWasMoved) {
  for (const std::string name : arms) {
    Made motion = made(name, {.profile = Profile::quintic});
    const std::size_t k = motion.trajectory.size() / 3;
    Configuration& q = motion.trajectory.positions[k];
    const Jacobian j = jacobian(motion.arm, q);
    const Twist aside = (Twist() << 2e-4 * Vector3(0.1, 0.1, 1).normalized(), 0, 0, 0).finished();
    q += internal::minimum_norm_solution(j, aside).x;
    const Verification found = told(motion);
    EXPECT_NE(found.fault, Fault::none) << name;
    EXPECT_LE(found.sample, k) << name;
    EXPECT_GE(found.sample + 4, k) << name;
  }
}

TEST(Verify, FindsAWholeRevolution) {
  for (const std::string name : arms) {
    Made motion = made(name);
    const std::size_t half = motion.trajectory.size() / 2;
    for (std::size_t k = half; k < motion.trajectory.size(); ++k) {
      double& last = motion.trajectory.positions[k][motion.arm.dof() - 1];
      last += last > 0 ? -2 * pi : 2 * pi;
    }
    const Verification found = told(motion);
    EXPECT_TRUE(found.fault == Fault::flip || found.fault == Fault::limits) << found.reason;
    EXPECT_LE(found.sample, half);
  }
}

TEST(Verify, TellsAChangeOfBranch) {
  for (const std::string name : {"ur5", "puma560"}) {
    Made motion = made(name);
    const std::size_t half = motion.trajectory.size() / 2;
    for (std::size_t k = half; k < motion.trajectory.size(); ++k) {  // the wrist flipped
      Configuration& q = motion.trajectory.positions[k];
      const auto all = inverse_kinematics(motion.arm, forward_kinematics(motion.arm, q),
                                          {.seed = q, .all = true, .ignore_limits = true});
      ASSERT_GT(all.solutions.size(), 1);
      q = all.solutions[1];
    }
    const Verification found = told(motion);
    EXPECT_NE(found.fault, Fault::none);
    EXPECT_EQ(found.sample, half - 1) << found.reason;
  }
}

TEST(Verify, TellsALimitThatIsPassedBetweenSamplesOnly) {
  const Arm rail{"rail", {[] {
                   Joint joint = composite_joint('P', "rail").front();
                   joint.limits = {.lower = 0, .upper = 1};
                   return joint;
                 }()}};
  const auto at = [](double x) { return Configuration::Constant(1, x); };
  Trajectory trajectory = at_rest(rail, at(0.5));
  trajectory.times = {0, 1, 2};
  trajectory.positions = {at(0.5), at(0.95), at(0.96)};
  trajectory.velocities = {at(0), at(0.5), at(0)};
  trajectory.accelerations.clear();
  const std::vector<Pose> end{forward_kinematics(rail, at(0.96))};
  const Verification found = verify(rail, trajectory, end);
  EXPECT_EQ(found.fault, Fault::limits) << found.reason;
  EXPECT_EQ(found.sample, 1);
  trajectory.velocities.clear();
  EXPECT_EQ(verify(rail, trajectory, end).fault, Fault::none) << "joints in proportion stay inside";
}

TEST(Verify, AddsUpBackwardsMotionOverIntervals) {
  const Arm rail{"rail", {composite_joint('P', "rail").front()}};
  const auto at = [](double x) { return Configuration::Constant(1, x); };
  Trajectory trajectory = at_rest(rail, at(0));
  trajectory.times = {0, 1, 2};
  trajectory.positions = {at(0), at(0.1), at(0.2)};
  trajectory.accelerations.clear();
  const std::vector<Pose> end{forward_kinematics(rail, at(0.2))};
  const auto passing_by = [&](double distance) {  // the middle, on both sides of it
    const double velocity = -std::sqrt(12 * 0.1 * distance);
    trajectory.velocities = {at(0), at(velocity), at(0)};
    return verify(rail, trajectory, end, {.tolerance = 1e-4});
  };
  EXPECT_EQ(passing_by(0.4e-4).fault, Fault::none);
  const Verification found = passing_by(0.7e-4);
  EXPECT_EQ(found.fault, Fault::backwards) << found.reason;
  EXPECT_EQ(found.sample, 1);
}

TEST(Verify, FindsAnOmittedWaypoint) {
  Made motion = made("ur5");
  std::swap(motion.poses[1], motion.poses[2]);
  EXPECT_NE(told(motion).fault, Fault::none);
  motion = made("ur5");
  motion.poses.push_back(motion.poses[1]);
  const Verification found = told(motion);
  EXPECT_EQ(found.fault, Fault::not_through);
  EXPECT_EQ(testing::field<std::string>(found.reason, ReasonField::segment_name), "waypoint 4")
      << found.reason;
}

TEST(Verify, TellsHaste) {
  for (const Profile profile : {Profile::fastest, Profile::quintic}) {
    Made motion = made("panda", {.profile = profile});
    for (double& t : motion.trajectory.times) t *= 0.95;
    const Fault fault = told(motion).fault;
    EXPECT_TRUE(fault == Fault::velocity || fault == Fault::acceleration || fault == Fault::jerk)
        << name(fault);
  }
}

// Times of days have few digits for samples a tenth of a millisecond apart.
TEST(Verify, TellsHasteAtAnyTime) {
  const Arm arm = built_in("panda");
  const double jerk = arm.limits(0).jerk;
  for (const double start : {0.0, 1e5, 1e6}) {
    for (const auto& [fraction, fault] :
         {std::pair(0.99, Fault::none), {1.02, Fault::jerk}, {1.9, Fault::jerk}}) {
      Trajectory motion{arm.joint_names(), {}, {}, {}, {}};
      for (int k = 0; k <= 10; ++k) {
        const double t = 1e-4 * k, j = fraction * jerk;
        Configuration q = middle_configuration(arm), v = 0 * q, a = 0 * q;
        q[0] += j * t * t * t / 6, v[0] = j * t * t / 2, a[0] = j * t;
        motion.times.push_back(start + t);
        motion.positions.push_back(q);
        motion.velocities.push_back(v);
        motion.accelerations.push_back(a);
      }
      const Verification found = verify(arm, motion, {.moving = {true, true}});
      EXPECT_EQ(found.fault, fault) << start << ' ' << fraction << ' ' << found.reason;
    }
  }
}

TEST(Verify, RefusesWhatIsNoTrajectory) {
  Made motion = made("ur5");
  Trajectory& trajectory = motion.trajectory;
  const Trajectory good = trajectory;
  trajectory.times[3] = trajectory.times[2];
  EXPECT_REFUSED(told(motion), "time");
  trajectory = good;
  trajectory.joint_names[2] = "elbow";
  EXPECT_REFUSED(told(motion), "elbow");
  trajectory = good;
  trajectory.positions[3][1] = NAN;
  EXPECT_REFUSED(told(motion), "finite");
  trajectory = {good.joint_names, {}, {}, {}, {}};
  EXPECT_REFUSED(told(motion), "no samples");
  trajectory = good;
  for (const double bad : {0.0, -1.0, static_cast<double>(NAN)}) {
    EXPECT_REFUSED(verify(motion.arm, good, motion.poses, {.tolerance = bad}), "tolerance");
  }
  EXPECT_REFUSED(verify(motion.arm, good, std::vector<Pose>{}), "waypoint");
}

// Two samples at one pose, elbow up and elbow down, behind the last waypoint.
TEST(Verify, FindsAJumpAfterTheLastWaypoint) {
  const Arm arm = built_in("rrr");
  const Configuration up{{0.2, 1, 0.3}};
  const Pose pose = forward_kinematics(arm, up);
  const auto both = inverse_kinematics(arm, pose, {.seed = up, .all = true}).solutions;
  ASSERT_GE(both.size(), 2);
  const Trajectory motion{arm.joint_names(), {0, 1, 100}, {up, both[0], both[1]}, {}, {}};
  EXPECT_EQ(verify(arm, motion, std::vector{pose}).fault, Fault::deviation);
}

}  // namespace
}  // namespace beeline
