// Times a certified line of half a metre and its parts: planning, proof, timing. The aim is 5 ms in
// total.
#include <beeline/certificate/verify.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/planning/branch.h>
#include <beeline/planning/move_along.h>

#include <benchmark/benchmark.h>

using namespace beeline;

namespace {

struct Case {
  Arm arm;
  Configuration start;
  std::vector<Pose> poses;
};

/// Half a metre with a rotation of 0.4 rad, from a configuration in the middle of the limits.
Case half_a_metre(bool panda) {
  const Arm arm = built_in(panda ? "panda" : "ur5");
  Configuration q(arm.dof());
  if (panda) {
    q << 0, -0.785, 0, -2.356, 0, 1.571, 0.785;
  } else {
    q << 0.2, -1.2, 1.5, -0.5, 1.2, 0;
  }
  const Pose from = forward_kinematics(arm, q);
  Pose to = from;
  to.translation() += 0.5 * Vector3(0.1, 0.45, -0.2).normalized();
  to.linear() = so3_exp(Vector3(0.1, -0.2, 0.33)) * from.linear();
  return {arm, q, {from, to}};
}

BranchOptions planning() { return {.task = Task::spatial(), .tolerance = {9e-5, 9e-5}}; }

void plan(benchmark::State& state, bool panda) {
  const Case line = half_a_metre(panda);
  for (auto _ : state) {
    benchmark::DoNotOptimize(plan_path(line.arm, {}, lines_through(line.poses), planning()));
  }
}

void whole(benchmark::State& state, bool panda, Profile profile) {
  const Case line = half_a_metre(panda);
  PathMotion motion;
  for (auto _ : state) motion = move_in_lines(line.arm, line.poses, {.profile = profile});
  if (motion.status != MotionStatus::reached) state.SkipWithError(sentence(motion.reason).c_str());
  if (motion.trajectory.size() == 0) return;
  state.counters["samples"] = static_cast<double>(motion.trajectory.size());
  state.counters["seconds"] = motion.trajectory.times.back();
}

void check(benchmark::State& state, bool panda) {
  const Case line = half_a_metre(panda);
  const PathMotion motion = move_in_lines(line.arm, line.poses, {.profile = Profile::quintic});
  for (auto _ : state) {
    benchmark::DoNotOptimize(verify(line.arm, motion.trajectory, line.poses));
  }
}

}  // namespace

int main(int argc, char** argv) {
  for (const bool panda : {true, false}) {
    const std::string arm = panda ? "panda/" : "ur5/";
    const auto add = [&](const std::string& what, const auto& work) {
      benchmark::RegisterBenchmark((arm + what).c_str(), work)->Unit(benchmark::kMillisecond);
    };
    add("plan", [panda](benchmark::State& state) { plan(state, panda); });
    add("check", [panda](benchmark::State& state) { check(state, panda); });
    for (const std::string& name : profile_names()) {
      const Profile profile = profile_named(name);
      if (profile == Profile::jerk && !panda) continue;  // it has no limits of jerk
      add("whole, profile " + name,
          [panda, profile](benchmark::State& state) { whole(state, panda, profile); });
    }
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
