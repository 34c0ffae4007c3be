#include <gtest/gtest.h>

#include <beeline/batch/batch.h>
#include <beeline/control/cartesian.h>
#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/kinematics/forward.h>
#include <beeline/planning/move_along.h>
#include <beeline/planning/program.h>
#include <beeline/pose/so3.h>

#include <tests/random.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using testing::Random;

/// A planar arm of revolute and prismatic joints anywhere: turned and lifted in the world.
Arm planar_arm(Random& random) {
  std::vector<Joint> joints;
  const int count = random.integer(2, 4);
  for (int i = 0; i < count; ++i) {
    Joint joint;
    joint.name = "j" + std::to_string(i);
    joint.offset = to_space(Pose2{random.uniform(0.2, 0.6), random.uniform(-0.2, 0.2), 0},
                            random.uniform(-0.1, 0.1));
    joint.screw = rotation_screw(Vector3::UnitZ());
    joint.limits = {.lower = -2, .upper = 2};
    joints.push_back(joint);
  }
  const Pose tool = to_space(Pose2{0.3, 0, random.uniform(-1, 1)}, random.uniform(-0.2, 0.2));
  const Pose base =
      to_space(Pose2{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-3, 3)},
               random.uniform(-2, 2));
  return {"planar", joints, tool, base};
}

/// A pose outside the plane: lifted, tilted, or both.
Pose moved_out(Random& random, Pose pose) {
  const int kind = random.integer(0, 2);
  const double sign = random.integer(0, 1) == 0 ? -1 : 1;
  if (kind != 0) pose.translation().z() += sign * random.uniform(1e-5, 0.3);
  if (kind != 1) pose.linear() *= so3_exp(Vector3(sign * random.uniform(1e-5, 1.5), 0, 0));
  return pose;
}

/// The tool's pose after a small motion of the joints.
Pose beside(Random& random, const Arm& arm, const Configuration& q) {
  Configuration moved = q;
  for (double& value : moved) value += random.uniform(-0.1, 0.1);
  return forward_kinematics(arm, moved);
}

TEST(OutsideThePlane, IsRefusedUnlessATaskIsGiven) {
  Random random;
  for (int i = 0; i < testing::cases(120); ++i) {
    const Arm arm = planar_arm(random);
    ASSERT_TRUE(arm.planar());
    const Configuration q = 0.5 * random.configuration(arm);
    const Pose inside = forward_kinematics(arm, q), outside = moved_out(random, inside);
    const std::optional<Task> planar = Task::planar();
    EXPECT_NO_THROW(check_in_plane(arm, inside));
    EXPECT_NO_THROW(inverse_kinematics(arm, inside));
    EXPECT_REFUSED(inverse_kinematics(arm, outside), "the pose is outside the plane z = ");
    EXPECT_REFUSED(inverse_kinematics(arm, outside), "or task planar to ignore height and tilt");
    Eigen::MatrixXd columns(arm.dof(), 1);
    EXPECT_REFUSED(inverse_kinematics(arm, outside, {.seed = q}), "outside the plane");
    EXPECT_REFUSED(inverse_kinematics(arm, outside, q, columns), "outside the plane");
    EXPECT_TRUE(inverse_kinematics(arm, outside, {.seed = q, .task = planar}));
    try {
      inverse_kinematics(arm, outside);
    } catch (const Error& error) {
      EXPECT_EQ(error.argument(), "task");
      EXPECT_NE(error.message_for("--task").find("or --task planar to ignore"), std::string::npos);
    }
  }
}

TEST(OutsideThePlane, ARowOfABatchIsNamed) {
  Random random;
  const Arm arm = planar_arm(random);
  Eigen::MatrixXd poses(16, 5), q(arm.dof(), 5);
  for (int i = 0; i < 5; ++i) {
    const Pose pose = forward_kinematics(arm, random.configuration(arm));
    poses.col(i) = (i == 3 ? moved_out(random, pose) : pose).matrix().reshaped();
  }
  const Eigen::MatrixXd seeds = middle_configuration(arm);
  EXPECT_REFUSED(batch_inverse(arm, poses, seeds, q), "pose 4 of 5: the pose is outside the plane");
  EXPECT_NO_THROW(batch_inverse(arm, poses, seeds, q, {.task = Task::planar()}));
  poses(14, 3) = std::numeric_limits<double>::quiet_NaN();  // has no solution
  EXPECT_NO_THROW(batch_inverse(arm, poses, seeds, q));
}

TEST(OutsideThePlane, WaypointsAreRefusedByMotionsAndTheirProofs) {
  Random random;
  int reached = 0;
  for (int i = 0; i < testing::cases(30); ++i) {
    const Arm arm = planar_arm(random);
    const Configuration q = 0.5 * random.configuration(arm);
    const Pose inside = beside(random, arm, q), outside = moved_out(random, inside);
    const Task position{{true, true, false, false, false, false}};
    EXPECT_REFUSED(move_in_lines(arm, q, {inside, outside}), "waypoint 2 is outside the plane");
    EXPECT_REFUSED(control_in_lines(arm, q, std::vector{outside}), "a waypoint is outside");
    EXPECT_REFUSED(move_program(arm, q, {{{.target = inside}, {.target = outside}}}),
                   "move 2 (line): the waypoint is outside the plane");
    const PathMotion motion = move_in_lines(arm, q, {outside}, {.task = position});
    if (!motion) continue;
    ++reached;
    EXPECT_REFUSED(verify(arm, motion.trajectory, {outside}), "waypoint 1 is outside the plane");
    EXPECT_TRUE(verify(arm, motion.trajectory, {outside}, {.task = position}));
    EXPECT_NO_THROW(verify(arm, motion.trajectory, {inside}));
  }
  EXPECT_GT(reached, 0);
}

TEST(OutsideThePlane, AnArcMayLeaveItBetweenItsEnds) {
  Random random;
  const Arm arm = planar_arm(random);
  const Configuration q = 0.5 * random.configuration(arm);
  const Pose from = forward_kinematics(arm, q), to = beside(random, arm, q);
  const Vector3 above = (from.translation() + to.translation()) / 2 + Vector3(0, 0, 0.2);
  const ToolPath path{.segments = {arc_through(from, above, to)}, .spans = {1}};
  const Route route{.path = path, .stops = {true}};
  EXPECT_REFUSED(move_along(arm, q, route), "segment 1 is outside the plane");
  const Program program{{{.kind = MoveKind::arc, .target = to, .via = above}}};
  EXPECT_REFUSED(move_program(arm, q, program), "the via position is outside the plane");
}

TEST(RefusedMotion, HasNoBoundOfItsDeviation) {
  Random random;
  for (int i = 0; i < testing::cases(30); ++i) {
    const Arm arm = planar_arm(random);
    const Configuration q = 0.5 * random.configuration(arm);
    Pose far = forward_kinematics(arm, q);
    far.translation().x() += 20;
    const PathMotion motion = move_in_lines(arm, q, {far});
    const ProgramMotion program = move_program(arm, q, {{{.target = far}}});
    ASSERT_FALSE(motion || program);
    for (const Deviation& bound : {motion.deviation.bound, program.deviation.bound}) {
      EXPECT_TRUE(std::isinf(bound.position) && std::isinf(bound.orientation));
    }
    EXPECT_EQ(program.limit_margin, 0);
    EXPECT_EQ(program.inverse_condition, 0);
    const PathMotion possible = move_in_lines(arm, q, {beside(random, arm, q)});
    if (!possible) continue;
    const Verification failed = verify(arm, possible.trajectory, {far});
    ASSERT_NE(failed.fault, Fault::none);
    EXPECT_TRUE(std::isinf(failed.deviation.bound.position));
    EXPECT_LE(possible.deviation.bound.position, 1e-4);
  }
}

}  // namespace
}  // namespace beeline
