#include <gtest/gtest.h>
#include <numbers>

#include <beeline/batch/batch.h>
#include <beeline/collision/collision_model.h>
#include <beeline/model/catalog.h>

#include <tests/collision/random_model.h>
#include <tests/ended_budget.h>
#include <tests/inverse/answer.h>

namespace beeline {
namespace {

using testing::Random;

/// An arm with spheres on its links among boxes, some of which its solutions hit.
struct Cell {
  Arm arm;
  CollisionModel model;
  std::function<Reason(const ConfigurationRef&)> blocked = [this](const ConfigurationRef& q) {
    return blocked_by(model, q);
  };

  Cell(Random& random, const std::string& name)
      : arm(built_in(name)), model(random_model(random, arm)) {}

  static CollisionModel random_model(Random& random, const Arm& arm) {
    const double size = arm.reach().radius;
    std::vector<LinkShapes> links;
    for (std::size_t i = 1; i <= arm.joints().size(); ++i) {
      links.push_back({.name = "link" + std::to_string(i),
                       .link = i,
                       .shapes = {{.body = Sphere{0.03 * size}}}});
    }
    const Scene scene =
        testing::random_scene(random, arm, random.integer(1, 8), 0.2 * size, 0.4 * size);
    return {
        arm,
        links,
        scene,
        {.clearance = 0.01 * size, .self_collision = arm.dof() < 5, .budget = {.max_work = 100}}};
  }

  bool is_free(const Configuration& q) const { return pairs_too_close(model, q).empty(); }
};

/// Checks what is promised of the solutions and of the blocked ones, by nearest_pair() alone.
void expect_divided(const Cell& cell, const InverseResult& result) {
  for (const Configuration& q : result.solutions) {
    const BodyDistance nearest = nearest_pair(cell.model, q);
    EXPECT_GE(nearest.lower, nearest.clearance) << q.transpose();
  }
  for (const BlockedSolution& solution : result.blocked) {
    const auto close = pairs_too_close(cell.model, solution.q);
    ASSERT_FALSE(close.empty());
    const auto* body = std::get_if<std::string>(solution.reason.find(ReasonField::body));
    const auto* other = std::get_if<std::string>(solution.reason.find(ReasonField::other_body));
    ASSERT_TRUE(body != nullptr && other != nullptr);
    const auto named = std::find_if(close.begin(), close.end(), [&](const BodyDistance& pair) {
      return pair.names == NamedPair{*body, *other};
    });
    ASSERT_NE(named, close.end()) << solution.reason;
    const bool decided = solution.reason.code != ReasonCode::clearance_not_decided;
    EXPECT_EQ(decided, named->upper < named->clearance) << solution.reason;
  }
}

std::vector<Configuration> joined(const InverseResult& result) {
  std::vector<Configuration> all = result.solutions;
  for (const BlockedSolution& solution : result.blocked) all.push_back(solution.q);
  return all;
}

bool contains(const std::vector<Configuration>& all, const Configuration& q) {
  return std::find(all.begin(), all.end(), q) != all.end();
}

constexpr const char* arms[] = {"rrr", "puma560", "ur5", "panda", "scara"};

// What is skipped as far away is proved to be, as what is measured is.
TEST(BlockedSolutions, AreAtExactlyTheClearanceNotCalledFreeWithoutProof) {
  Random random;
  constexpr double radius = 0.03, clearance = 0.01;
  int blocked = 0;
  for (int i = 0; i < testing::cases(600); ++i) {
    const Arm arm = built_in(i % 2 == 0 ? "ur5" : "gantry");
    const Configuration q = random.configuration(arm);
    const Vector3 place = link_poses(arm, q).back().translation();
    const Vector3 beside = place + (2 * radius + clearance) * random.direction();
    const CollisionModel model(
        arm, {{.name = "hand", .link = arm.joints().size(), .shapes = {{.body = Sphere{radius}}}}},
        {.obstacles = {{.name = "ball",
                        .shapes = {{.body = Sphere{radius},
                                    .pose = Pose(Eigen::Translation3d(beside))}}}}},
        {.clearance = clearance});
    const BodyDistance nearest = nearest_pair(model, q);
    const bool is_blocked = static_cast<bool>(blocked_by(model, q));
    EXPECT_EQ(is_blocked, nearest.lower < clearance) << arm.name() << ' ' << q.transpose();
    blocked += is_blocked;
  }
  EXPECT_GT(blocked, 0);
}

TEST(BlockedSolutions, AndFreeOnesAreAllSolutions) {
  Random random;
  int free = 0, blocked = 0;
  for (int i = 0; i < testing::cases(300); ++i) {
    const Cell cell(random, arms[i % std::size(arms)]);
    const Pose pose = forward_kinematics(cell.arm, random.configuration(cell.arm));
    const InverseOptions options{.all = true, .grid = 8, .random_seed = 3};
    InverseOptions in_cell = options;
    in_cell.blocked_by = cell.blocked;
    const InverseResult all = inverse_kinematics(cell.arm, pose, options);
    const InverseResult divided = inverse_kinematics(cell.arm, pose, in_cell);
    expect_divided(cell, divided);
    const std::vector<Configuration> found = joined(divided);
    EXPECT_EQ(found.size(), all.solutions.size());
    for (const Configuration& q : all.solutions) EXPECT_TRUE(contains(found, q)) << q.transpose();
    EXPECT_EQ(divided.complete, all.complete);
    const bool is_blocked = all && divided.solutions.empty();
    EXPECT_EQ(divided.status, is_blocked ? InverseStatus::blocked : all.status);
    if (is_blocked) {
      EXPECT_EQ(divided.reason.code,
                all.complete ? ReasonCode::all_solutions_blocked : ReasonCode::solutions_blocked);
      EXPECT_EQ(divided.reason.details.front(), divided.blocked.front().reason);
    }
    free += static_cast<int>(divided.solutions.size());
    blocked += static_cast<int>(divided.blocked.size());
  }
  EXPECT_GT(free, 0);
  EXPECT_GT(blocked, 0);
}

// One solution is the first free one of all; a redundant arm searches for it along the self-motion.
TEST(BlockedSolutions, OfOneRequestLeadToTheFirstFreeOne) {
  Random random;
  int replaced = 0;
  for (int i = 0; i < testing::cases(300); ++i) {
    const Cell cell(random, arms[i % std::size(arms)]);
    const Pose pose = forward_kinematics(cell.arm, random.configuration(cell.arm));
    InverseOptions options{.blocked_by = cell.blocked, .grid = 8};
    const InverseResult one = inverse_kinematics(cell.arm, pose, options);
    expect_divided(cell, one);
    options.all = true;
    const InverseResult all = inverse_kinematics(cell.arm, pose, options);
    if (one.status == InverseStatus::blocked) {
      EXPECT_TRUE(all.solutions.empty()) << all;
      continue;
    }
    ASSERT_TRUE(one) << one;
    ASSERT_EQ(one.solutions.size(), 1U);
    EXPECT_FALSE(one.reason) << one.reason;
    if (one.blocked.empty()) continue;
    ++replaced;
    ASSERT_FALSE(all.solutions.empty());
    EXPECT_EQ(one.solutions.front(), all.solutions.front());
  }
  EXPECT_GT(replaced, 0);
}

TEST(BlockedSolutions, OfAnArmThatIsNotRedundantLeadToTheNearestToTheSeed) {
  Random random;
  const Arm arm = built_in("puma560");
  for (int i = 0; i < testing::cases(60); ++i) {
    const Pose pose = forward_kinematics(arm, random.configuration(arm));
    InverseOptions options{.seed = random.configuration(arm), .redundancy = Redundancy::centred};
    const Configuration first = inverse_kinematics(arm, pose, options).solutions.at(0);
    options.blocked_by = [&](const ConfigurationRef& q) {
      return (q - first).norm() < 1e-6 ? Reason{ReasonCode::bodies_collide} : Reason();
    };
    const InverseResult one = inverse_kinematics(arm, pose, options);
    options.all = true;
    for (const Configuration& q : inverse_kinematics(arm, pose, options).solutions) {
      ASSERT_TRUE(one);
      EXPECT_LE((one.solutions[0] - *options.seed).norm(), (q - *options.seed).norm() + 1e-9);
    }
  }
}

TEST(BlockedSolutions, BesideAToleranceAreNotCalledAllThatExist) {
  const Arm arm = built_in("rrr");
  InverseOptions options{.blocked_by = [](const ConfigurationRef& /*q*/) {
    return Reason{ReasonCode::bodies_collide};
  }};
  const Pose pose = forward_kinematics(arm, {0.3, 0.4, 0.5});
  EXPECT_TRUE(inverse_kinematics(arm, pose, options).complete);
  options.pose_tolerance = Eigen::Vector3d(0, 0, std::numbers::pi);
  const InverseResult result = inverse_kinematics(arm, pose, options);
  EXPECT_EQ(result.status, InverseStatus::blocked);
  EXPECT_EQ(result.reason.code, ReasonCode::solutions_blocked);
  EXPECT_FALSE(result.complete);
}

TEST(BlockedSolutions, OfTheMostCentredOneLeadToTheMostCentredOnTheGrid) {
  Random random;
  const auto margin = [](const Arm& arm, const Configuration& q) {
    double least = 1;
    for (int k = 0; k < arm.dof(); ++k) {
      const Limits& limits = arm.limits(k);
      least = std::min(least, 2 * std::min(q[k] - limits.lower, limits.upper - q[k]) /
                                  (limits.upper - limits.lower));
    }
    return least;
  };
  const Arm arm = built_in("panda");
  int replaced = 0;
  for (int i = 0; i < testing::cases(60); ++i) {
    const Pose pose = forward_kinematics(arm, random.configuration(arm));
    InverseOptions options{.redundancy = Redundancy::centred};
    const InverseResult first = inverse_kinematics(arm, pose, options);
    if (!first) continue;
    Pose elbow = Pose::Identity();  // an obstacle is there
    elbow.translation() = link_poses(arm, first.solutions.front())[4].translation();
    const CollisionModel model(
        arm, {{.name = "elbow", .link = 4, .shapes = {{.body = Sphere{0.03}}}}},
        {.obstacles = {{.name = "ball", .shapes = {{.body = Sphere{0.03}, .pose = elbow}}}}});
    options.blocked_by = [&](const ConfigurationRef& q) { return blocked_by(model, q); };
    const InverseResult best = inverse_kinematics(arm, pose, options);
    ASSERT_FALSE(best.blocked.empty());
    EXPECT_EQ(best.blocked.front().q, first.solutions.front());
    if (!best) continue;
    ++replaced;
    options.all = true;
    for (const Configuration& q : inverse_kinematics(arm, pose, options).solutions) {
      EXPECT_LE(margin(arm, q), margin(arm, best.solutions.front()) + 1e-9);
    }
  }
  EXPECT_GT(replaced, 0);
}

TEST(BlockedSolutions, HaveAStatusInBatchesAndNoneInControlLoops) {
  Random random;
  const Cell cell(random, "ur5");
  constexpr int count = 64;
  Eigen::MatrixXd poses(16, count), q(6, count), one(6, 1);
  for (auto pose : poses.colwise()) {
    pose = forward_kinematics(cell.arm, random.configuration(cell.arm)).matrix().reshaped();
  }
  const InverseOptions options{.blocked_by = cell.blocked};
  const Configuration seed = middle_configuration(cell.arm);
  std::vector<InverseOutcome> outcomes;
  const BatchResult batch = batch_inverse(cell.arm, poses, seed, q, outcomes, options);
  for (int i = 0; i < count; ++i) {
    Pose pose;
    pose.matrix() = poses.col(i).reshaped(4, 4);
    const InverseResult single = inverse_kinematics(cell.arm, pose, options);
    EXPECT_EQ(single.status, outcomes[static_cast<std::size_t>(i)].status);
    EXPECT_EQ(q.col(i).allFinite(), static_cast<bool>(single));
    if (single) {
      EXPECT_EQ(q.col(i), single.solutions.front());
    }
    EXPECT_EQ(inverse_kinematics(cell.arm, pose, seed, one, options), single ? 1 : 0);
    if (single) {
      EXPECT_EQ(one.col(0), single.solutions.front());
    }
  }
  EXPECT_LT(batch.solved, count);
}

// The reason is a caller's own, and no configuration is free.
TEST(BlockedSolutions, MayHaveAnyReason) {
  const Reason own{ReasonCode::outside_limits, {{ReasonField::joint, std::string("door")}}};
  const Arm arm = built_in("puma560");
  const Pose pose = forward_kinematics(arm, Configuration::Constant(6, 0.3));
  const auto solutions = inverse_kinematics(arm, pose, {.all = true}).solutions;
  for (const bool all : {false, true}) {
    const InverseResult result = inverse_kinematics(
        arm, pose, {.all = all, .blocked_by = [&](const ConfigurationRef&) { return own; }});
    EXPECT_EQ(result.status, InverseStatus::blocked);
    EXPECT_EQ(result.reason.code, ReasonCode::all_solutions_blocked);
    EXPECT_EQ(result.blocked.size(), solutions.size());
    for (const BlockedSolution& solution : result.blocked) EXPECT_EQ(solution.reason, own);
    EXPECT_TRUE(result.solutions.empty());
    EXPECT_FALSE(result.nearest);
  }
}

TEST(BlockedSolutions, ClaimNothingWhenCancelled) {
  Random random;
  const Cell cell(random, "panda");
  const Pose pose = forward_kinematics(cell.arm, random.configuration(cell.arm));
  for (const bool all : {false, true}) {
    const auto solve = [&](const Budget& budget) {
      return inverse_kinematics(
          cell.arm, pose, {.all = all, .blocked_by = cell.blocked, .grid = 8, .budget = budget});
    };
    const InverseResult whole = solve({});
    testing::for_each_cancellation(testing::cases(100), [&](int n) {
      testing::CancelAt cancel(n);
      const InverseResult ended = solve(cancel.budget());
      expect_divided(cell, ended);
      if (ended.status == InverseStatus::cancelled) {
        EXPECT_FALSE(ended.complete || ended.branches_complete);
        EXPECT_TRUE(ended.reason);
      } else {
        EXPECT_EQ(ended.status, whole.status);
      }
      return cancel.cancelled();
    });
  }
}

}  // namespace
}  // namespace beeline
