// Finds paths from the start to the goal of the problems of MotionBenchMaker that keep a clearance,
// and proves them. Prints a table in Markdown, milliseconds of CPU: medians and 95th percentiles by
// kind of scene, and the problems that are not solved. Writes the problems with what was found as
// JSON lines, for other planners.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include <beeline/certificate/clearance.h>
#include <beeline/io/text/scene.h>
#include <beeline/planning/free_path.h>

#include "../inverse/timing.h"
#include "problems.h"

namespace beeline::bench {
namespace {

struct Options {
  std::string arm, problems, out;
  double clearance = 1e-3;
  unsigned seed = 1;
  int shortcuts = 100;
};

/// What is measured in the scenes of a kind.
struct Kind {
  std::vector<double> milliseconds, edges, lengths;
  int problems = 0, solved = 0, wrong = 0;
};

double at_fraction(std::vector<double> values, double fraction) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(fraction * static_cast<double>(values.size() - 1))];
}

void print(const std::string& name, const Kind& kind) {
  std::printf("| %s | %d of %d | %.2f | %.2f | %.0f | %.0f | %.2f |\n", name.c_str(), kind.solved,
              kind.problems, at_fraction(kind.milliseconds, 0.5),
              at_fraction(kind.milliseconds, 0.95), at_fraction(kind.edges, 0.5),
              at_fraction(kind.edges, 0.95), at_fraction(kind.lengths, 0.5));
}

/// Whether each straight motion of a path is proved at the usual resolution.
bool is_proved(const CollisionModel& model, const FreePath& path) {
  for (std::size_t k = 1; k < path.waypoints.size(); ++k) {
    const Edge edge{path.waypoints[k - 1], path.waypoints[k]};
    if (!prove_clearance(model, edge.motion(model.arm()))) return false;
  }
  return true;
}

std::vector<double> numbers_of(const Configuration& q) { return {q.begin(), q.end()}; }

nlohmann::json line_of(const Problem& problem, const FreePath& path, double milliseconds) {
  return {{"name", problem.name},
          {"scene", nlohmann::json::parse(scene_to_json(problem.scene))},
          {"start", numbers_of(*problem.start)},
          {"goal", numbers_of(problem.configurations.front())},
          {"solved", bool(path)},
          {"milliseconds", milliseconds},
          {"edges", path.edges},
          {"length", path.length}};
}

int run(const Options& options) {
  const ShapedArm arm = read_shaped_arm(options.arm);
  std::map<std::string, Kind> kinds;
  Kind all;
  std::ofstream file;
  if (!options.out.empty()) file.open(options.out);
  for (const Problem& problem : read_problems(options.problems, arm)) {
    const CollisionModel model(arm.arm, arm.links, problem.scene, {.clearance = options.clearance});
    FreePath path;
    const double before = cpu_microseconds();
    path = find_free_path(model, *problem.start, problem.configurations,
                          {.random_seed = options.seed, .shortcuts = options.shortcuts});
    const double took = 1e-3 * (cpu_microseconds() - before);
    if (file.is_open()) file << line_of(problem, path, took) << '\n';
    for (Kind* kind : {&kinds[problem.name.substr(0, problem.name.find('/'))], &all}) {
      ++kind->problems;
      if (!path) continue;
      ++kind->solved;
      kind->wrong += is_proved(model, path) ? 0 : 1;
      kind->milliseconds.push_back(took);
      kind->edges.push_back(static_cast<double>(path.edges));
      kind->lengths.push_back(path.length);
    }
    if (!path) std::printf("%s: %s\n", problem.name.c_str(), sentence(path.reason).c_str());
  }
  std::puts("| scenes | solved | ms, median | ms, 95 % | edges, median | edges, 95 % | length |");
  std::puts("|---|---|---|---|---|---|---|");
  for (const auto& [name, kind] : kinds) print(name, kind);
  print("all", all);
  std::printf("not proved anew: %d\n", all.wrong);
  return all.wrong == 0 ? 0 : 1;
}

}  // namespace
}  // namespace beeline::bench

int main(int argc, char** argv) {
  beeline::bench::Options options;
  CLI::App app;
  app.add_option("arm", options.arm, "URDF file")->required();
  app.add_option("problems", options.problems, "folder of MotionBenchMaker")->required();
  app.add_option("--out", options.out, "File of JSON lines");
  app.add_option("--clearance", options.clearance);
  app.add_option("--seed", options.seed);
  app.add_option("--shortcuts", options.shortcuts);
  CLI11_PARSE(app, argc, argv);
  return beeline::bench::run(options);
}
