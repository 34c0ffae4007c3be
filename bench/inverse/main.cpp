// Generates the poses of one arm, times Beeline and KDL on them, and writes both for peers.py and
// table.py: FOLDER/ARM/arm.json, *.f64 and native.jsonl.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>

#include <beeline/error.h>

#include "beeline_case.h"
#include "kdl_peer.h"
#include "poses.h"
#include "record.h"

namespace beeline::bench {
namespace {

struct Run {
  std::string arm;
  int count = 10000;
  int passes = 3;
  std::uint64_t seed = 20240229;
  std::filesystem::path folder = "build/bench";
};

std::string beeline_record(const Run& run, const BenchArm& arm, const Screws& screws,
                           const Poses& poses, const Case& question) {
  BeelineCase solver(arm, question.kind);
  const Configuration centre = middle(screws);
  const auto seed = [&](int i) -> const Configuration& {
    return question.near_seed() ? poses.near[i] : centre;
  };
  Check check(screws, question.limits);
  for (int i = 0; i < run.count; ++i) {
    const Pose& goal = poses.world_T_tool[i];
    check.begin_pose();
    const int found = solver.solve(goal, seed(i));
    for (int k = 0; k < found; ++k) check.add(goal, solver.solution(k));
    check.end_pose();
  }
  const Timing timing =
      timed(run.count, run.passes, [&](int i) { solver.solve(poses.world_T_tool[i], seed(i)); });
  return record(arm.name, question.name, "Beeline", timing, check);
}

/// KDL has no limits here: solutions outside them count as solved.
std::string kdl_record(const Run& run, const BenchArm& arm, const Screws& screws,
                       const Poses& poses, const Case& question) {
  KdlPeer solver(screws);
  const Configuration centre = middle(screws);
  Configuration q(screws.joints);
  const auto solve = [&](int i) {
    const auto n = static_cast<std::size_t>(i);
    return solver.solve(poses.world_T_tool[n], question.near_seed() ? poses.near[n] : centre, q);
  };
  Check check(screws, false);
  for (int i = 0; i < run.count; ++i) {
    check.begin_pose();
    if (solve(i)) check.add(poses.world_T_tool[i], q);
    check.end_pose();
  }
  return record(arm.name, question.name, "KDL LMA, one try", timed(run.count, run.passes, solve),
                check);
}

void measure(const Run& run) {
  const BenchArm arm = bench_arm(run.arm);
  const Screws screws = screws_of(arm);
  const Poses poses = random_poses(screws, run.count, run.seed);
  const std::filesystem::path folder = run.folder / arm.name;
  write_poses(folder, arm, screws, poses);
  std::ofstream out(folder / "native.jsonl");
  for (const Case& question : cases_of(arm)) {
    out << beeline_record(run, arm, screws, poses, question) << '\n' << std::flush;
    const bool asks_kdl =
        question.kind == CaseKind::numerical_free || question.kind == CaseKind::tracking;
    if (asks_kdl && KdlPeer::installed()) {
      out << kdl_record(run, arm, screws, poses, question) << '\n' << std::flush;
    }
  }
  if (!out) throw Error("cannot write " + (folder / "native.jsonl").string());
}

}  // namespace
}  // namespace beeline::bench

int main(int argc, char** argv) {
  using namespace beeline::bench;
  CLI::App app("Times inverse kinematics: Beeline and KDL on random poses of one arm");
  Run run;
  app.add_option("arm", run.arm, "one of the benchmark's arms")->required();
  app.add_option("--count", run.count, "poses")->capture_default_str();
  app.add_option("--passes", run.passes, "how often each is timed")->capture_default_str();
  app.add_option("--random-seed", run.seed, "of the poses")->capture_default_str();
  app.add_option("--folder", run.folder, "where poses and results go")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    const int core = stay_on_one_core();
    std::printf("%s: %d poses, random seed %llu, core %d, KDL %s\n", run.arm.c_str(), run.count,
                static_cast<unsigned long long>(run.seed), core,
                KdlPeer::installed() ? "1 try of LMA" : "left out: not installed");
    measure(run);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_inverse: %s\n", error.what());
    return 2;
  }
  return 0;
}
