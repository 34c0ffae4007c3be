#include <gtest/gtest.h>

#include <beeline/error.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/pose/se3.h>

#include <tests/inverse/answer.h>
#include <tests/random.h>
#include <tests/typical_arms.h>

namespace beeline {
namespace {

using namespace internal;

using testing::largest;

Configuration nearby(const Arm& arm, const Configuration& q, double size, testing::Random& random) {
  Configuration start = q;
  for (int k = 0; k < arm.dof(); ++k) start[k] += random.uniform(-size, size);
  return start;
}

/// A random arm of the given letters (R, P, H), lengths of about `size`.
Arm random_arm(const std::string& letters, double size, testing::Random& random) {
  std::vector<Joint> joints;
  for (const char c : letters) {
    Joint joint;
    joint.name = "joint" + std::to_string(joints.size() + 1);
    joint.offset = random.pose(size);
    joint.screw = c == 'P' ? translation_screw(random.direction())
                           : rotation_screw(random.direction(), random.vector(size / 4),
                                            c == 'H' ? random.uniform(0.1, 0.3) * size : 0);
    joints.push_back(joint);
  }
  return {letters, joints, random.pose(size), random.pose(size)};
}

TEST(Descend, ComesBackToRoundingLevelFromNearby) {
  testing::Random random;
  for (const std::string& name : testing::typical_arms) {
    const Arm arm = built_in(name);
    int hits = 0;
    for (int i = 0; i < 200; ++i) {
      const Configuration q = random.configuration(arm);
      const Pose pose = forward_kinematics(arm, q);
      const NumericalResult run =
          levenberg_marquardt(arm, pose, default_task(arm), bounds_of(arm),
                              nearby(arm, q, 0.05, random), {.tolerance = 1e-9});
      if (!run.converged) continue;  // another branch next to a singularity may end at a bound
      ++hits;
      EXPECT_LT(largest(run.error), 1e-11) << name;
      const Deviation seen =
          task_deviation(default_task(arm), pose, forward_kinematics(arm, run.q));
      EXPECT_NEAR(seen.position, run.error.position, 1e-14);
      EXPECT_NEAR(seen.orientation, run.error.orientation, 1e-14);
    }
    EXPECT_GE(hits, 196) << name;
  }
}

TEST(Descend, NeverLeavesTheBoundsNorTheFinite) {
  testing::Random random;
  for (const std::string& name : testing::typical_arms) {
    const Arm arm = built_in(name);
    const Bounds bounds = bounds_of(arm);
    for (int i = 0; i < 200; ++i) {
      const double far = std::pow(10.0, random.uniform(-3, 8));
      const Configuration start = nearby(arm, random.configuration(arm), far, random);
      const NumericalResult run =
          levenberg_marquardt(arm, random.pose(far), Task::spatial(), bounds, start);
      EXPECT_TRUE((run.q.array() >= bounds.lower.array()).all())
          << name << ' ' << run.q.transpose();
      EXPECT_TRUE((run.q.array() <= bounds.upper.array()).all())
          << name << ' ' << run.q.transpose();
      EXPECT_TRUE(run.q.allFinite());
      EXPECT_TRUE(std::isfinite(largest(run.error)));
    }
  }
}

TEST(Descend, NeverEndsFartherFromThePoseThanItStarted) {
  testing::Random random;
  const Arm arm = built_in("panda");
  for (int i = 0; i < 500; ++i) {
    const Configuration start = random.configuration(arm);
    const Pose pose = random.pose(1.2);
    const Pose before = forward_kinematics(arm, start);
    const NumericalResult run =
        levenberg_marquardt(arm, pose, Task::spatial(), bounds_of(arm), start);
    const double length = arm.reach().radius;
    const Deviation first = task_deviation(Task::spatial(), pose, before);
    EXPECT_LE(std::hypot(run.error.position / length, run.error.orientation),
              std::hypot(first.position / length, first.orientation) * (1 + 1e-12));
  }
}

TEST(Descend, FindsTheEdgeOfABox) {
  // Minimising the distance to a point outside a box ends at the nearest point of the box, which
  // is known: the coordinates are clamped one by one.
  std::vector<Joint> joints(3);
  testing::Random random;
  for (int k = 0; k < 3; ++k) {
    joints[k].name = std::string(1, "xyz"[k]);
    joints[k].screw = translation_screw(Vector3::Unit(k));
    joints[k].limits.lower = -1;
    joints[k].limits.upper = 1;
  }
  const Arm arm("box", joints);
  for (int i = 0; i < 200; ++i) {
    const Vector3 p = random.vector(3);
    const NumericalResult run = levenberg_marquardt(arm, make_pose(p), Task::position(),
                                                    bounds_of(arm), random.configuration(arm));
    EXPECT_LT((run.q - p.cwiseMax(-1).cwiseMin(1)).norm(), 1e-6);
  }
}

TEST(Descend, EveryMaskAndFrameConvergesFromNearby) {
  testing::Random random;
  const Arm arm = built_in("puma560");
  for (int mask = 1; mask < 64; ++mask) {
    for (const Frame frame : {Frame::base, Frame::tool}) {
      Task task{.rows = {}, .frame = frame};
      for (std::size_t i = 0; i < 6; ++i) task.rows[i] = (mask >> i & 1) != 0;
      int hits = 0;
      for (int i = 0; i < 20; ++i) {
        const Configuration q = random.configuration(arm);
        const Pose pose = testing::moved_where_free(forward_kinematics(arm, q), task, random);
        const NumericalResult run =
            levenberg_marquardt(arm, pose, task, no_bounds(arm), nearby(arm, q, 0.02, random));
        hits += run.converged;
        EXPECT_EQ(run.converged,
                  largest(task_deviation(task, pose, forward_kinematics(arm, run.q))) <= 1e-10);
      }
      EXPECT_GE(hits, 18) << name(task);
    }
  }
}

TEST(Descend, ConvergesFastAtRegularSolutions) {
  testing::Random random;
  for (const char* letters : {"R", "P", "RR", "RHP", "RRRRRR", "RRPRRR", "HRRHRRR"}) {
    for (int i = 0; i < 50; ++i) {
      const Arm arm = random_arm(letters, 1, random);
      const Configuration q = random.configuration(arm);
      const NumericalResult run =
          levenberg_marquardt(arm, forward_kinematics(arm, q), Task::spatial(), no_bounds(arm),
                              nearby(arm, q, 1e-3, random));
      EXPECT_TRUE(run.converged) << letters;
      EXPECT_LE(run.iterations, 30) << letters;
    }
  }
}

TEST(Descend, WorksFrom1To100JointsAndOnEveryScale) {
  testing::Random random;
  for (const int dof : {1, 2, 10, 30, 100}) {
    for (const double size : {1e-3, 1.0, 1e4}) {
      const Arm arm =
          random_arm(std::string(static_cast<std::size_t>(dof), 'R'), size / dof, random);
      const Configuration q = random.configuration(arm);
      const NumericalResult run =
          levenberg_marquardt(arm, forward_kinematics(arm, q), Task::spatial(), no_bounds(arm),
                              nearby(arm, q, 0.1, random), {.tolerance = 1e-9});
      EXPECT_TRUE(run.converged) << dof << " joints of " << size;
    }
  }
}

TEST(Descend, StretchedArmIsReachedThoughItIsSingular) {
  const Arm arm = built_in("rrr");
  const Pose pose = forward_kinematics(arm, Configuration::Zero(3));
  const NumericalResult run = levenberg_marquardt(arm, pose, Task::planar(), bounds_of(arm),
                                                  (Configuration(3) << 0.5, -0.8, 0.4).finished());
  EXPECT_TRUE(run.converged);
}

TEST(Descend, RefusesWhatMakesNoSense) {
  const Arm arm = built_in("puma560");
  const Configuration q = middle_configuration(arm);
  const Pose pose = forward_kinematics(arm, q);
  Pose nan = pose;
  nan.translation().x() = std::nan("");
  const Bounds bounds = bounds_of(arm);
  EXPECT_THROW(levenberg_marquardt(arm, nan, Task::spatial(), bounds, q), Error);
  EXPECT_THROW(levenberg_marquardt(arm, pose, Task::spatial(), bounds, Configuration::Zero(5)),
               Error);
  EXPECT_THROW(levenberg_marquardt(arm, pose, Task::spatial(), bounds_of(built_in("panda")), q),
               Error);
  EXPECT_THROW(levenberg_marquardt(arm, pose, Task{.rows = {}}, bounds, q), Error);
  EXPECT_THROW(levenberg_marquardt(arm, pose, Task{.frame = Frame::space}, bounds, q), Error);
  EXPECT_THROW(levenberg_marquardt(arm, pose, Task::spatial(), bounds, q, {.tolerance = -1}),
               Error);
  EXPECT_THROW(levenberg_marquardt(arm, pose, Task::spatial(), bounds, q, {.max_iterations = -1}),
               Error);
}

}  // namespace
}  // namespace beeline
