#include <gtest/gtest.h>

#include <beeline/certificate/clearance.h>
#include <beeline/certificate/internal/motion_tubes.h>
#include <beeline/collision/internal/tube_gap.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>

#include <tests/certificate/raised_clearance.h>
#include <tests/certificate/random_motion.h>
#include <tests/collision/random_model.h>
#include <tests/refusal.h>

namespace beeline {

using namespace internal;

namespace {

using testing::Random;
using testing::random_interpolation;
using testing::random_motion;

TEST(MotionTubes, ContainTheMotion) {
  Random random;
  for (int i = 0; i < testing::cases(300); ++i) {
    const Arm arm = testing::random_arm(random, random.integer(1, 6));
    const Trajectory motion = random_motion(random, arm, random_interpolation(random),
                                            random.integer(2, 12), random.uniform(0, 0.5));
    const MotionTubes tubes(motion);
    const auto check = [&](auto& self, const MotionTubes::Range& range) -> void {
      const TubeValues& tube = tubes.values(range);
      for (int k = 0; k <= 20; ++k) {
        const double begin = motion.times[range.first], end = motion.times[range.last];
        const Configuration q = sample(motion, begin + (end - begin) * k / 20).position;
        // The position along the tube is the same for all coordinates: an interval of it fits each.
        double lowest = -1, highest = 1;
        for (Eigen::Index j = 0; j < q.size(); ++j) {
          const double offset = q[j] - tube.middle[j], half = tube.half_motion[j];
          if (std::abs(half) < 1e-9) {
            EXPECT_LE(std::abs(offset), tube.slack[j] + 1e-9);
            continue;
          }
          const double a = (offset - tube.slack[j]) / half, b = (offset + tube.slack[j]) / half;
          lowest = std::max(lowest, std::min(a, b));
          highest = std::min(highest, std::max(a, b));
        }
        EXPECT_LE(lowest, highest + 1e-7);
      }
      if (range.is_interval()) return;
      self(self, range.first_half());
      self(self, range.second_half());
    };
    check(check, tubes.all());
  }
}

TEST(TubeGap, BoundsTheMotionAlongADirection) {
  Random random;
  for (int i = 0; i < testing::cases(2000); ++i) {
    const Arm arm = testing::random_arm(random, random.integer(1, 7), 4);
    const auto frames = static_cast<int>(arm.joints().size());
    const auto last = static_cast<std::size_t>(random.integer(1, frames));
    const auto first = static_cast<std::size_t>(random.integer(0, static_cast<int>(last) - 1));
    const Shape shape = testing::random_shape(random, random.integer(0, 3), 0.5, 0.5);
    ChainMotion motion(arm);
    const CarriedBody carried{convex_body(shape), last};
    const double size = std::pow(10, random.uniform(-4, 0));
    TubeValues tube(arm.dof());
    tube.middle = random.configuration(arm);
    for (Eigen::Index k = 0; k < arm.dof(); ++k) {
      tube.half_motion[k] = random.uniform(-size, size);
      tube.slack[k] = random.integer(0, 1) * random.uniform(0, size * size);
    }
    const auto at = [&](double s, Random& any) {
      Configuration q = tube.middle + s * tube.half_motion;
      for (Eigen::Index k = 0; k < q.size(); ++k) {
        q[k] += any.integer(-1, 1) * tube.slack[k];
      }
      return q;
    };
    const JointReach reach =
        motion.reach(carried.body, last, Configuration::Constant(arm.dof(), -4),
                     Configuration::Constant(arm.dof(), 4));
    motion.set(tube.tube());
    const Vector3 n = random.direction();  // fixed to the first frame
    const double remainder = motion.remainder(reach, last, first);
    const double bound =
        highest_along(motion, carried, first, motion.frame(first).rotation * n, remainder) -
        (motion.frame(first).rotation * n).dot(motion.frame(first).origin);
    const double displacement = motion.displacement(reach, last, first);
    const Configuration none = Configuration::Zero(arm.dof());
    ChainMotion still(arm);
    const auto highest = [&](const Configuration& q) {
      still.set({q, none, none});
      const ChainMotion::Frame& fixed = still.frame(first);
      const Vector3 along = fixed.rotation * n;
      return highest_along(still, carried, first, along, 0) - along.dot(fixed.origin);
    };
    const double middle = highest(tube.middle);
    for (int k = 0; k <= 16; ++k) {
      const double value = highest(at(k / 8.0 - 1, random));
      EXPECT_LE(value, bound + 1e-12);
      EXPECT_LE(std::abs(value - middle), displacement + 1e-12);
    }
    // To second order the bound is reached.
    EXPECT_LE(bound - std::max(highest(tube.middle - tube.half_motion),
                               highest(tube.middle + tube.half_motion)),
              2 * remainder + 1e-12);
  }
}

/// Expects that the answer is right at many times.
void expect_right(const CollisionModel& model, const Trajectory& motion,
                  const ClearanceProof& proof, double beyond) {
  const double begin = motion.times.front(), end = motion.times.back();
  if (proof) {
    for (int i = 0; i <= 200; ++i) {
      const BodyDistance pair =
          nearest_pair(model, sample(motion, begin + (end - begin) * i / 200).position);
      EXPECT_GE(pair.upper, pair.clearance + beyond);
      EXPECT_GE(pair.upper, proof.least_distance);
    }
    return;
  }
  const auto position = sample(motion, proof.time).position;
  const BodyDistance pair = nearest_pair(model, position);
  if (proof.status == ClearanceStatus::collides) {
    EXPECT_LT(proof.pair.upper, proof.pair.clearance + beyond);
    EXPECT_LT(pair.lower, pair.clearance + beyond);
  } else {
    ASSERT_EQ(proof.status, ClearanceStatus::not_decided);
    EXPECT_LE(proof.begin, proof.time);
    EXPECT_LE(proof.time, proof.end);
    EXPECT_LE(proof.pair.lower - proof.pair.clearance - beyond, 0.02 * proof.pair.clearance);
  }
  // Everything before is proved.
  for (int i = 0; i < 100 && proof.begin > begin; ++i) {
    const double time = begin + (proof.begin - begin) * i / 100;
    const BodyDistance before = nearest_pair(model, sample(motion, time).position);
    EXPECT_GE(before.upper, before.clearance + beyond);
  }
}

TEST(Clearance, IsNeverProvedFalsely) {
  Random random;
  int answers[3] = {};
  for (int i = 0; i < testing::cases(1000); ++i) {
    const Arm arm = testing::random_arm(random, random.integer(2, 7), 4);
    // A pair that never comes as near as its clearance may come nearer than the clearance and more.
    const double beyond = random.integer(0, 3) == 0 ? random.uniform(0, 0.1) : 0;
    const CollisionModel model(
        arm, testing::random_link_shapes(random, arm, random.uniform(0.01, 0.2)),
        testing::random_scene(random, arm, random.integer(0, 30), random.uniform(0.01, 0.8),
                              random.uniform(1, 4)),
        {.clearance = std::pow(10, random.uniform(-3, -1)),
         .self_collision = random.integer(0, 3) == 0,
         .budget = {.max_work = beyond > 0 ? 0 : 500}});
    if (model.pair_count() == 0) continue;
    const Trajectory motion =
        random_motion(random, arm, random_interpolation(random),
                      random.integer(beyond > 0 ? 2 : 1, 10), random.uniform(0, 0.3));
    const ClearanceProof proof =
        beyond > 0 ? testing::proof_beyond(model, motion, beyond) : prove_clearance(model, motion);
    expect_right(model, motion, proof, beyond);
    ++answers[static_cast<int>(proof.status)];
  }
  EXPECT_GT(answers[0], testing::cases(1000) / 10);
  EXPECT_GT(answers[1], testing::cases(1000) / 20);
  EXPECT_LE(answers[2], testing::cases(1000) / 50);
}

TEST(Clearance, FindsThinPlatesInTheWay) {
  Random random;
  const Arm arm = built_in("rrr");
  const std::vector<LinkShapes> links{{"tip", 3, {{Sphere{0.01}}}}};
  for (int i = 0; i < testing::cases(300); ++i) {
    const Trajectory motion =
        random_motion(random, arm, random_interpolation(random), 4, random.uniform(0.1, 1));
    const double time =
        motion.times.front() + random.uniform(0, 1) * (motion.times.back() - motion.times.front());
    const Pose there = link_poses(arm, sample(motion, time).position)[3];
    // A plate without thickness, or a wire of 0.1 mm, through the place of the tip.
    Shape shape{Box{{1e-3, 1e-3, 0}}, there};
    if (random.integer(0, 1) == 0) shape.body = Capsule{5e-5, 0.01};
    shape.pose.linear() = random.rotation();
    const CollisionModel model(arm, links, {.obstacles = {{"plate", {shape}}}});
    const ClearanceProof proof = prove_clearance(model, motion);
    EXPECT_EQ(proof.status, ClearanceStatus::collides);
    EXPECT_LE(proof.time, time + 1e-6);
    EXPECT_EQ(proof.pair.names, (NamedPair{"tip", "plate"}));
  }
}

TEST(Clearance, IsDecidedExactlyToTheResolution) {
  // One joint moves a sphere on a circle of radius 1 past a wall.
  Joint joint;
  joint.name = "j";
  joint.screw = rotation_screw(Vector3::UnitZ());
  const Arm arm("turn", {joint});
  const std::vector<LinkShapes> links{{"tip", 1, {{Sphere{0.1}, make_pose({1, 0, 0})}}}};
  const Trajectory motion{{"j"}, {0, 1}, {Configuration{{-1}}, Configuration{{1}}}, {}, {}};
  const auto proof = [&](double gap) {
    Shape wall{HalfSpace{}};
    wall.pose = make_pose({1.1 + gap, 0, 0},
                          Rotation(Eigen::AngleAxisd(-std::numbers::pi / 2, Vector3::UnitY())));
    return prove_clearance(
        CollisionModel(arm, links, {.obstacles = {{"wall", {wall}}}}, {.clearance = 0.01}), motion);
  };
  EXPECT_EQ(proof(0.0102).status, ClearanceStatus::clear);
  EXPECT_LE(proof(0.0102).least_distance, 0.0102);
  EXPECT_GE(proof(0.0102).least_distance, 0.01);
  EXPECT_EQ(proof(0.01).status, ClearanceStatus::not_decided);
  EXPECT_EQ(proof(0.0098).status, ClearanceStatus::collides);
  EXPECT_NEAR(proof(0.0098).time, 0.5, 0.02);
  EXPECT_LT(proof(0.01).parts, 20'000);
  for (const double gap : {0.01, 0.0098}) {
    EXPECT_EQ(proof(gap).least_distance, -std::numeric_limits<double>::infinity());
  }
}

TEST(Clearance, FindsTheClosestApproach) {
  Random random;
  int close = 0;
  for (int i = 0; i < testing::cases(150); ++i) {
    const Arm arm = testing::random_arm(random, random.integer(1, 6));
    const auto links = testing::random_link_shapes(random, arm, 0.05);
    const Scene scene = testing::random_scene(random, arm, random.integer(1, 20), 0.05, 3);
    const CollisionModel model(arm, links, scene, {.budget = {.max_work = 500}});
    const CollisionModel all(arm, links, scene, {.budget = {.max_work = 0}});
    const Trajectory motion = random_motion(random, arm, random_interpolation(random),
                                            random.integer(2, 6), random.uniform(0, 0.2));
    const ClearanceProof plain = prove_clearance(model, motion);
    const ClearanceProof closest = prove_clearance(model, motion, {.closest = true});
    ASSERT_EQ(closest.status, plain.status);
    if (!closest || model.pair_count() == 0) continue;
    expect_right(all, motion, closest, 0);
    EXPECT_GE(closest.least_distance, plain.least_distance);
    EXPECT_LE(closest.least_distance, closest.pair.upper);
    const BodyDistance there = nearest_pair(all, sample(motion, closest.time).position);
    EXPECT_NEAR(there.upper, closest.pair.upper, 1e-9);
    close += closest.least_distance >= 0.97 * closest.pair.upper ? 1 : 0;
  }
  EXPECT_GE(close, testing::cases(150) / 3);
}

TEST(Clearance, EndsWhereRoundingDecides) {
  // The clearance is far below the rounding of positions at 1e5 m.
  const Arm arm = with_mount(built_in("rrr"), make_pose({1e5, -1e5, 1e5}));
  const std::vector<LinkShapes> links{{"tip", 3, {{Sphere{0.1}}}}};
  const Configuration q{{0, 0.5, 0.5}}, end{{0.3, 0.2, 0.1}};
  const Trajectory motion{arm.joint_names(), {0, 1}, {q, end}, {}, {}};
  Shape ball{Sphere{0.1}};
  ball.pose = link_poses(arm, q)[3];
  ball.pose.translation().z() += 0.2;
  const ClearanceProof proof = prove_clearance(
      CollisionModel(arm, links, {.obstacles = {{"ball", {ball}}}}, {.clearance = 1e-12}), motion);
  EXPECT_FALSE(proof) << "they touch, to the last digit of 1e5";
  EXPECT_LT(proof.parts, 100'000);
}

/// A part of a jump that time cannot divide is decided for each obstacle, not for a node of the
/// tree: many small balls in clusters, all far from the arm except the last.
TEST(Clearance, DecidesJumpsForEachObstacle) {
  const Arm arm = built_in("rrr");
  const std::vector<LinkShapes> links{{"tip", 3, {{Sphere{0.05}}}}};
  for (const bool in_the_way : {false, true}) {
    Scene scene;
    for (int i = 0; i < 256; ++i) {
      const double angle = i / 64 * 1.5;
      Shape ball{Sphere{0.001}};
      ball.pose = make_pose({5 * std::cos(angle), 5 * std::sin(angle), 0.01 * (i % 64)});
      scene.obstacles.push_back({"ball" + std::to_string(i), {ball}});
    }
    const Configuration begin = Configuration::Zero(3), end = Configuration::Constant(3, 0.3);
    if (in_the_way) {
      Shape ball{Sphere{0.05}};
      ball.pose = link_poses(arm, begin + (end - begin) / 4)[3];  // the middle of a half
      scene.obstacles.push_back({"in the way", {ball}});
    }
    const CollisionModel model(arm, links, scene);
    for (const double time : {0.0, 1e9}) {
      const Trajectory jump{
          arm.joint_names(), {time, std::nextafter(time, 2e9)}, {begin, end}, {}, {}};
      const ClearanceProof proof = prove_clearance(model, jump);
      if (in_the_way) {
        EXPECT_EQ(proof.status, ClearanceStatus::collides);
        EXPECT_EQ(proof.pair.names[1], "in the way");
      } else if (!proof) {
        EXPECT_EQ(proof.status, ClearanceStatus::not_decided);
        EXPECT_GT(proof.pair.upper, 1.5) << "the balls are 2 m beyond the reach";
      }
    }
  }
}

TEST(Clearance, MatchesJointsByName) {
  const Arm arm = built_in("rrr");
  Shape ball{Sphere{0.1}};
  const Configuration end{{1, 0, 0}};
  ball.pose = link_poses(arm, end / 2)[3];
  const CollisionModel model(arm, {{"tip", 3, {{Sphere{0.1}}}}}, {.obstacles = {{"ball", {ball}}}});
  const Trajectory motion{arm.joint_names(), {0, 1}, {Configuration::Zero(3), end}, {}, {}};
  Trajectory other = motion;
  std::swap(other.joint_names[0], other.joint_names[2]);
  std::swap(other.positions.back()[0], other.positions.back()[2]);
  EXPECT_EQ(prove_clearance(model, motion).status, ClearanceStatus::collides);
  const ClearanceProof proof = prove_clearance(model, other);
  EXPECT_EQ(proof.status, ClearanceStatus::collides);
  EXPECT_EQ(proof.time, prove_clearance(model, motion).time);
  other.joint_names = {"x", "y", "z"};
  EXPECT_REFUSED(prove_clearance(model, other), "x");
  EXPECT_REFUSED(clearance_over_time(model, other), "x");
}

/// The capsules around two plates overlap by far; the plates themselves are tested at once.
TEST(Clearance, OfTwoFlatLinksNeedsFewParts) {
  Joint joint;
  joint.name = "slide";
  joint.screw = translation_screw(Vector3::UnitX());
  const Arm arm("slide", {joint}, Pose::Identity(), Pose::Identity());
  const Shape plate{Box{{0.4, 0.4, 0.002}}};
  Shape above = plate;
  above.pose.translation().z() = 0.032;
  const CollisionModel model(
      arm,
      {{.name = "lower", .link = 0, .shapes = {plate}, .at_distal_joint = false},
       {.name = "upper", .link = 1, .shapes = {above}}},
      {}, {.budget = {.max_work = 0}});
  const Trajectory motion{arm.joint_names(),
                          {0, 1},
                          {Configuration::Constant(1, -0.15), Configuration::Constant(1, 0.15)},
                          {},
                          {}};
  const ClearanceProof proof = prove_clearance(model, motion);
  EXPECT_TRUE(proof) << proof;
  EXPECT_NEAR(proof.least_distance, 0.03, 1e-9);
  EXPECT_LE(proof.parts, 2U);
}

TEST(Clearance, EndsWithItsBudget) {
  Random random;
  const Arm arm = built_in("panda");
  const CollisionModel model(arm, testing::random_link_shapes(random, arm, 0.02),
                             testing::random_scene(random, arm, 100, 0.02, 1));
  const Trajectory motion = random_motion(random, arm, Interpolation::linear, 20, 1);
  EXPECT_EQ(prove_clearance(model, motion, {.budget = {.max_work = 1}}).status,
            ClearanceStatus::work_limit);
}

TEST(Clearance, IsNotProvedWithoutASearch) {
  EXPECT_FALSE(ClearanceProof());
  EXPECT_EQ(ClearanceProof().status, ClearanceStatus::not_decided);
}

TEST(Clearance, RefusesWhatDoesNotFit) {
  const Arm arm = built_in("rrr");
  const CollisionModel model(arm, {{"tip", 3, {{Sphere{0.01}}}}});
  const Trajectory motion{arm.joint_names(), {0}, {Configuration::Zero(3)}, {}, {}};
  EXPECT_TRUE(prove_clearance(model, motion)) << "no pairs";
  EXPECT_EQ(prove_clearance(model, motion).pairs, 0);
  EXPECT_REFUSED(prove_clearance(model, {}), "no samples");
  EXPECT_REFUSED(prove_clearance(model, motion, {.resolution = 0}), "resolution");
  EXPECT_REFUSED(prove_clearance(model, {{"a"}, {0}, {Configuration::Zero(1)}, {}, {}}), "1");
}

}  // namespace
}  // namespace beeline
