#include <gtest/gtest.h>

#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/io/text/arm.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/manipulability.h>
#include <beeline/model/catalog.h>
#include <beeline/reach/reach.h>

#include "tests/degrees.h"
#include "tests/random.h"
#include "tests/refusal.h"

namespace beeline {
namespace {

using testing::deg;
using testing::Random;

/// Grids with each kind of orientations that can be sampled.
std::vector<ReachGridOptions> sampled_grids(const Arm& arm) {
  const double resolution = arm.reach().radius / 5;
  if (arm.planar()) return {{.resolution = resolution, .directions = 60 * deg}};
  return {{.resolution = resolution, .directions = 90 * deg},
          {.resolution = resolution, .directions = 90 * deg, .rolls = 120 * deg},
          {.resolution = resolution, .any_orientation = true}};
}

// Random configurations, which have nothing of the sequence that was sampled.
TEST(Sampling, CellsOfRandomConfigurationsAreReached) {
  Random random;
  for (const char* name : {"rrr", "px150", "scara", "puma560", "panda"}) {
    const Arm arm = built_in(name);
    for (const ReachGridOptions& options : sampled_grids(arm)) {
      const ReachGrid grid(arm, options);
      const ReachOptions sampling{.samples = testing::example_size(400'000)};
      const ReachCells cells = reach_cells(arm, grid, 0, grid.positions(), sampling);
      // What is seldom sampled may be missed.
      constexpr double missed_at_most = testing::slow_build ? 0.1 : 0.02;
      int missed = 0;
      constexpr int tries = 1000;
      for (int i = 0; i < tries; ++i) {
        const auto cell = grid.cell_of(forward_kinematics(arm, random.configuration(arm)));
        ASSERT_TRUE(cell) << name;
        missed += cells.branches[*cell] == 0;
      }
      EXPECT_LT(missed, missed_at_most * tries) << name << " with " << grid.cells() << " cells";
    }
  }
}

// A cell whose centre is reached is one in which some pose is; the converse does not hold.
TEST(Sampling, CellsWithReachedCentresAreReached) {
  const Arm arm = built_in("puma560");
  const ReachGrid grid(arm, {.resolution = 0.3, .directions = 90 * deg});
  const ReachCells centres = reach_cells(arm, grid, 0, grid.positions());
  const ReachCells sampled = reach_cells(arm, grid, 0, grid.positions(), {.samples = 1'000'000});
  int reached = 0, also = 0, more = 0;
  for (std::size_t k = 0; k < centres.branches.size(); ++k) {
    reached += centres.branches[k] > 0;
    also += centres.branches[k] > 0 && sampled.branches[k] > 0;
    more += sampled.branches[k] > 0;
    EXPECT_EQ(sampled.branches[k] > 0, !std::isnan(sampled.margin[k]));
  }
  EXPECT_GT(reached, 100);
  EXPECT_GE(also, reached * 999 / 1000);
  EXPECT_GT(more, reached);
}

/// A joint that turns prismatic joint b by its ratio, over several revolutions.
Arm winch() {
  Joint a, b, c;
  a.name = "a";
  b.name = "b";
  c.name = "c";
  a.screw = c.screw = (Twist() << 0, 0, 0, 0, 0, 1).finished();
  b.screw = (Twist() << 1, 0, 0, 0, 0, 0).finished();
  a.limits = {.lower = -25, .upper = 25};
  b.limits = {.lower = -1, .upper = 1};
  b.mimic = Mimic{.leader = "a", .multiplier = 0.03};
  c.limits = {.lower = -2, .upper = 2};
  c.offset.translation().x() = 0.5;
  Pose tool = Pose::Identity();
  tool.translation().x() = 0.5;
  return Arm("winch", {a, b, c}, tool);
}

/// The rows of which the manipulability of an arm is measured.
Task measured_rows(const Arm& arm) {
  if (arm.name() == "scara") return {{true, true, true, false, false, true}};
  if (arm.dof() >= default_task(arm).size()) return default_task(arm);
  return arm.planar() ? Task{{true, true, false, false, false, false}} : Task::position();
}

// Random configurations in a cell have no margin or manipulability that is larger by much.
TEST(Sampling, ValuesAreThoseOfConfigurationsInTheCell) {
  Random random;
  for (const Arm& arm : {built_in("puma560"), built_in("px150"), built_in("rrr"),
                         read_arm("RR:1,0.7"), built_in("scara"), winch()}) {
    const ReachGrid grid(arm, {.resolution = arm.reach().radius / 4, .any_orientation = true});
    const ReachCells cells = reach_cells(arm, grid, 0, grid.positions(), {.samples = 100'000});
    std::vector<float> margin(cells.margin.size(), -1), manipulability = margin;
    for (int i = 0; i < 20'000; ++i) {
      const Configuration q = random.configuration(arm);
      const auto cell = grid.cell_of(forward_kinematics(arm, q));
      ASSERT_TRUE(cell);
      double least = 1;
      for (int k = 0; k < arm.dof(); ++k) {
        least = std::min(least, limit_margin(q[k], arm.limits(k).lower, arm.limits(k).upper));
      }
      margin[*cell] = std::max(margin[*cell], static_cast<float>(least));
      const Eigen::MatrixXd j = task_jacobian(arm, q, measured_rows(arm));
      manipulability[*cell] = std::max(
          manipulability[*cell], static_cast<float>(manipulability_measures(j).manipulability));
    }
    const float most = *std::max_element(manipulability.begin(), manipulability.end());
    int missed = 0, compared = 0;
    for (std::size_t k = 0; k < margin.size(); ++k) {
      EXPECT_FALSE(cells.margin[k] > 1);
      if (margin[k] < 0) continue;
      ++compared;
      missed += !(cells.margin[k] > margin[k] - 0.15F) ||
                !(cells.manipulability[k] > manipulability[k] - 0.15F * most);
    }
    EXPECT_GT(most, 0) << arm.name();
    EXPECT_LT(missed, 1 + compared / 20) << arm.name() << " of " << compared;
  }
}

TEST(Sampling, DoesNotDependOnThreadsOrRanges) {
  const Arm arm = built_in("ur5");
  const ReachGrid grid(arm, {.resolution = 0.4, .directions = 60 * deg});
  const auto sampled = [&](Eigen::Index first, Eigen::Index last, int threads) {
    return reach_cells(arm, grid, first, last,
                       {.samples = testing::example_size(50'000), .threads = threads});
  };
  const ReachCells one = sampled(0, grid.positions(), 1), four = sampled(0, grid.positions(), 4);
  EXPECT_EQ(one.branches, four.branches);
  const auto same = [](float x, float y) { return x == y || (std::isnan(x) && std::isnan(y)); };
  EXPECT_TRUE(std::equal(one.manipulability.begin(), one.manipulability.end(),
                         four.manipulability.begin(), same));
  const Eigen::Index third = grid.positions() / 3;
  const ReachCells part = sampled(third, 2 * third, 2);
  EXPECT_TRUE(std::equal(part.branches.begin(), part.branches.end(),
                         one.branches.begin() + third * grid.directions()));
  EXPECT_TRUE(std::equal(part.margin.begin(), part.margin.end(),
                         one.margin.begin() + third * grid.directions(), same));
}

TEST(Sampling, RefusesWhatCannotBeSampled) {
  const Arm arm = built_in("ur5");
  const auto sampled = [](const Arm& of, const ReachGridOptions& options) {
    return reach_cells(of, ReachGrid(of, options), 0, 1, {.samples = 10});
  };
  EXPECT_REFUSED(sampled(arm, {.orientation = Rotation::Identity()}), "no sample has exactly");
  EXPECT_REFUSED(sampled(arm, {.azimuths = 1.0}), "leave out the azimuths");
  EXPECT_REFUSED(reach_cells(arm, ReachGrid(arm, {.any_orientation = true}), 0, 1),
                 "is one by sampling");
  EXPECT_REFUSED(reach_cells(arm, ReachGrid(arm), 0, 1, {.samples = -1}), "it can be 0 to 1e12");
  const Arm endless = with_limits(
      built_in("rp"),
      {{built_in("rp").joints()[1].name, {.lower = -Limits::none, .upper = Limits::none}}});
  EXPECT_REFUSED(
      sampled(endless, {.resolution = 1.0, .lower = Vector3(-2, -2, 0), .upper = Vector3(2, 2, 0)}),
      "no position limits");
  const Arm turning =
      with_limits(winch(), {{"a", {.lower = -Limits::none, .upper = Limits::none}},
                            {"b", {.lower = -Limits::none, .upper = Limits::none}}});
  EXPECT_REFUSED(
      sampled(turning,
              {.resolution = 1.0, .lower = Vector3(-2, -2, -1), .upper = Vector3(2, 2, 1)}),
      "others follow");
  const ReachCells cut = reach_cells(arm, ReachGrid(arm), 0, 1,
                                     {.samples = 1'000'000, .budget = {.max_work = 10'000}});
  EXPECT_EQ(cut.ending, Ending::work_limit);
}

}  // namespace
}  // namespace beeline
