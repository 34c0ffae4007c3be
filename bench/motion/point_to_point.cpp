// Times planning a motion of seven joints from rest to rest by Beeline and by Ruckig, where its
// sources are present (scripts/bench_peers.sh fetches them). Prints the difference of their
// durations first and fails when it exceeds rounding. Takes the options of Google Benchmark.

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <beeline/model/catalog.h>
#include <beeline/timing/point_to_point.h>

#include "../inverse/poses.h"
#include "../inverse/timing.h"

#include <benchmark/benchmark.h>

#ifdef BEELINE_BENCH_RUCKIG
#include <ruckig/ruckig.hpp>
#endif

namespace beeline::bench {
namespace {

constexpr std::size_t joints = 7;

/// Motions between configurations of the Panda within its limits; more than a branch predictor
/// learns.
struct Motions {
  Arm arm = built_in("panda");
  std::vector<Configuration> from, to;
  std::size_t place = 0;

  explicit Motions(double way) {
    Engine engine(20240501);
    for (int n = 0; n < 4096; ++n) {
      from.push_back(random_configuration(arm, engine));
      to.push_back(from.back() + way * (random_configuration(arm, engine) - from.back()));
    }
  }

  std::size_t next() { return place = (place + 1) % from.size(); }
};

void add_beeline(const std::string& name, double way, Synchronise synchronise) {
  benchmark::RegisterBenchmark((name + "/Beeline").c_str(), [=](benchmark::State& state) {
    Motions motions(way);
    PointToPoint motion;
    for (auto _ : state) {
      const std::size_t k = motions.next();
      point_to_point(motions.arm, motions.from[k], motions.to[k], motion, {synchronise});
      benchmark::DoNotOptimize(motion.curves.data());
      benchmark::ClobberMemory();
    }
  });
}

void add_beeline_states() {
  benchmark::RegisterBenchmark("panda/a state of the motion/Beeline", [](benchmark::State& state) {
    Motions motions(1);
    const PointToPoint motion = point_to_point(motions.arm, motions.from[0], motions.to[0]);
    Configuration q(motions.arm.dof()), v = q, a = q;
    for (auto _ : state) {
      const auto share = static_cast<double>(motions.next()) / 4096;
      at(motion, share * motion.duration, q, v, a);
      benchmark::DoNotOptimize(q.data());
      benchmark::ClobberMemory();
    }
  });
}

#ifdef BEELINE_BENCH_RUCKIG
ruckig::InputParameter<joints> ruckig_input(const Arm& arm) {
  ruckig::InputParameter<joints> input;
  for (std::size_t k = 0; k < joints; ++k) {
    input.max_velocity[k] = arm.limits(k).velocity;
    input.max_acceleration[k] = arm.limits(k).acceleration;
    input.max_jerk[k] = arm.limits(k).jerk;
  }
  return input;
}

void set_motion(ruckig::InputParameter<joints>& input, const Motions& motions, std::size_t k) {
  std::copy_n(motions.from[k].data(), joints, input.current_position.begin());
  std::copy_n(motions.to[k].data(), joints, input.target_position.begin());
}

void add_ruckig(const std::string& name, double way) {
  benchmark::RegisterBenchmark((name + "/Ruckig").c_str(), [=](benchmark::State& state) {
    Motions motions(way);
    ruckig::Ruckig<joints> planner;
    ruckig::InputParameter<joints> input = ruckig_input(motions.arm);
    ruckig::Trajectory<joints> trajectory;
    for (auto _ : state) {
      set_motion(input, motions, motions.next());
      benchmark::DoNotOptimize(planner.calculate(input, trajectory));
      benchmark::ClobberMemory();
    }
  });
}

void add_ruckig_states() {
  benchmark::RegisterBenchmark("panda/a state of the motion/Ruckig", [](benchmark::State& state) {
    Motions motions(1);
    ruckig::Ruckig<joints> planner;
    ruckig::InputParameter<joints> input = ruckig_input(motions.arm);
    ruckig::Trajectory<joints> trajectory;
    set_motion(input, motions, 0);
    planner.calculate(input, trajectory);
    std::array<double, joints> q, v, a;
    for (auto _ : state) {
      const auto share = static_cast<double>(motions.next()) / 4096;
      trajectory.at_time(share * trajectory.get_duration(), q, v, a);
      benchmark::DoNotOptimize(q.data());
      benchmark::ClobberMemory();
    }
  });
}

/// The durations agree, relative to one second or the duration.
bool same_durations() {
  double worst = 0;
  for (const double way : {1.0, 0.01}) {
    const Motions motions(way);
    ruckig::Ruckig<joints> planner;
    ruckig::InputParameter<joints> input = ruckig_input(motions.arm);
    ruckig::Trajectory<joints> trajectory;
    PointToPoint motion;
    for (std::size_t k = 0; k < motions.from.size(); ++k) {
      set_motion(input, motions, k);
      if (planner.calculate(input, trajectory) < 0) return false;
      point_to_point(motions.arm, motions.from[k], motions.to[k], motion);
      const double apart = std::abs(motion.duration - trajectory.get_duration());
      worst = std::max(worst, apart / std::max(1.0, motion.duration));
    }
  }
  std::fprintf(stderr, "durations, Beeline's less Ruckig's: at most %.1e\n", worst);
  return worst < 1e-6;
}
#else
void add_ruckig(const std::string&, double) {}
void add_ruckig_states() {}
bool same_durations() { return true; }
#endif

}  // namespace
}  // namespace beeline::bench

int main(int argc, char** argv) {
  using namespace beeline::bench;
  using beeline::Synchronise;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  stay_on_one_core();
  add_beeline("panda/far motion", 1, Synchronise::time);
  add_ruckig("panda/far motion", 1);
  add_beeline("panda/near motion", 0.01, Synchronise::time);
  add_ruckig("panda/near motion", 0.01);
  add_beeline("panda/far straight motion", 1, Synchronise::straight);
  add_beeline_states();
  add_ruckig_states();
  if (!same_durations()) return 1;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
