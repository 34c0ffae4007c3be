// Checks that `all solutions` is complete: an exhaustive numerical search from random starts, which
// shares no code with Beeline, looks for missed solutions. Exit code 1 if it finds one.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include <beeline/error.h>

#include "beeline_case.h"
#include "search.h"
#include "timing.h"

namespace beeline::bench {
namespace {

struct Run {
  std::vector<std::string> arms;
  int count = 1000;
  std::uint64_t seed = 20240301;
  SearchEffort effort;
};

struct Tally {
  int poses_missed = 0;
  int missed = 0, searched = 0, given = 0, most = 0;
  int beyond = 0;  ///< solutions of Beeline that the search did not find
};

void print(const Configuration& q) {
  for (const double value : q) std::printf(" %.9f", value);
}

Tally compare(const Run& run, const BenchArm& arm) {
  constexpr double same = 1e-4;
  const Screws screws = screws_of(arm);
  BeelineCase solver(arm, CaseKind::all_solutions);
  const Configuration centre = middle(screws);
  Engine engine(run.seed);
  Tally tally;
  for (int n = 0; n < run.count; ++n) {
    const Configuration made_from = random_configuration(screws, engine);
    const Pose goal = forward(screws, made_from);
    std::vector<Configuration> given;
    const int count = solver.solve(goal, centre);
    for (int i = 0; i < count; ++i) given.push_back(solver.solution(i));
    std::vector<Configuration> searched = searched_solutions(screws, goal, run.effort, engine);
    searched.push_back(made_from);  // known without a search
    const auto has = [&](const std::vector<Configuration>& all, const Configuration& q) {
      return std::any_of(all.begin(), all.end(), [&](const Configuration& other) {
        return difference(screws, q, other) < same;
      });
    };
    if (has({searched.begin(), searched.end() - 1}, made_from)) searched.pop_back();
    int missed = 0;
    for (const Configuration& q : searched) {
      if (has(given, q)) continue;
      if (++missed == 1 && ++tally.poses_missed <= 3) {
        std::printf("  %s, pose %d of q", arm.name.c_str(), n);
        print(made_from);
        std::printf(": missed");
        print(q);
        std::printf("\n");
      }
    }
    for (const Configuration& q : given) tally.beyond += has(searched, q) ? 0 : 1;
    tally.missed += missed;
    tally.searched += static_cast<int>(searched.size());
    tally.given += count;
    tally.most = std::max(tally.most, count);
  }
  return tally;
}

bool complete(const Run& run, const std::string& name) {
  const Tally tally = compare(run, bench_arm(name));
  const double poses = run.count;
  std::printf("| %s | %d | %d | %d | %.3f | %.3f | %d | %d |\n", name.c_str(), run.count,
              tally.missed, tally.poses_missed, tally.given / poses, tally.searched / poses,
              tally.most, tally.beyond);
  std::fflush(stdout);
  // If the search misses Beeline's solutions, finding no others proves nothing.
  return tally.missed == 0 && tally.beyond <= tally.given / 100;
}

}  // namespace
}  // namespace beeline::bench

int main(int argc, char** argv) {
  using namespace beeline::bench;
  CLI::App app("Looks for solutions that Beeline's closed form missed");
  Run run;
  app.add_option("arms", run.arms, "arms of which six joints move; all of them if none is named");
  app.add_option("--count", run.count, "poses an arm")->capture_default_str();
  app.add_option("--starts", run.effort.starts, "most random starts")->capture_default_str();
  app.add_option("--patience", run.effort.patience, "starts in a row without a new solution")
      ->capture_default_str();
  app.add_option("--random-seed", run.seed)->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    stay_on_one_core();
    if (run.arms.empty()) {
      for (const std::string& name : bench_arm_names()) {
        if (bench_arm(name).free() == 6) run.arms.push_back(name);
      }
    }
    std::printf("Random seed %llu, up to %d starts, ended by %d in vain\n\n",
                static_cast<unsigned long long>(run.seed), run.effort.starts, run.effort.patience);
    std::printf(
        "| arm | poses | missed | poses with a miss | Beeline, mean | search, mean | "
        "Beeline, most | not met by the search |\n|---|---|---|---|---|---|---|---|\n");
    bool all = true;
    for (const std::string& name : run.arms) all = complete(run, name) && all;
    return all ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_inverse_completeness: %s\n", error.what());
    return 2;
  }
}
