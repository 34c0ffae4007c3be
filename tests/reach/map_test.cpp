#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <thread>

#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/reach/internal/slabs.h>
#include <beeline/reach/reach.h>
#include <beeline/reach/reach_map.h>

#include "tests/degrees.h"
#include "tests/random.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace beeline {
namespace {

using testing::deg;
using testing::Random;

class ReachMapFile : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.file(name); }

  testing::TemporaryFolder folder_;
};

bool same(const std::vector<float>& a, const std::vector<float>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](float x, float y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

void expect_equal(const ReachCells& a, const ReachCells& b) {
  EXPECT_EQ(a.branches, b.branches);
  EXPECT_TRUE(same(a.manipulability, b.manipulability));
  EXPECT_TRUE(same(a.margin, b.margin));
}

void expect_equal(const ReachMap& a, const ReachMap& b) {
  expect_equal(a.cells(0, a.grid().positions()), b.cells(0, b.grid().positions()));
}

/// Maps of more than one slab.
struct Example {
  double resolution = 0.2;
  Arm arm = built_in("ur5");
  ReachGrid grid{arm, {.resolution = resolution, .directions = 45 * deg, .rolls = 40 * deg}};
};
/// Smaller under a sanitizer: each solution is tested for collision.
Example example_in_scene() { return {.resolution = testing::slow_build ? 0.3 : 0.2}; }
const ReachGridOptions by_azimuths{
    .resolution = 0.08, .azimuths = 60 * deg, .directions = 20 * deg, .rolls = 60 * deg};

TEST(Slabs, AreRangesThatCoverThePositions) {
  const Arm arm = built_in("puma560");
  for (const double resolution : {0.3, 0.05, 0.02}) {
    for (const double directions : {60 * deg, 10 * deg, 2 * deg}) {
      for (const std::optional<double> azimuths : {std::optional<double>{}, {20 * deg}}) {
        const ReachGrid grid(
            arm, {.resolution = resolution, .azimuths = azimuths, .directions = directions});
        const internal::Slabs slabs(grid);
        Eigen::Index next = 0;
        for (Eigen::Index s = 0; s < slabs.count(); ++s) {
          ASSERT_EQ(slabs.first(s), next);
          ASSERT_EQ(next % grid.azimuths(), 0);
          next = slabs.last(s);
          ASSERT_EQ(slabs.slab_of(slabs.first(s)), s);
          ASSERT_EQ(slabs.slab_of(next - 1), s);
        }
        EXPECT_EQ(next, grid.positions());
        EXPECT_LE((slabs.last(0) - slabs.first(0)) / grid.azimuths() * grid.directions(),
                  Eigen::Index{1} << (azimuths ? 18 : 22));
      }
    }
  }
}

TEST_F(ReachMapFile, ReadsBackWhatWasComputed) {
  for (const char* name : {"puma560", "rrr", "panda"}) {
    const Arm arm = built_in(name);
    const double coarse = testing::slow_build ? 1.4 : 1;
    std::vector<ReachGridOptions> all{{.resolution = coarse * 0.4, .directions = 60 * deg}};
    if (!arm.planar()) {
      all.push_back({.resolution = coarse * 0.4, .orientation = Random().rotation()});
      all.push_back({.resolution = coarse * 0.5, .directions = 60 * deg, .rolls = 2.0});
    }
    if (arm.dof() < 7) {
      all.push_back({.resolution = coarse * 0.5, .azimuths = 1.0, .directions = 60 * deg});
    }
    if (arm.dof() == 6) {
      all.push_back(
          {.resolution = coarse * 0.5, .azimuths = 1.0, .directions = 60 * deg, .rolls = 1.0});
    }
    for (const ReachGridOptions& options : all) {
      const ReachGrid grid(arm, options);
      const ReachMapOptions few{.reach = {.redundant_values = 2}};
      ASSERT_EQ(compute_reach_map(arm, grid, path("map.h5"), few), Ending::complete);
      const ReachMap map(path("map.h5"));
      EXPECT_EQ(map.arm().name(), name);
      EXPECT_EQ(map.grid().cells(), grid.cells());
      EXPECT_EQ(map.header().redundant_values, 2);
      for (const Eigen::Index cell : {Eigen::Index{0}, grid.cells() / 3, grid.cells() - 1}) {
        EXPECT_TRUE(map.grid().pose(cell).isApprox(grid.pose(cell), 1e-12));
      }
      const ReachCells expected = reach_cells(arm, grid, 0, grid.positions(), few.reach);
      expect_equal(map.cells(0, grid.positions()), expected);
      EXPECT_EQ(map.totals().reached,
                grid.cells() - std::count(expected.branches.begin(), expected.branches.end(), 0));
      EXPECT_FALSE(std::filesystem::exists(path("map.h5.parts")));
    }
  }
}

// More rolls than a word has bits.
TEST_F(ReachMapFile, CountsTheCellsOfManyRolls) {
  const Arm arm = with_limits(built_in("puma560"), {{"joint6", {.lower = -0.9, .upper = 1.7}}});
  const ReachGrid grid(
      arm,
      {.resolution = 0.5, .azimuths = 80 * deg, .directions = 90 * deg, .rolls = 360 * deg / 131});
  ASSERT_EQ(grid.rolls(), 131);
  compute_reach_map(arm, grid, path("map.h5"));
  const ReachMap map(path("map.h5"));
  const ReachCells cells = map.cells(0, grid.positions());
  const ReachMap::Totals totals = map.totals();
  EXPECT_EQ(totals.cells, grid.cells());
  EXPECT_EQ(totals.reached,
            grid.cells() - std::count(cells.branches.begin(), cells.branches.end(), 0));
  EXPECT_GT(totals.reached, 0);
}

// A file with singular cells: of infinitely many solutions it has one for each branch.
TEST_F(ReachMapFile, ReadsBackSingularCells) {
  const Arm arm = with_limits(built_in("puma560"), {{"joint6", {.lower = -0.4, .upper = 0.3}}});
  const Pose straight = forward_kinematics(arm, {0, 40 * deg, -40 * deg, 0, 0, 0});
  const Vector3 corner(straight.translation().head<2>().norm() - 0.05,
                       straight.translation().z() - 0.05, 0);
  const ReachGrid grid(arm, {.resolution = 0.1,
                             .lower = corner,
                             .upper = corner + Vector3(0.05, 0.05, 0),
                             .azimuths = 90 * deg,
                             .directions = 90 * deg,
                             .rolls = 45 * deg});
  compute_reach_map(arm, grid, path("map.h5"));
  const ReachCells expected = reach_cells(arm, grid, 0, grid.positions());
  int singular = 0;
  for (Eigen::Index cell = 0; cell < grid.cells(); ++cell) {
    singular += inverse_kinematics(arm, grid.pose(cell), {.all = true}).singular;
  }
  ASSERT_GT(singular, 0);
  const ReachMap map(path("map.h5"));
  expect_equal(map.cells(0, grid.positions()), expected);
  EXPECT_EQ(map.totals().reached,
            grid.cells() - std::count(expected.branches.begin(), expected.branches.end(), 0));
}

TEST_F(ReachMapFile, ShardsAndThreadsGiveTheSameDatasets) {
  for (const bool azimuths : {false, true}) {
    if (azimuths && testing::slow_build) continue;  // a minute under a sanitizer
    Example example;
    if (azimuths) example.grid = ReachGrid(example.arm, by_azimuths);
    compute_reach_map(example.arm, example.grid, path("whole.h5"), {.reach = {.threads = 1}});
    std::vector<std::string> parts;
    for (const int number : {3, 1, 2}) {
      parts.push_back(path("part" + std::to_string(number)));
      compute_reach_map(example.arm, example.grid, parts.back(),
                        {.reach = {.threads = number}, .shard = {number, 3}});
      EXPECT_FALSE(ReachMap(parts.back()).complete());
    }
    EXPECT_REFUSED(merge_reach_maps({parts[0], parts[1]}, path("merged.h5")), "the parts lack");
    EXPECT_FALSE(std::filesystem::exists(path("merged.h5")));
    merge_reach_maps(parts, path("merged.h5"));
    const ReachMap merged(path("merged.h5"));
    EXPECT_TRUE(merged.complete());
    ASSERT_GT(merged.slabs().size(), 3);
    expect_equal(merged, ReachMap(path("whole.h5")));
    std::filesystem::remove(path("merged.h5"));
  }
}

TEST_F(ReachMapFile, ThreadsReadOneFileAtOnce) {
  for (const bool azimuths : {false, true}) {
    if (azimuths && testing::slow_build) continue;  // a minute under a sanitizer
    Example example;
    if (azimuths) example.grid = ReachGrid(example.arm, by_azimuths);
    compute_reach_map(example.arm, example.grid, path("map.h5"));
    const ReachMap map(path("map.h5"));
    ASSERT_GT(map.slabs().size(), 2);
    const Eigen::Index positions = example.grid.positions(), count = 8;
    const ReachCells whole = map.cells(0, positions);
    std::vector<ReachCells> parts(count);
    std::vector<std::thread> threads;
    for (Eigen::Index k = 0; k < count; ++k) {
      threads.emplace_back(
          [&, k] { parts[k] = map.cells(positions * k / count, positions * (k + 1) / count); });
    }
    for (std::thread& thread : threads) thread.join();
    std::vector<std::uint8_t> branches;
    for (const ReachCells& part : parts) {
      branches.insert(branches.end(), part.branches.begin(), part.branches.end());
    }
    EXPECT_EQ(branches, whole.branches);
  }
}

// More cells than are sampled together.
TEST_F(ReachMapFile, ShardsOfSamplesGiveTheSameDatasets) {
  const Arm arm = built_in("rrr");
  // Sampling keeps so many cells in several parts; a sanitizer takes a minute for them.
  const double fine = testing::slow_build ? 0.06 : 0.018;
  const ReachGrid grid(arm, {.resolution = fine, .directions = 20 * deg});
  ASSERT_TRUE(testing::slow_build || grid.cells() > Eigen::Index{1} << 24);
  const int samples = testing::example_size(200'000);
  const ReachOptions sampling{.samples = samples};
  compute_reach_map(arm, grid, path("whole.h5"), {.reach = sampling});
  for (const int number : {1, 2}) {
    compute_reach_map(arm, grid, path("part" + std::to_string(number)),
                      {.reach = sampling, .shard = {number, 2}});
  }
  merge_reach_maps({path("part2"), path("part1")}, path("merged.h5"));
  const ReachMap merged(path("merged.h5")), whole(path("whole.h5"));
  EXPECT_EQ(merged.header().samples, samples);
  EXPECT_GT(whole.totals().reached, testing::example_size(10'000));
  expect_equal(merged, whole);
  compute_reach_map(arm, ReachGrid(arm), path("centres"));
  EXPECT_REFUSED(merge_reach_maps({path("part1"), path("centres")}, path("m.h5")), "another map");
}

TEST_F(ReachMapFile, SamplesCountOnceInTheBudget) {
  const Arm arm = built_in("ur5");
  const ReachGrid grid(arm, {.resolution = 0.5, .directions = 90 * deg});
  ReachMapOptions options{.reach = {.samples = 40'000, .threads = 1}};
  options.reach.budget.max_work = 40'000 + grid.cells();
  double last = 0;
  options.reach.budget.progress = [&last](double fraction) {
    EXPECT_GE(fraction, last);
    last = fraction;
  };
  EXPECT_EQ(compute_reach_map(arm, grid, path("map.h5"), options), Ending::complete);
  EXPECT_EQ(last, 1);
}

/// Solutions with the second joint above this value are blocked.
ReachOptions in_scene(double highest) {
  return {.blocked_by = [highest](const ConfigurationRef& q) -> Reason {
            return q[1] > highest ? Reason{ReasonCode::bodies_collide} : Reason{};
          },
          .scene = ReachScene{
              .digest = number(highest), .clearance = 0.25, .files = {"cell.json", "b \"c\"\n"}}};
}

TEST_F(ReachMapFile, OfASceneHasPartsOfThisSceneAlone) {
  const Example example = example_in_scene();
  const Arm& arm = example.arm;
  const ReachGrid& grid = example.grid;
  const ReachOptions cell = in_scene(-1), other = in_scene(-0.5);
  const ReachCells expected = reach_cells(arm, grid, 0, grid.positions(), cell);
  const ReachCells all = reach_cells(arm, grid, 0, grid.positions());
  EXPECT_NE(expected.branches, all.branches);
  compute_reach_map(arm, grid, path("part1"), {.reach = cell, .shard = {1, 2}});
  compute_reach_map(arm, grid, path("part2"), {.reach = cell, .shard = {2, 2}});
  compute_reach_map(arm, grid, path("other2"), {.reach = other, .shard = {2, 2}});
  compute_reach_map(arm, grid, path("all2"), {.shard = {2, 2}});
  EXPECT_REFUSED(merge_reach_maps({path("part1"), path("other2")}, path("m.h5")), "another map");
  EXPECT_REFUSED(merge_reach_maps({path("part1"), path("all2")}, path("m.h5")), "another map");
  EXPECT_REFUSED(merge_reach_maps({path("all2"), path("part1")}, path("m.h5")), "another map");
  merge_reach_maps({path("part1"), path("part2")}, path("whole.h5"));
  const ReachMap whole(path("whole.h5"));
  expect_equal(whole.cells(0, grid.positions()), expected);
  ASSERT_TRUE(whole.header().scene);
  EXPECT_EQ(whole.header().scene->digest, cell.scene->digest);
  EXPECT_EQ(whole.header().scene->clearance, 0.25);
  EXPECT_EQ(whole.header().scene->files, cell.scene->files);
  EXPECT_FALSE(ReachMap(path("all2")).header().scene);
}

TEST_F(ReachMapFile, OfASceneContinuesWhereItEnded) {
  const Example example = example_in_scene();
  ReachMapOptions options{.reach = in_scene(-1)};
  options.reach.budget.max_work = example.grid.cells() / 2;
  ASSERT_EQ(compute_reach_map(example.arm, example.grid, path("map.h5"), options),
            Ending::work_limit);
  EXPECT_REFUSED(compute_reach_map(example.arm, example.grid, path("map.h5")), "another map");
  EXPECT_REFUSED(
      compute_reach_map(example.arm, example.grid, path("map.h5"), {.reach = in_scene(-0.5)}),
      "another map");
  options.reach.budget = {};
  ASSERT_EQ(compute_reach_map(example.arm, example.grid, path("map.h5"), options),
            Ending::complete);
  const Eigen::Index positions = example.grid.positions();
  expect_equal(ReachMap(path("map.h5")).cells(0, positions),
               reach_cells(example.arm, example.grid, 0, positions, options.reach));
  options.reach.scene.reset();
  EXPECT_REFUSED(compute_reach_map(example.arm, example.grid, path("map.h5"), options), "scene");
}

TEST_F(ReachMapFile, ContinuesWhereItEnded) {
  const Example example;
  compute_reach_map(example.arm, example.grid, path("whole.h5"));
  const std::int64_t cells = example.grid.cells();
  ASSERT_EQ(compute_reach_map(example.arm, example.grid, path("map.h5"),
                              {.reach = {.budget = {.max_work = cells / 2}}}),
            Ending::work_limit);
  EXPECT_FALSE(std::filesystem::exists(path("map.h5")));
  // A slab that was cut off, and one with a wrong byte, are computed again.
  std::filesystem::resize_file(path("map.h5.parts/slab-0.h5"), 3000);
  std::string bytes = folder_.content("map.h5.parts/slab-1.h5");
  bytes[bytes.size() - 3000] ^= 1;
  folder_.write("map.h5.parts/slab-1.h5", bytes);
  double began = -1;
  ReachMapOptions rest{.reach = {.threads = 1}};
  rest.reach.budget.progress = [&began](double fraction) {
    if (began < 0) began = fraction;
  };
  ASSERT_EQ(compute_reach_map(example.arm, example.grid, path("map.h5"), rest), Ending::complete);
  expect_equal(ReachMap(path("map.h5")), ReachMap(path("whole.h5")));
  EXPECT_EQ(folder_.content("map.h5"), folder_.content("whole.h5"));
}

TEST_F(ReachMapFile, TheFolderOfAnotherMapIsRefused) {
  const Example example;
  ASSERT_EQ(compute_reach_map(example.arm, example.grid, path("map.h5"),
                              {.reach = {.budget = {.max_work = 1}}}),
            Ending::work_limit);
  const ReachGrid other(example.arm, {.resolution = 0.3});
  EXPECT_REFUSED(compute_reach_map(example.arm, other, path("map.h5")),
                 "its resolution is 0.2 m, not 0.3");
  const ReachMapOptions shard{.shard = {4, 3}};
  EXPECT_REFUSED(compute_reach_map(example.arm, other, path("x.h5"), shard), "shard 4 of 3");
  EXPECT_FALSE(std::filesystem::exists(path("x.h5.parts")));
}

// Whatever is in a file, it is read, or refused with an error.
TEST_F(ReachMapFile, DamagedFilesAreRefused) {
  const Arm arm = built_in("puma560");
  std::vector<std::string> files;
  for (const std::optional<double> azimuths : {std::optional<double>{}, {90 * deg}}) {
    const ReachGridOptions coarse{.resolution = 0.5, .azimuths = azimuths, .directions = 90 * deg};
    compute_reach_map(arm, ReachGrid(arm, coarse), path("map.h5"));
    files.push_back(folder_.content("map.h5"));
  }
  Random random;
  int refused = 0;
  for (int i = 0; i < testing::cases(300); ++i) {
    const std::string& whole = files[i % 2];
    std::string bytes = whole;
    if (i % 3 == 0) {
      bytes.resize(static_cast<std::size_t>(random.integer(0, static_cast<int>(whole.size()) - 1)));
    } else {
      bytes[static_cast<std::size_t>(random.integer(0, static_cast<int>(whole.size()) - 1))] ^=
          static_cast<char>(1 << random.integer(0, 7));
    }
    folder_.write("bad.h5", bytes);
    try {
      const ReachMap map(path("bad.h5"));
      (void)map.cells(0, map.grid().positions());
    } catch (const Error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 0);
  EXPECT_REFUSED(ReachMap(path("none.h5")), "No such file");
}

TEST_F(ReachMapFile, IsTheMapInMemory) {
  const Arm arm = built_in("ur5");
  const ReachGrid grid(arm, {.resolution = 0.25});
  compute_reach_map(arm, grid, path("map.h5"));
  const ReachMap file(path("map.h5"));
  const ReachMap memory({arm, grid}, reach_cells(arm, grid, 0, grid.positions()));
  const Eigen::Index third = grid.positions() / 3;
  expect_equal(file.cells(third, 2 * third), memory.cells(third, 2 * third));
  EXPECT_EQ(file.totals().reached, memory.totals().reached);
  EXPECT_TRUE(memory.complete());
  EXPECT_EQ(memory.path(), "");
  EXPECT_REFUSED(ReachMap({arm, grid}, reach_cells(arm, grid, 0, 1)), "the map has");
  const ReachCells cut = reach_cells(arm, grid, 0, grid.positions(), {.budget = {.max_work = 9}});
  EXPECT_REFUSED(ReachMap({arm, grid}, cut), "to the end");
}

}  // namespace
}  // namespace beeline
