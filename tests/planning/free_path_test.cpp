#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/planning/free_path.h>

#include <tests/collision/random_model.h>
#include <tests/reason.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using namespace testing;

Configuration vector(const ConfigurationRef& values) { return values; }

/// Two slides in a plane with a disc at their end; obstacles are walls of boxes.
struct Maze {
  Maze() {
    std::vector<Joint> slides;
    for (int i = 0; i < 2; ++i) {
      slides.push_back(composite_joint('P', std::string(1, "xy"[i])).front());
      slides.back().screw = translation_screw(Vector3::Unit(i));
      slides.back().limits = {.lower = 0, .upper = 4, .velocity = 1, .acceleration = 4};
    }
    arm = Arm("maze", slides);
  }

  /// A wall from (x, low) to (x, high).
  void add_wall(double x, double low, double high) {
    scene.obstacles.push_back(
        {.name = "wall" + std::to_string(scene.obstacles.size()),
         .shapes = {{Box{Vector3(0.1, high - low, 1)},
                     make_pose({x, (low + high) / 2, 0}, Rotation::Identity())}}});
  }

  CollisionModel model() const { return {arm, {{"disc", 2, {{Sphere{0.2}}}}}, scene}; }

  Arm arm = Arm("empty", {composite_joint('P', "x").front()});
  Scene scene;
};

/// Checks that each straight motion of a path is proved, and its ends.
void expect_free(const CollisionModel& model, const FreePath& path, const Configuration& start,
                 const std::vector<Configuration>& goals) {
  ASSERT_TRUE(path) << path.reason;
  ASSERT_GE(path.waypoints.size(), 2U);
  EXPECT_EQ(path.waypoints.front(), start);
  EXPECT_EQ(path.waypoints.back(), goals.at(path.goal));
  double length = 0;
  for (std::size_t k = 1; k < path.waypoints.size(); ++k) {
    const Configuration &from = path.waypoints[k - 1], &to = path.waypoints[k];
    length += (to - from).norm();
    const Trajectory edge{model.arm().joint_names(), {0, 1}, {from, to}, {}, {}};
    EXPECT_TRUE(prove_clearance(model, edge)) << "edge " << k;
    // Another way: distances at samples.
    for (int i = 0; i <= 50; ++i) {
      const Configuration q = from + i / 50.0 * (to - from);
      EXPECT_TRUE(limit_violations(model.arm(), q, 1e-12).empty());
      EXPECT_TRUE(pairs_too_close(model, q).empty()) << q.transpose();
    }
  }
  EXPECT_NEAR(path.length, length, 1e-12 * (1 + length));
}

TEST(FreePath, IsTheStraightMotionWhereThatIsFree) {
  const Maze maze;
  const CollisionModel model = maze.model();
  const std::vector<Configuration> goals{vector({3.5, 3.5}), vector({1, 1})};
  const FreePath path = find_free_path(model, vector({0.5, 0.5}), goals);
  expect_free(model, path, vector({0.5, 0.5}), goals);
  EXPECT_EQ(path.goal, 1U) << "the nearest goal";
  EXPECT_EQ(path.waypoints.size(), 2U);
  EXPECT_EQ(path.edges, 1U);
}

// At 3 % more than the clearance the straight motion is taken, too.
TEST(FreePath, IsTheStraightMotionNearTheClearance) {
  Maze maze;
  maze.add_wall(2, 2, 5);
  constexpr double clearance = 0.1, disc = 0.2;
  const CollisionModel model(maze.arm, {{"disc", 2, {{Sphere{disc}}}}}, maze.scene,
                             {.clearance = clearance});
  const double y = 2 - disc - 1.03 * clearance;
  const std::vector<Configuration> goals{vector({3.5, y})};
  const FreePath path = find_free_path(model, vector({0.5, y}), goals);
  expect_free(model, path, vector({0.5, y}), goals);
  EXPECT_EQ(path.waypoints.size(), 2U);
}

// The way around the near end of a wall is short; the one around the other end is long.
TEST(FreePath, DoesNotKeepALongWayAround) {
  Maze maze;
  maze.add_wall(2, 0.55, 3.4);
  const CollisionModel model = maze.model();
  const std::vector<Configuration> goals{vector({2.4, 0.8})};
  int is_long = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const FreePath path = find_free_path(model, vector({1.6, 0.8}), goals, {.random_seed = seed});
    expect_free(model, path, vector({1.6, 0.8}), goals);
    if (path.length > 3) ++is_long;  // around the far end it is 6
  }
  EXPECT_LE(is_long, 4);
}

TEST(FreePath, GoesAroundWalls) {
  Maze maze;
  maze.add_wall(1.3, -1, 3);
  maze.add_wall(2.6, 1, 5);
  const CollisionModel model = maze.model();
  const Configuration start = vector({0.5, 0.5});
  const std::vector<Configuration> goals{vector({3.5, 3.5})};
  // The disc keeps 0.201 m: it crosses x = 1.3 above y = 3.201, and x = 2.6 below y = 0.799.
  const std::vector<Configuration> corners{start, vector({1.3, 3.201}), vector({2.6, 0.799}),
                                           goals[0]};
  double shortest = 0;
  for (std::size_t k = 1; k < 4; ++k) shortest += (corners[k] - corners[k - 1]).norm();
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const FreePath path = find_free_path(model, start, goals, {.random_seed = seed});
    expect_free(model, path, start, goals);
    EXPECT_GT(path.length, shortest);
    EXPECT_LT(path.length, 1.3 * shortest) << "seed " << seed;
    const FreePath again = find_free_path(model, start, goals, {.random_seed = seed});
    EXPECT_EQ(again.waypoints, path.waypoints) << "equal arguments, another path";
  }
}

TEST(FreePath, ShortcutsShorten) {
  Maze maze;
  maze.add_wall(2, -1, 3);
  const CollisionModel model = maze.model();
  const Configuration start = vector({0.5, 0.5});
  const std::vector<Configuration> goals{vector({3.5, 0.5})};
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto length = [&](int shortcuts) {
      return find_free_path(model, start, goals, {.random_seed = seed, .shortcuts = shortcuts})
          .length;
    };
    EXPECT_LE(length(200), length(0));
  }
}

TEST(FreePath, NamesAStartOrGoalsThatAreNotFree) {
  Maze maze;
  maze.add_wall(2, -1, 5);
  const CollisionModel model = maze.model();
  const Configuration free = vector({0.5, 0.5}), inside = vector({2, 2}), out = vector({5, 1});
  FreePath path = find_free_path(model, inside, std::vector{free});
  EXPECT_EQ(path.status, MotionStatus::collides);
  EXPECT_EQ(path.reason.code, ReasonCode::start_not_free);
  ASSERT_EQ(path.reason.details.size(), 1U);
  EXPECT_EQ(field<std::string>(path.reason.details[0], ReasonField::other_body), "wall0");
  path = find_free_path(model, free, std::vector{inside, out});
  EXPECT_EQ(path.status, MotionStatus::collides);
  EXPECT_EQ(path.reason.code, ReasonCode::goal_not_free);
  EXPECT_EQ(field<std::size_t>(path.reason, ReasonField::count), 2U);
  path = find_free_path(model, free, std::vector{out});
  EXPECT_EQ(path.status, MotionStatus::outside_limits);
  EXPECT_TRUE(path.waypoints.empty());
  // A free goal among others is enough.
  const std::vector<Configuration> goals{inside, out, vector({1, 3})};
  path = find_free_path(model, free, goals);
  expect_free(model, path, free, goals);
  EXPECT_EQ(path.goal, 2U);
}

TEST(FreePath, EndsWhereThereIsNoWay) {
  Maze maze;
  maze.add_wall(2, -1, 5);
  const CollisionModel model = maze.model();
  const Configuration start = vector({0.5, 0.5});
  const std::vector<Configuration> goals{vector({3.5, 0.5})};
  FreePath path = find_free_path(model, start, goals, {.max_edges = 300});
  EXPECT_EQ(path.status, MotionStatus::not_found);
  EXPECT_EQ(path.reason.code, ReasonCode::no_free_path);
  EXPECT_EQ(path.edges, 300U);
  std::vector<Configuration> behind;
  for (int i = 0; i < 50; ++i) behind.push_back(vector({3 + 0.01 * i, 2}));
  EXPECT_EQ(find_free_path(model, start, behind, {.max_edges = 7}).edges, 7U);
  EXPECT_EQ(find_free_path(model, start, behind, {.budget = {.max_work = 0}}).status,
            MotionStatus::work_limit);
  path = find_free_path(model, start, goals, {.budget = {.max_work = 40}});
  EXPECT_EQ(path.status, MotionStatus::work_limit);
  EXPECT_EQ(path.reason.code, ReasonCode::ended_before_free_path);
  path = find_free_path(model, start, goals, {.budget = {.cancelled = [] { return true; }}});
  EXPECT_EQ(path.status, MotionStatus::cancelled);
  EXPECT_REFUSED(find_free_path(model, start, goals, {.max_edges = 0}), "max_edges");
  EXPECT_REFUSED(find_free_path(model, start, {}), "goal");
  EXPECT_REFUSED(find_free_path(model, vector({1}), goals), "joint");
}

TEST(FreePath, OfArmsAmongRandomObstacles) {
  Random random;
  int found = 0;
  for (int i = 0; i < testing::cases(30); ++i) {
    const Arm arm = built_in(i % 2 == 0 ? "panda" : "ur5");
    const CollisionModel model(arm, random_link_shapes(random, arm, 0.06),
                               random_scene(random, arm, random.integer(1, 8), 0.15, 0.8));
    const auto free = [&]() -> std::optional<Configuration> {
      for (int tries = 0; tries < 100; ++tries) {
        Configuration q = random.configuration(arm);
        if (!blocked_by(model, q)) return q;
      }
      return std::nullopt;
    };
    const auto start = free(), goal = free();
    if (!start || !goal) continue;
    const FreePath path = find_free_path(model, *start, std::vector{*goal}, {.max_edges = 2000});
    if (!path) continue;
    ++found;
    expect_free(model, path, *start, {*goal});
  }
  EXPECT_GT(found, 0);
}

/// The motion of a path is within the limits, at rest at its ends, and proved by itself.
void expect_motion(const CollisionModel& model, const FreeMotion& motion,
                   const Configuration& start, const Configuration& goal) {
  ASSERT_TRUE(motion) << motion.reason;
  const Trajectory& trajectory = motion.trajectory;
  EXPECT_LT((trajectory.positions.front() - start).norm(), 1e-9);
  EXPECT_LT((trajectory.positions.back() - goal).norm(), 1e-9);
  EXPECT_EQ(trajectory.velocities.front().norm(), 0);
  EXPECT_EQ(trajectory.velocities.back().norm(), 0);
  EXPECT_TRUE(prove_clearance(model, trajectory));
  const LimitUsage use = limit_usage(model.arm(), trajectory);
  for (const double fraction :
       {use.velocity.fraction, use.acceleration.fraction, use.jerk.fraction}) {
    EXPECT_LE(fraction, 1 + 1e-6);
  }
}

TEST(FreePath, IsNotLostByItsShortcuts) {
  Maze maze;
  maze.add_wall(1.3, -1, 3);
  const CollisionModel model = maze.model();
  const Configuration start = vector({0.5, 0.5});
  const std::vector<Configuration> goals{vector({3.5, 0.5})};
  const FreePath path = find_free_path(model, start, goals, {.shortcuts = 0});
  ASSERT_TRUE(path);
  const auto edges = static_cast<int>(path.edges);  // as many as the trees need, or more
  const FreePath shortened =
      find_free_path(model, start, goals, {.max_edges = edges, .shortcuts = 10'000});
  expect_free(model, shortened, start, goals);
  EXPECT_LE(shortened.length, path.length);
}

TEST(FreePath, GoesAroundAWallThatSamplesMiss) {
  Maze maze;
  maze.scene.obstacles.push_back(
      {.name = "sheet",
       .shapes = {{Box{Vector3(1e-3, 4, 1)}, make_pose({2, 1.7, 0}, Rotation::Identity())}}});
  const CollisionModel model(maze.arm, {{"disc", 2, {{Sphere{2e-3}}}}}, maze.scene);
  const Configuration start = vector({1.01, 0.5});
  const std::vector<Configuration> goals{vector({3.03, 0.5})};
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const FreePath path = find_free_path(model, start, goals, {.random_seed = seed});
    expect_free(model, path, start, goals);
    EXPECT_GT(path.length, 6.4);
  }
}

TEST(MoveAround, PassesWaypointsWithoutAStop) {
  Maze maze;
  maze.add_wall(1.3, -1, 3);
  maze.add_wall(2.6, 1, 5);
  const CollisionModel model = maze.model();
  const Configuration start = vector({0.5, 0.5}), goal = vector({3.5, 3.5});
  const FreeMotion blended = move_around(model, start, std::vector{goal});
  expect_motion(model, blended, start, goal);
  ASSERT_EQ(blended.blends.size() + 2, blended.path.waypoints.size());
  EXPECT_GT(*std::max_element(blended.blends.begin(), blended.blends.end()), 0);
  const FreeMotion stopping = move_around(model, start, std::vector{goal}, {.joint_blend = 0});
  expect_motion(model, stopping, start, goal);
  EXPECT_EQ(stopping.path.waypoints, blended.path.waypoints);
  EXPECT_LT(blended.duration(), stopping.duration());
  EXPECT_REFUSED(move_around(model, start, std::vector{goal}, {.joint_blend = -1}), "joint_blend");
}

/// Blends so small that the arm would nearly stop in them are stops.
TEST(MoveAround, HasNoTinyBlends) {
  Maze maze;
  maze.add_wall(1.3, -1, 3);
  const CollisionModel model = maze.model();
  const Configuration start = vector({0.5, 0.5}), goal = vector({3.5, 0.5});
  const FreeMotion stopping = move_around(model, start, std::vector{goal}, {.joint_blend = 0});
  for (const double blend : {1e-13, 1e-12, 1e-8, 1e-4}) {
    const FreeMotion motion = move_around(model, start, std::vector{goal}, {.joint_blend = blend});
    expect_motion(model, motion, start, goal);
    EXPECT_EQ(motion.duration(), stopping.duration()) << blend;
  }
  const FreeMotion smallest = move_around(model, start, std::vector{goal}, {.joint_blend = 2e-3});
  expect_motion(model, smallest, start, goal);
  EXPECT_LE(smallest.duration(), stopping.duration());
}

TEST(MoveAround, EndsWithItsBudget) {
  Maze maze;
  maze.add_wall(1.3, -1, 3);
  const CollisionModel model = maze.model();
  const Configuration start = vector({0.5, 0.5});
  const std::vector<Configuration> goals{vector({3.5, 0.5})};
  int questions = 0, most = std::numeric_limits<int>::max();
  const auto late = [&] { return ++questions > most; };
  const FreePath unshortened =
      find_free_path(model, start, goals, {.shortcuts = 0, .budget = {.cancelled = late}});
  ASSERT_TRUE(unshortened);
  most = std::exchange(questions, 0) + 50;
  const FreePath path =
      find_free_path(model, start, goals, {.shortcuts = 1'000'000, .budget = {.cancelled = late}});
  EXPECT_TRUE(path) << "a path that was found before stays";
  EXPECT_LT(path.edges, unshortened.edges + 100);
  EXPECT_REFUSED(find_free_path(model, start, goals, {.shortcuts = 1'000'001}), "shortcuts");
  const FreeMotion motion = move_around(model, start, goals, {.budget = {.max_work = 60}});
  EXPECT_EQ(motion.status, MotionStatus::work_limit);
  EXPECT_EQ(motion.trajectory.size(), 0U);
}

/// A joint without limits far away does not fill the trees with nodes.
TEST(FreePath, OfJointsWithoutLimitsEnds) {
  Joint joint = composite_joint('P', "x").front();
  joint.limits = {.velocity = 1, .acceleration = 4};
  const Arm arm("slide", {joint});
  const CollisionModel model(
      arm, {{"hand", 1, {{Sphere{0.1}}}}},
      {.obstacles = {
           {"wall", {{Box{Vector3::Ones()}, make_pose({2, 0, 0}, Rotation::Identity())}}}}});
  const FreePath path =
      find_free_path(model, vector({0}), std::vector{vector({1e12})}, {.max_edges = 100});
  EXPECT_EQ(path.status, MotionStatus::not_found);
  EXPECT_GE(path.edges, 100U);
  EXPECT_LT(path.edges, 300U) << "and shortcuts of paths that are not proved";
}

TEST(MoveAround, RestsWhereTheGoalIsTheStart) {
  const Maze maze;
  const CollisionModel model = maze.model();
  const Configuration start = vector({0.5, 0.5});
  const FreeMotion motion = move_around(model, start, std::vector{vector({3, 3}), start});
  ASSERT_TRUE(motion) << motion.reason;
  EXPECT_EQ(motion.path.goal, 1U);
  EXPECT_EQ(motion.path.length, 0);
  EXPECT_EQ(motion.trajectory.size(), 1U);
  EXPECT_EQ(motion.trajectory.positions.front(), start);
  EXPECT_TRUE(motion.clearance);
  const FreeMotion longer = move_around(model, start, std::vector{start}, {.duration = 3});
  EXPECT_EQ(longer.duration(), 3);
  const Configuration near = vector({0.5 + 1e-13, 0.5});
  EXPECT_TRUE(move_around(model, start, std::vector{near}));
}

TEST(MoveAround, OfAnArmKeepsItsPromises) {
  const Arm arm = built_in("panda");
  const std::vector<LinkShapes> hand{{"hand", 7, {{Sphere{0.06}}}}};
  const Pose in_front = make_pose({0.45, 0, 0.5}, Rotation::Identity());
  const CollisionModel pillar(
      arm, hand,
      {.obstacles = {{"pillar", {{Cylinder{.radius = 0.06, .length = 1.2}, in_front}}}}});
  const Configuration left = vector({0.6, -0.3, 0, -2.2, 0, 1.9, 0.8});
  const Configuration right = vector({-0.6, -0.3, 0, -2.2, 0, 1.9, 0.8});
  const FreeMotion past = move_around(pillar, left, std::vector{right});
  expect_motion(pillar, past, left, right);
  EXPECT_GT(past.path.waypoints.size(), 2U) << "the straight motion goes through the pillar";
  Random random;
  for (int i = 0; i < testing::cases(12); ++i) {
    const CollisionModel model(arm, random_link_shapes(random, arm, 0.06),
                               random_scene(random, arm, 6, 0.15, 0.8));
    const Configuration start = random.configuration(arm), goal = random.configuration(arm);
    const FreeMotion motion = move_around(model, start, std::vector{goal}, {.max_edges = 2000});
    if (!motion) {
      EXPECT_TRUE(motion.reason) << "a refusal without a reason";
      EXPECT_EQ(motion.trajectory.size(), 0U);
      continue;
    }
    expect_motion(model, motion, start, goal);
  }
}

}  // namespace
}  // namespace beeline
