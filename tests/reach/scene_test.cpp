// Maps and placements in a scene.

#include <algorithm>
#include <atomic>
#include <gtest/gtest.h>
#include <memory>
#include <numeric>

#include <beeline/certificate/clearance.h>
#include <beeline/collision/collision_model.h>
#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/io/text/arm.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/planning/move_along.h>
#include <beeline/reach/internal/pose_solver.h>
#include <beeline/reach/place.h>
#include <beeline/reach/reach.h>

#include <tests/degrees.h>
#include <tests/random.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using testing::cases;
using testing::deg;
using testing::Random;

std::vector<LinkShapes> spheres_of(const Arm& arm) {
  std::vector<LinkShapes> links;
  for (std::size_t i = 1; i <= arm.joints().size(); ++i) {
    links.push_back({.name = "link" + std::to_string(i),
                     .link = i,
                     .shapes = {{.body = Sphere{0.03 * arm.reach().radius}}}});
  }
  return links;
}

CollisionOptions options_of(const Arm& arm) {
  return {.clearance = 0.01 * arm.reach().radius,
          .self_collision = arm.dof() < 5,
          .budget = {.max_work = 100}};
}

/// The arm with spheres on its links among boxes.
struct Cell {
  Arm arm;
  Scene scene;
  CollisionModel model{arm, spheres_of(arm), scene, options_of(arm)};

  Cell(const std::string& name, const Scene& around) : arm(built_in(name)), scene(around) {}
  Cell(Random& random, const std::string& name) : Cell(name, boxes(random, built_in(name))) {}

  /// Boxes around the arm, each of which some solutions hit.
  static Scene boxes(Random& random, const Arm& arm) {
    Scene scene;
    for (int i = 0; i < 3; ++i) {
      const double radius = arm.reach().radius;
      Vector3 place = random.uniform(0.3, 0.7) * radius * random.direction();
      if (arm.planar()) place.z() = 0;
      const double size = random.uniform(0.2, 0.4) * radius;
      scene.obstacles.push_back(
          {.name = "box" + std::to_string(i),
           .shapes = {{.body = Box{Vector3::Constant(size)},
                       .pose = Pose(Eigen::Translation3d(arm.base().translation() + place))}}});
    }
    return scene;
  }

  ReachOptions options(int redundant_values = 4) const {
    return {.redundant_values = redundant_values,
            .blocked_by = [this](const ConfigurationRef& q) { return blocked_by(model, q); },
            .scene = ReachScene{.digest = digest(model), .clearance = model.clearance()}};
  }
};

Scene box_at(const Vector3& place, double size) {
  return {.obstacles = {{.name = "box",
                         .shapes = {{.body = Box{Vector3::Constant(size)},
                                     .pose = Pose(Eigen::Translation3d(place))}}}}};
}

/// The cells are `factor` times as large.
ReachGrid grid_of(const Arm& arm, double factor = 1) {
  const double radius = factor * arm.reach().radius;
  if (arm.planar()) return ReachGrid(arm, {.resolution = radius / 4, .directions = 60 * deg});
  return ReachGrid(arm, {.resolution = radius / 2, .directions = 90 * deg, .rolls = 90 * deg});
}

void expect_alike(const ReachCells& a, const ReachCells& b) {
  EXPECT_EQ(a.branches, b.branches);
  const auto same = [](float x, float y) {
    return (std::isnan(x) && std::isnan(y)) || std::abs(x - y) < 1e-5F;
  };
  EXPECT_TRUE(std::equal(a.manipulability.begin(), a.manipulability.end(), b.manipulability.begin(),
                         b.manipulability.end(), same));
  EXPECT_TRUE(std::equal(a.margin.begin(), a.margin.end(), b.margin.begin(), b.margin.end(), same));
}

/// The wrist of an arm of equal links is on its base: the first joint's value is free.
TEST(ReachInScene, ASelfMotionIsSearchedForAFreeSolution) {
  const auto faces_away = [](const ConfigurationRef& q) {
    return std::cos(q[0]) > -0.5 ? Reason{ReasonCode::bodies_too_close} : Reason{};
  };
  internal::PoseSolver solver(arm_from_joint_string("RRR:3.5,3.5,2"), 1, faces_away);
  solver.solve(to_space({2, 0, 0}));
  ASSERT_GT(solver.solutions().cols(), 0);
  EXPECT_FALSE(faces_away(solver.solutions().col(0)));
  internal::PoseSolver none(built_in("rrr"), 1, [](const ConfigurationRef&) {
    return Reason{ReasonCode::bodies_too_close};
  });
  none.solve(to_space({2, 0, 0}));
  EXPECT_EQ(none.solutions().cols(), 0);
  EXPECT_TRUE(none.blocked());
}

constexpr const char* arms[] = {"rrr", "puma560", "ur5", "panda", "scara"};

TEST(ReachInScene, FarAwayChangesNothing) {
  for (const char* name : arms) {
    Cell cell(name, box_at(Vector3(90, 0, 0), 1));
    cell.model = CollisionModel(cell.arm, spheres_of(cell.arm), cell.scene,
                                {.clearance = 0.01, .self_collision = false});
    const ReachGrid grid = grid_of(cell.arm);
    expect_alike(reach_cells(cell.arm, grid, 0, grid.positions(), cell.options()),
                 reach_cells(cell.arm, grid, 0, grid.positions(), {.redundant_values = 4}));
  }
}

TEST(ReachInScene, OfAllSpaceReachesNothing) {
  for (const char* name : arms) {
    const Cell cell(name, box_at(Vector3::Zero(), 100));
    const ReachGrid grid = grid_of(cell.arm, testing::slow_build ? 2 : 1);
    const ReachCells cells = reach_cells(cell.arm, grid, 0, grid.positions(), cell.options());
    EXPECT_EQ(std::count(cells.branches.begin(), cells.branches.end(), 0), grid.cells());
    EXPECT_TRUE(std::isnan(cells.margin[0]) && std::isnan(cells.manipulability[0]));
  }
}

// The number of free solutions, their largest margin and manipulability.
TEST(ReachInScene, CountsTheFreeSolutionsOfInverseKinematics) {
  Random random;
  int free = 0, blocked = 0;
  for (int i = 0; i < cases(10); ++i) {
    const Cell cell(random, arms[i % std::size(arms)]);
    const bool redundant = cell.arm.dof() == 7;
    const ReachGrid grid = grid_of(cell.arm);
    const ReachCells cells = reach_cells(cell.arm, grid, 0, grid.positions(), cell.options());
    const ReachCells alone =
        reach_cells(cell.arm, grid, 0, grid.positions(), {.redundant_values = 4});
    for (int k = 0; k < std::max(6, cases(60)); ++k) {
      const auto at =
          static_cast<std::size_t>(random.integer(0, static_cast<int>(grid.cells()) - 1));
      EXPECT_LE(cells.branches[at], alone.branches[at]);
      free += cells.branches[at];
      blocked += alone.branches[at] - cells.branches[at];
      if (redundant) continue;
      const InverseResult result =
          inverse_kinematics(cell.arm, grid.pose(static_cast<Eigen::Index>(at)),
                             {.all = true, .blocked_by = cell.options().blocked_by});
      if (result.self_motion_dimension > 0) continue;
      EXPECT_EQ(std::size_t{cells.branches[at]}, result.solutions.size())
          << cell.arm.name() << " cell " << at;
      float margin = -1;
      for (const Configuration& q : result.solutions) {
        EXPECT_TRUE(pairs_too_close(cell.model, q).empty());
        double least = 1;
        for (int j = 0; j < cell.arm.dof(); ++j) {
          const Limits& limits = cell.arm.limits(j);
          least = std::min(least, limit_margin(q[j], limits.lower, limits.upper));
        }
        margin = std::max(margin, static_cast<float>(std::max(least, 0.0)));
      }
      if (margin >= 0) {
        EXPECT_NEAR(cells.margin[at], margin, 1e-5);
      }
    }
  }
  EXPECT_GT(free, 0);
  EXPECT_GT(blocked, 0);
}

// A redundant arm at all values of its joint: the largest number of free solutions at one value.
TEST(ReachInScene, CountsTheBestValueOfARedundantJoint) {
  Random random;
  constexpr int values = 4;
  int some = 0;
  for (int i = 0; i < 2; ++i) {
    const Cell cell(random, "panda");
    const ReachGrid grid = grid_of(cell.arm);
    const ReachCells cells = reach_cells(cell.arm, grid, 0, grid.positions(), cell.options(values));
    const ReachCells alone =
        reach_cells(cell.arm, grid, 0, grid.positions(), {.redundant_values = values});
    const Limits limits = cell.arm.limits(6);
    const InverseOptions all{.all = true, .lock = 6};
    InverseOptions free = all;
    free.blocked_by = cell.options().blocked_by;
    Eigen::MatrixXd found(7, 32);
    for (Eigen::Index at = 0; at < grid.cells(); ++at) {
      if (alone.branches[static_cast<std::size_t>(at)] == 0) continue;
      int most = 0;
      bool any = false;
      for (int v = 0; v < values; ++v) {
        Configuration seed = middle_configuration(cell.arm);
        seed[6] = limits.lower + (limits.upper - limits.lower) * (v + 0.5) / values;
        most = std::max(most, inverse_kinematics(cell.arm, grid.pose(at), seed, found, free));
        any = any || inverse_kinematics(cell.arm, grid.pose(at), seed, found, all) > 0;
      }
      if (!any) continue;  // the range between the values is searched
      EXPECT_EQ(cells.branches[static_cast<std::size_t>(at)], most) << at;
      some += most;
    }
  }
  EXPECT_GT(some, 0);
}

TEST(ReachInScene, DoesNotDependOnThreads) {
  Random random;
  for (const char* name : {"ur5", "panda"}) {
    const Cell cell(random, name);
    const ReachGrid grid = grid_of(cell.arm, testing::slow_build ? 2 : 1);
    for (const std::int64_t samples : {0, testing::example_size(20'000)}) {
      ReachOptions options = cell.options();
      options.samples = samples;
      options.threads = 1;
      const ReachCells one = reach_cells(cell.arm, grid, 0, grid.positions(), options);
      options.threads = 4;
      expect_alike(reach_cells(cell.arm, grid, 0, grid.positions(), options), one);
    }
  }
}

TEST(ReachInScene, LeavesOutBlockedSamples) {
  Random random;
  const Cell cell(random, "ur5");
  const ReachGrid grid(cell.arm, {.resolution = 10, .any_orientation = true});
  ReachOptions options = cell.options();
  options.samples = 200;
  const ReachCells all = reach_cells(cell.arm, grid, 0, grid.positions(), {.samples = 200});
  std::atomic<int> blocked = 0;
  options.blocked_by = [&](const ConfigurationRef& q) {
    const Reason reason = blocked_by(cell.model, q);
    blocked += static_cast<bool>(reason);
    return reason;
  };
  const ReachCells free = reach_cells(cell.arm, grid, 0, grid.positions(), options);
  const auto sum = [](const ReachCells& cells) {
    return std::accumulate(cells.branches.begin(), cells.branches.end(), 0);
  };
  EXPECT_EQ(sum(free), sum(all) - blocked);
  EXPECT_GT(blocked, 0);
}

TEST(ReachInScene, RefusesAzimuthsAndDirectionsWithoutRolls) {
  const Cell cell("ur5", box_at(Vector3(0.5, 0, 0), 0.1));
  const auto compute = [&](const ReachGridOptions& options) {
    return reach_cells(cell.arm, ReachGrid(cell.arm, options), 0, 1, cell.options());
  };
  EXPECT_REFUSED(compute({.resolution = 0.4, .azimuths = 1.0, .rolls = 1.0}), "azimuths");
  EXPECT_REFUSED(compute({.resolution = 0.4}), "rolls");
  EXPECT_NO_THROW(compute({.resolution = 0.4, .rolls = 2.0}));
}

/// PlacementOptions::blocked_by of a model.
std::function<BlockedAtMount(const Pose&)> at_mounts(const CollisionModel& model) {
  return [&model](const Pose& world_T_mount) {
    const auto there = std::make_shared<CollisionModel>(with_mount(model, world_T_mount));
    return BlockedAtMount{
        .configuration = [there](const ConfigurationRef& q) { return blocked_by(*there, q); },
        .motions = blocked_motions(there)};
  };
}

ReachMap coarse_map(const Arm& arm) {
  const ReachGrid grid(arm, {.resolution = arm.reach().radius / 4, .directions = 90 * deg});
  return {{arm, grid, 4}, reach_cells(arm, grid, 0, grid.positions(), {.redundant_values = 4})};
}

// By models that are made for each mount alone.
TEST(PlacementInScene, IsFreeAndTheOthersAreNot) {
  Random random;
  std::int64_t free = 0, blocked = 0;
  for (const char* name : {"puma560", "ur5"}) {
    const ReachMap map = coarse_map(built_in(name));
    for (int i = 0; i < cases(10); ++i) {
      const Cell cell(random, name);
      std::vector<Pose> poses;
      for (int k = 0; k < 2; ++k) {
        poses.push_back(forward_kinematics(cell.arm, random.configuration(cell.arm)));
      }
      PlacementOptions options{.lower = Vector3(-0.5, -0.5, 0),
                               .upper = Vector3(0.5, 0.5, 0),
                               .headings = 1,
                               .count = 1000};
      const PlacementResult all = find_placements(map, poses, options);
      options.blocked_by = at_mounts(cell.model);
      const PlacementResult result = find_placements(map, poses, options);
      options.threads = 1;
      const PlacementResult again = find_placements(map, poses, options);
      EXPECT_EQ(result.blocked_reason, again.blocked_reason);
      ASSERT_EQ(result.placements.size(), again.placements.size());
      EXPECT_EQ(result.reaching, all.reaching);
      EXPECT_EQ(result.blocked + std::ssize(result.placements), result.reaching);
      EXPECT_EQ(result.blocked > 0, static_cast<bool>(result.blocked_reason));
      EXPECT_EQ(result.placements.empty(), static_cast<bool>(reason_of(result)));
      for (const Placement& one : all.placements) {
        const Arm mounted = with_mount(cell.arm, one.world_T_mount);
        const CollisionModel model(mounted, spheres_of(mounted), cell.scene, options_of(mounted));
        bool has_free = true;
        for (const Pose& pose : poses) {
          has_free =
              has_free &&
              inverse_kinematics(mounted, pose,
                                 {.all = true, .blocked_by = [&model](const ConfigurationRef& q) {
                                    return blocked_by(model, q);
                                  }});
        }
        const auto found = std::find_if(
            result.placements.begin(), result.placements.end(), [&](const Placement& other) {
              return other.world_T_mount.matrix() == one.world_T_mount.matrix();
            });
        EXPECT_EQ(found != result.placements.end(), has_free);
        (has_free ? free : blocked) += 1;
        if (found == result.placements.end()) continue;
        for (std::size_t k = 0; k < poses.size(); ++k) {
          const Configuration& q = found->solutions[k];
          EXPECT_TRUE(pairs_too_close(model, q).empty());
          EXPECT_LT((forward_kinematics(mounted, q).matrix() - poses[k].matrix()).norm(), 1e-6);
        }
      }
    }
  }
  const int least = testing::slow_build ? 0 : 1;  // few cases may have none
  EXPECT_GE(free, least);
  EXPECT_GE(blocked, least);
}

TEST(PlacementInScene, MovesInLinesThatAreClear) {
  const Arm arm = built_in("ur5");
  const ReachMap map = coarse_map(arm);
  Configuration q(6);
  q << 0.2, -1.2, 1.6, -1.9, -1.5, 0.3;
  std::vector<Pose> poses{forward_kinematics(arm, q), forward_kinematics(arm, q)};
  poses[1].translation() += Vector3(0.05, 0.2, 0.05);
  const Vector3 half_way = (poses[0].translation() + poses[1].translation()) / 2;
  PlacementOptions options{
      .lower = Vector3::Zero(), .upper = Vector3::Zero(), .headings = 1, .lines = true};
  ASSERT_TRUE(find_placements(map, poses, options));
  const CollisionOptions keep{.clearance = 0.001, .self_collision = false};
  const std::vector<LinkShapes> tip{{.name = "tip", .link = 6, .shapes = {{.body = Sphere{0.01}}}}};
  const CollisionModel beside(arm, tip, box_at(half_way + Vector3(0, 0, 0.5), 0.02), keep);
  options.blocked_by = at_mounts(beside);
  EXPECT_TRUE(find_placements(map, poses, options));
  const CollisionModel across(arm, tip, box_at(half_way, 0.02), keep);
  options.blocked_by = at_mounts(across);
  const PlacementResult refused = find_placements(map, poses, options);
  EXPECT_FALSE(refused);
  EXPECT_EQ(refused.blocked, 0);
  EXPECT_EQ(refused.without_lines, 1);
  EXPECT_EQ(refused.blocked_lines, 1);
}

TEST(PlacementInScene, SearchesAFreeSolutionOfAnArmWithoutClosedForm) {
  const Arm arm = arm_from_joint_string("RRRRR:1,1,1,1,1");
  const ReachGrid grid(arm, {.resolution = 1.25, .directions = 60 * deg});
  const ReachMap map({arm, grid}, reach_cells(arm, grid, 0, grid.positions()));
  const std::vector<Pose> poses{to_space({2.5, 0, 0})};
  PlacementOptions options{.lower = Vector3::Zero(), .upper = Vector3::Zero(), .headings = 1};
  const PlacementResult all = find_placements(map, poses, options);
  ASSERT_TRUE(all);
  const Configuration found = all.placements[0].solutions[0];
  options.blocked_by = [&](const Pose&) -> BlockedAtMount {
    return {.configuration = [&](const ConfigurationRef& q) {
      return (q - found).norm() < 0.5 ? Reason{ReasonCode::bodies_too_close} : Reason{};
    }};
  };
  const PlacementResult free = find_placements(map, poses, options);
  ASSERT_TRUE(free);
  EXPECT_GE((free.placements[0].solutions[0] - found).norm(), 0.5);
}

TEST(PlacementInScene, RefusesAMapOfAScene) {
  const Cell cell("ur5", box_at(Vector3(0.5, 0, 0), 0.1));
  const ReachGrid grid = grid_of(cell.arm);
  const ReachOptions options = cell.options();
  const ReachMap map({cell.arm, grid, 4, 0, options.scene},
                     reach_cells(cell.arm, grid, 0, grid.positions(), options));
  const std::vector<Pose> poses{Pose::Identity()};
  EXPECT_REFUSED(find_placements(map, poses), "scene");
}

}  // namespace
}  // namespace beeline
