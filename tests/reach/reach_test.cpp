#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/manipulability.h>
#include <beeline/model/catalog.h>
#include <beeline/reach/internal/turning_joint.h>
#include <beeline/reach/reach.h>

#include "tests/degrees.h"
#include "tests/random.h"
#include "tests/refusal.h"

namespace beeline {
namespace {

using testing::cases;
using testing::deg;
using testing::Random;

/// The least margin of the coordinates from 0 to `joints` - 1.
double margin_of(const Arm& arm, const Configuration& q, int joints) {
  double least = 1;
  for (int k = 0; k < joints; ++k) {
    least = std::min(least, limit_margin(q[k], arm.limits(k).lower, arm.limits(k).upper));
  }
  return least;
}

/// The solutions of a pose. Nothing explains why there is none, which takes most of the time.
std::vector<Configuration> solutions_of(const Arm& arm, const Pose& pose, bool all) {
  Eigen::MatrixXd columns(arm.dof(), 256);
  const int count = inverse_kinematics(arm, pose, middle_configuration(arm), columns, {.all = all});
  std::vector<Configuration> solutions;
  for (int i = 0; i < count; ++i) solutions.emplace_back(columns.col(i));
  return solutions;
}

/// Expects of a cell all solutions that the inverse kinematics gives at its centre.
void expect_all_solutions(const Arm& arm, const ReachGrid& grid, Eigen::Index cell,
                          const ReachCells& cells, Eigen::Index index) {
  const auto solutions = solutions_of(arm, grid.pose(cell), true);
  ASSERT_EQ(cells.branches[index], solutions.size()) << arm.name() << " cell " << cell;
  double manipulability = 0, margin = 0;
  for (const Configuration& q : solutions) {
    const auto measures = manipulability_measures(task_jacobian(arm, q, default_task(arm)));
    manipulability = std::max(manipulability, measures.manipulability);
    margin = std::max(margin, margin_of(arm, q, arm.dof()));
  }
  if (solutions.empty()) {
    EXPECT_TRUE(std::isnan(cells.manipulability[index]));
    EXPECT_TRUE(std::isnan(cells.margin[index]));
    return;
  }
  EXPECT_NEAR(cells.manipulability[index], manipulability, 1e-6);
  EXPECT_NEAR(cells.margin[index], margin, 1e-6);
}

/// Expects of the cells of positions what the inverse kinematics gives at their centres.
void expect_solutions_at(const Arm& arm, const ReachGrid& grid, Eigen::Index first,
                         Eigen::Index last) {
  const ReachCells cells = reach_cells(arm, grid, first, last);
  ASSERT_EQ(std::ssize(cells.branches), (last - first) * grid.directions() * grid.rolls());
  const Eigen::Index at_position = grid.directions() * grid.rolls();
  for (Eigen::Index k = 0; k < (last - first) * at_position; ++k) {
    expect_all_solutions(arm, grid, first * at_position + k, cells, k);
  }
}

TEST(Reach, ACellHasTheSolutionsOfItsCentre) {
  Random random;
  for (const char* name : {"puma560", "ur5", "stanford", "rrr", "kr6_r900"}) {
    const Arm arm = built_in(name);
    const ReachGridOptions options =
        arm.planar() ? ReachGridOptions{}
                     : ReachGridOptions{.directions = 60 * deg, .rolls = 70 * deg};
    const ReachGrid grid(arm, options);
    for (int i = 0; i < cases(8); ++i) {
      const auto p = static_cast<Eigen::Index>(random.uniform(0, 1) *
                                               static_cast<double>(grid.positions() - 1));
      expect_solutions_at(arm, grid, p, p + 1);
    }
  }
}

// With the last joint free, each roll is an interval test of its value, with narrow limits too.
TEST(Reach, RollsByTheLastJointAreThoseOfTheirCentres) {
  Random random;
  for (const char* name : {"puma560", "ur5"}) {
    for (const double upper : {0.3, 2.0, 3.3, 9.0}) {
      Arm arm = built_in(name);
      const std::string last = arm.joints().back().name;
      arm = with_limits(arm, {{last, {.lower = -0.7, .upper = upper}}});
      ASSERT_TRUE(internal::roll_joint(arm));
      const double step = (testing::slow_build ? 70 : 23) * deg;
      const ReachGrid grid(arm, {.directions = 80 * deg, .rolls = step});
      for (int i = 0; i < cases(2); ++i) {
        const auto p = static_cast<Eigen::Index>(random.uniform(0.3, 0.7) *
                                                 static_cast<double>(grid.positions() - 1));
        expect_solutions_at(arm, grid, p, p + 1);
      }
    }
  }
}

// With the first joint free, each azimuth is an interval test of its value; so is each roll, but
// with a tool beside the last axis.
TEST(Reach, AzimuthsByTheFirstJointAreThoseOfTheirCentres) {
  Random random;
  Pose beside = Pose::Identity();
  beside.translation().x() = 0.1;
  const Pose mount(Eigen::Translation3d(1, 2, 0.3) * Eigen::AngleAxisd(2, Vector3::UnitZ()));
  for (const char* name : {"puma560", "ur5", "stanford"}) {
    for (const double upper : {0.4, 2.9, 7.0}) {
      Arm arm = with_mount(built_in(name), mount);
      arm = with_limits(arm, {{arm.joints()[0].name, {.lower = -1.1, .upper = upper}}});
      if (upper > 1) arm = with_tool(arm, arm.tool() * beside);
      ASSERT_EQ(internal::roll_joint(arm).has_value(), upper < 1);
      const double coarse = testing::slow_build ? 2 : 1;
      const ReachGrid grid(
          arm, {.azimuths = coarse * 40 * deg, .directions = 80 * deg, .rolls = coarse * 60 * deg});
      for (int i = 0; i < cases(1); ++i) {
        // Not all azimuths of a radius and height.
        const auto first = static_cast<Eigen::Index>(random.uniform(0.2, 0.7) *
                                                     static_cast<double>(grid.positions()));
        expect_solutions_at(arm, grid, first, first + (testing::slow_build ? 1 : 4));
      }
    }
  }
  const Arm planar = with_limits(built_in("rrr"), {{"joint1", {.lower = -1, .upper = 0.5}}});
  const ReachGrid headings(planar, {.resolution = 2.0, .azimuths = 20 * deg});
  expect_solutions_at(planar, headings, 0, headings.positions());
}

// The forearm and the tool in line, vertical: infinitely many solutions, the first and last joints'
// values of one of which say nothing of the others.
TEST(Reach, SingularCellsAreThoseOfTheirCentres) {
  const Arm arm = with_limits(built_in("puma560"), {{"joint6", {.lower = -0.4, .upper = 0.3}}});
  const Pose straight =
      forward_kinematics(arm, {0, 40 * deg, -40 * deg, 0, 0, 0});  // joints 4 and 6 in line
  ASSERT_NEAR(std::abs(straight(2, 2)), 1, 1e-12);
  const double step = 0.05;
  const Vector3 corner(straight.translation().head<2>().norm() - step / 2,
                       straight.translation().z() - step / 2, 0);
  const ReachGrid grid(arm, {.resolution = step,
                             .lower = corner,
                             .upper = corner + Vector3(step / 2, step / 2, 0),
                             .azimuths = 30 * deg,
                             .directions = 90 * deg,
                             .rolls = (testing::slow_build ? 60 : 20) * deg});
  ASSERT_EQ(grid.positions(), grid.azimuths());
  const ReachCells cells = reach_cells(arm, grid, 0, grid.positions());
  int reached = 0, singular = 0;
  for (Eigen::Index cell = 0; cell < grid.cells(); ++cell) {
    const bool solved = !solutions_of(arm, grid.pose(cell), false).empty();
    EXPECT_EQ(cells.branches[cell] > 0, solved) << "cell " << cell;
    reached += solved;
    singular += inverse_kinematics(arm, grid.pose(cell), {.all = true}).singular;
  }
  EXPECT_GT(reached, 0);
  EXPECT_LT(reached, grid.cells());
  EXPECT_GT(singular, 0);
}

TEST(Reach, ADirectionIsReachedIfItIsWithSomeRoll) {
  Random random;
  for (const char* name : {"puma560", "ur5", "panda"}) {
    const Arm arm = built_in(name);
    const ReachGrid directions(arm, {.resolution = 0.1, .directions = 60 * deg});
    const ReachGrid rolls(arm, {.resolution = 0.1, .directions = 60 * deg, .rolls = 10 * deg});
    int reached = 0;
    for (int i = 0; i < cases(40); ++i) {
      const auto p = static_cast<Eigen::Index>(random.uniform(0.2, 0.8) *
                                               static_cast<double>(rolls.positions() - 1));
      const ReachCells any = reach_cells(arm, directions, p, p + 1);
      const ReachCells each = reach_cells(arm, rolls, p, p + 1);
      for (Eigen::Index d = 0; d < directions.directions(); ++d) {
        const auto first = each.branches.begin() + d * rolls.rolls();
        EXPECT_EQ(any.branches[d] > 0, *std::max_element(first, first + rolls.rolls()) > 0)
            << name << " position " << p << " direction " << d;
        reached += any.branches[d] > 0;
      }
    }
    EXPECT_GT(reached, 0);
  }
}

TEST(Reach, ACellOfARedundantArmIsReachedWhereItHasASolution) {
  Random random;
  for (const char* name : {"panda", "iiwa14", "gen3"}) {
    const Arm arm = built_in(name);
    const ReachGrid grid(arm, {.directions = 60 * deg, .rolls = 90 * deg});
    int reached = 0;
    for (int i = 0; i < cases(4); ++i) {
      const Pose world_T_tool = forward_kinematics(arm, random.configuration(arm));
      const Eigen::Index p = grid.position_of(world_T_tool.translation()).value();
      const ReachCells cells = reach_cells(arm, grid, p, p + 1);
      for (Eigen::Index k = 0; k < std::ssize(cells.branches); ++k) {
        const Eigen::Index cell = p * grid.directions() * grid.rolls() + k;
        const bool solved = !solutions_of(arm, grid.pose(cell), false).empty();
        EXPECT_EQ(cells.branches[k] > 0, solved) << name << " cell " << cell;
        reached += solved;
      }
    }
    EXPECT_GT(reached, 0);
  }
}

TEST(Reach, DoesNotDependOnThreadsOrRanges) {
  const Arm arm = built_in("ur5");
  const ReachGrid grid(arm, {.resolution = testing::slow_build ? 0.7 : 0.4});
  const ReachCells all = reach_cells(arm, grid, 0, grid.positions(), {.threads = 1});
  const ReachCells threads = reach_cells(arm, grid, 0, grid.positions(), {.threads = 4});
  const auto same = [](const auto& a, const auto& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](float x, float y) { return x == y || (std::isnan(x) && std::isnan(y)); });
  };
  EXPECT_EQ(all.branches, threads.branches);
  EXPECT_TRUE(same(all.manipulability, threads.manipulability));
  EXPECT_TRUE(same(all.margin, threads.margin));
  const Eigen::Index half = grid.positions() / 2;
  ReachCells parts = reach_cells(arm, grid, 0, half);
  const ReachCells rest = reach_cells(arm, grid, half, grid.positions());
  parts.branches.insert(parts.branches.end(), rest.branches.begin(), rest.branches.end());
  EXPECT_EQ(all.branches, parts.branches);
}

TEST(Reach, TheSummaryOfAPositionIsTheBestOfItsCells) {
  const Arm arm = built_in("puma560");
  const ReachGrid grid(arm, {.resolution = 0.3, .directions = 45 * deg, .rolls = 1.5});
  const ReachCells cells = reach_cells(arm, grid, 0, grid.positions());
  const ReachPositions best = reach_positions(grid, cells);
  ASSERT_EQ(best.directions.size(), grid.positions());
  const auto at_position = static_cast<std::size_t>(grid.directions() * grid.rolls());
  for (std::size_t p = 0; p < best.directions.size(); ++p) {
    const auto first = cells.branches.begin() + static_cast<std::ptrdiff_t>(p * at_position);
    EXPECT_EQ(best.branches[p],
              *std::max_element(first, first + static_cast<std::ptrdiff_t>(at_position)));
    EXPECT_EQ(best.branches[p] > 0, best.directions[p] > 0);
    EXPECT_EQ(best.branches[p] > 0, !std::isnan(best.margin[p]));
    EXPECT_LE(best.directions[p], 1.000001);
  }
  EXPECT_GT(*std::max_element(best.directions.begin(), best.directions.end()), 0.5);
}

TEST(Reach, EndsWithItsBudget) {
  const Arm arm = built_in("ur5");
  const ReachGrid grid(arm);
  const ReachCells cells =
      reach_cells(arm, grid, 0, grid.positions(), {.budget = {.max_work = 3000}});
  EXPECT_EQ(cells.ending, Ending::work_limit);
}

TEST(Reach, RefusesWhatHasNoMap) {
  const Arm arm = built_in("px150");
  EXPECT_REFUSED(reach_cells(arm, ReachGrid(arm), 0, 1), "5 joints");
  const Arm ur5 = built_in("ur5");
  Pose beside = Pose::Identity();
  beside.translation().x() = 0.1;
  const Arm tool = with_tcp(ur5, beside);
  EXPECT_REFUSED(reach_cells(tool, ReachGrid(tool), 0, 1), "the angle between rolls");
  EXPECT_REFUSED(reach_cells(ur5, ReachGrid(ur5), 0, 1, {.redundant_values = 0}), "1 to 1000");
  EXPECT_REFUSED(reach_cells(ur5, ReachGrid(ur5), 5, 4), "positions 5 to 4");
  const Arm panda = built_in("panda");
  EXPECT_REFUSED(reach_cells(panda, ReachGrid(panda, {.azimuths = 1.0}), 0, 1), "without azimuths");
}

}  // namespace
}  // namespace beeline
