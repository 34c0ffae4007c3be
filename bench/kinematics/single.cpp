// Times single calls of Beeline, KDL and Pinocchio. Takes the options of Google Benchmark.

#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/jacobian.h>

#include "../inverse/poses.h"
#include "../inverse/timing.h"
#include "peers.h"

#include <benchmark/benchmark.h>

namespace beeline::bench {
namespace {

/// Cycles through more configurations than a branch predictor learns.
class Configurations {
 public:
  explicit Configurations(const Screws& screws) {
    Engine engine(20240501);
    for (int n = 0; n < 1024; ++n) all_.push_back(random_configuration(screws, engine));
  }
  const Configuration& next() { return all_[++place_ % all_.size()]; }

 private:
  std::vector<Configuration> all_;
  std::size_t place_ = 0;
};

struct Subject {
  Arm arm;
  Screws screws;
};

void add_beeline(const std::string& name, const Subject& subject) {
  benchmark::RegisterBenchmark(
      (name + "/forward/Beeline").c_str(), [subject](benchmark::State& state) {
        Configurations q(subject.screws);
        for (auto _ : state) benchmark::DoNotOptimize(forward_kinematics(subject.arm, q.next()));
      });
  benchmark::RegisterBenchmark(
      (name + "/jacobian/Beeline").c_str(), [subject](benchmark::State& state) {
        Configurations q(subject.screws);
        Jacobian columns(6, subject.arm.dof());
        for (auto _ : state) {
          benchmark::DoNotOptimize(jacobian(subject.arm, q.next(), columns));
          benchmark::DoNotOptimize(columns.data());
          benchmark::ClobberMemory();
        }
      });
}

void add_peer(const std::string& name, const Subject& subject,
              const std::shared_ptr<KinematicsPeer>& peer) {
  benchmark::RegisterBenchmark((name + "/forward/" + peer->name()).c_str(),
                               [subject, peer](benchmark::State& state) {
                                 Configurations q(subject.screws);
                                 for (auto _ : state)
                                   benchmark::DoNotOptimize(peer->forward(q.next()));
                               });
  benchmark::RegisterBenchmark((name + "/jacobian/" + peer->name()).c_str(),
                               [subject, peer](benchmark::State& state) {
                                 Configurations q(subject.screws);
                                 for (auto _ : state)
                                   benchmark::DoNotOptimize(peer->jacobian(q.next()));
                               });
}

}  // namespace
}  // namespace beeline::bench

int main(int argc, char** argv) {
  using namespace beeline::bench;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  stay_on_one_core();
  try {
    for (const char* name : {"puma560", "ur5", "panda", "iiwa14"}) {
      const BenchArm arm = bench_arm(name);
      const Subject subject{arm.arm, screws_of(arm)};
      add_beeline(name, subject);
      for (auto& peer : kinematics_peers(subject.screws)) add_peer(name, subject, std::move(peer));
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_kinematics: %s\n", error.what());
    return 2;
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
