// Times Beeline's batches and the single calls of KDL and Pinocchio, nanoseconds for each
// configuration (each_ns). `cached`: outputs fit the cache; `memory`: they do not.

#include <beeline/batch/batch.h>

#include "../inverse/poses.h"
#include "../inverse/timing.h"
#include "peers.h"

#include <benchmark/benchmark.h>

namespace beeline::bench {
namespace {

using Matrix = Eigen::MatrixXd;

Matrix configurations(const Screws& screws, int count) {
  Engine engine(20240502);
  Matrix q(screws.joints, count);
  for (int i = 0; i < count; ++i) q.col(i) = random_configuration(screws, engine);
  return q;
}

/// Nanoseconds for each configuration.
void count_each(benchmark::State& state, int count) {
  using benchmark::Counter;
  state.counters["each_ns"] =
      Counter(1e-9 * count, Counter::kIsIterationInvariantRate | Counter::kInvert);
}

template <class Call>
void add(const std::string& name, int count, const Call& call) {
  benchmark::RegisterBenchmark(name.c_str(), [count, call](benchmark::State& state) {
    for (auto _ : state) {
      call();
      benchmark::ClobberMemory();
    }
    count_each(state, count);
  });
}

void add_batches(const std::string& name, const Arm& arm, const Screws& screws, int count,
                 const std::string& where) {
  const auto q = std::make_shared<Matrix>(configurations(screws, count));
  const auto poses = std::make_shared<Matrix>(16, count);
  const auto columns = std::make_shared<Matrix>(6 * arm.dof(), count);
  for (const int threads : {1, 2}) {
    const BatchOptions options{.threads = threads};
    const std::string with = threads == 1 ? "" : " 2 threads";
    add(name + "/batch forward " + where + with + "/Beeline", count, [=] {
      batch_forward<double>(arm, *q, *poses, options);
      benchmark::DoNotOptimize(poses->data());
    });
    add(name + "/batch jacobian " + where + with + "/Beeline", count, [=] {
      batch_jacobian<double>(arm, *q, *columns, *poses, options);
      benchmark::DoNotOptimize(columns->data());
    });
    add(name + "/batch jacobian without poses " + where + with + "/Beeline", count, [=] {
      Matrix none(16, 0);
      batch_jacobian<double>(arm, *q, *columns, none, options);
      benchmark::DoNotOptimize(columns->data());
    });
  }
}

void add_peer(const std::string& name, const Screws& screws, const std::string& where,
              const std::shared_ptr<KinematicsPeer>& peer) {
  constexpr int count = 1024;
  const auto q = std::make_shared<Matrix>(configurations(screws, count));
  add(name + "/batch forward " + where + "/" + peer->name(), count, [=] {
    for (int i = 0; i < count; ++i) benchmark::DoNotOptimize(peer->forward(q->col(i)));
  });
  for (const char* without : {"", "without poses "}) {
    add(name + "/batch jacobian " + without + where + "/" + peer->name(), count, [=] {
      for (int i = 0; i < count; ++i) benchmark::DoNotOptimize(peer->jacobian(q->col(i)));
    });
  }
}

}  // namespace
}  // namespace beeline::bench

int main(int argc, char** argv) {
  using namespace beeline::bench;
  constexpr int cached = 1024, memory = 400'000;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  try {
    for (const char* name : {"puma560", "ur5", "panda", "iiwa14"}) {
      const BenchArm arm = bench_arm(name);
      const Screws screws = screws_of(arm);
      add_batches(name, arm.arm, screws, cached, "cached");
      add_batches(name, arm.arm, screws, memory, "memory");
      for (auto& peer : kinematics_peers(screws)) {
        const std::shared_ptr<KinematicsPeer> shared = std::move(peer);
        for (const char* where : {"cached", "memory"}) add_peer(name, screws, where, shared);
      }
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_batch: %s\n", error.what());
    return 2;
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
