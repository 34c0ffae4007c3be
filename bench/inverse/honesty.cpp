// Checks every returned solution by forward kinematics that shares no code with Beeline, on random
// poses, half of them out of reach, nearly singular or at limits. Exit code 1 if one is wrong.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include <beeline/error.h>

#include "beeline_case.h"
#include "hard_poses.h"
#include "timing.h"

namespace beeline::bench {
namespace {

struct Run {
  std::vector<std::string> arms;
  long count = 1000000;
  int numerical_every = 10;
  std::uint64_t seed = 20240302;
};

struct Tally {
  long poses = 0, solutions = 0;
  long wrong = 0, outside = 0;
  long unsolved = 0;  ///< reachable poses without a solution
  double worst = 0;
};

class Judge {
 public:
  explicit Judge(const BenchArm& arm) : screws_(screws_of(arm)), centre_(middle(screws_)) {
    for (const Case& question : cases_of(arm)) {
      if (question.near_seed()) continue;
      questions_.push_back({question, BeelineCase(arm, question.kind)});
    }
  }

  const Screws& screws() const { return screws_; }

  void judge(const HardPose& pose, bool numerical, Tally& tally) {
    ++tally.poses;
    for (auto& [question, solver] : questions_) {
      const bool closed =
          question.kind == CaseKind::all_solutions || question.kind == CaseKind::within_limits;
      if (!closed && !numerical) continue;
      const int count = solver.solve(pose.world_T_tool, centre_);
      if (count == 0 && pose.reachable) ++tally.unsolved;
      for (int i = 0; i < count; ++i) add(question, pose.world_T_tool, solver.solution(i), tally);
    }
  }

 private:
  void add(const Case& question, const Pose& goal, const Configuration& q, Tally& tally) const {
    constexpr double tolerance = 1e-10;
    ++tally.solutions;
    const double error = miss(goal, forward(screws_, q));
    if (!(error <= tolerance)) ++tally.wrong;
    if (question.limits && !within_limits(screws_, q, 0)) ++tally.outside;
    if (!(error <= tally.worst)) tally.worst = error;
  }

  struct Asked {
    Case question;
    BeelineCase solver;
  };
  Screws screws_;
  Configuration centre_;
  std::vector<Asked> questions_;
};

/// Returns the kind of a pose; half of them are plain.
Hardness hardness_of(long n) {
  return n % 2 == 0 ? Hardness::plain : static_cast<Hardness>(1 + (n / 2) % 5);
}

bool honest(const Run& run, const std::string& name, long count) {
  const BenchArm arm = bench_arm(name);
  Judge judge(arm);
  Engine engine(run.seed);
  std::array<Tally, hardness_names.size()> tallies;
  for (long n = 0; n < count; ++n) {
    const Hardness hardness = hardness_of(n);
    const HardPose pose = hard_pose(arm, judge.screws(), hardness, engine);
    judge.judge(pose, (n / 2) % run.numerical_every == 0,
                tallies[static_cast<std::size_t>(hardness)]);
  }
  bool all = true;
  for (std::size_t i = 0; i < tallies.size(); ++i) {
    const Tally& t = tallies[i];
    std::printf("| %s | %s | %ld | %ld | %ld | %ld | %.1e | %ld |\n", name.c_str(),
                hardness_names[i], t.poses, t.solutions, t.wrong, t.outside, t.worst, t.unsolved);
    all = all && t.wrong == 0 && t.outside == 0;
  }
  std::fflush(stdout);
  return all;
}

}  // namespace
}  // namespace beeline::bench

int main(int argc, char** argv) {
  using namespace beeline::bench;
  CLI::App app("Looks for configurations that Beeline calls solutions and that are none");
  Run run;
  app.add_option("arms", run.arms, "all of them if none is named");
  app.add_option("--count", run.count, "poses over all arms")->capture_default_str();
  app.add_option("--numerical-every", run.numerical_every,
                 "of so many poses one is asked of the numerical solver too")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_option("--random-seed", run.seed)->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    stay_on_one_core();
    if (run.arms.empty()) run.arms = bench_arm_names();
    std::printf("Random seed %llu\n\n", static_cast<unsigned long long>(run.seed));
    std::printf(
        "| arm | kind of pose | poses | solutions | off by more than 1e-10 | outside "
        "limits | worst error | reachable, no solution |\n"
        "|---|---|---|---|---|---|---|---|\n");
    const long share = (run.count - 1) / static_cast<long>(run.arms.size()) + 1;
    bool all = true;
    for (const std::string& name : run.arms) all = honest(run, name, share) && all;
    return all ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_inverse_honesty: %s\n", error.what());
    return 2;
  }
}
