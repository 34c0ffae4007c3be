// The functions of the page's module as native code. Usage: bench_web ARM Q... prints a JSON
// object: microseconds a call, the shortest of 20 rounds.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <vector>

#include <web/core/beeline.h>

namespace {

template <class Call>
double microseconds(const Call& call) {
  using Clock = std::chrono::steady_clock;
  constexpr int calls = 2000;
  double best = std::numeric_limits<double>::infinity();
  for (int round = 0; round < 20; ++round) {
    const Clock::time_point begin = Clock::now();
    for (int i = 0; i < calls; ++i) {
      if (call() < 0) {
        std::fprintf(stderr, "bench_web: %s\n", beeline_error());
        std::exit(1);
      }
    }
    const std::chrono::duration<double, std::micro> spent = Clock::now() - begin;
    best = std::min(best, spent.count() / calls);
  }
  return best;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "Usage: bench_web ARM Q...\n");
    return 2;
  }
  const int arm = beeline_arm(argv[1], nullptr, "", "");
  std::vector<double> q;
  for (int i = 2; i < argc; ++i) q.push_back(std::strtod(argv[i], nullptr));
  if (arm < 0 || beeline_arm_dof(arm) != static_cast<int>(q.size())) {
    std::fprintf(stderr, "bench_web: no such arm, or not its number of joint values\n");
    return 2;
  }
  const std::size_t links = static_cast<std::size_t>(beeline_arm_links(arm));
  std::vector<double> poses(16 * (links + 1)), columns(6 * q.size()), solution(q.size());
  const double forward = microseconds([&] { return beeline_forward(arm, q.data(), poses.data()); });
  const double jacobian =
      microseconds([&] { return beeline_jacobian(arm, q.data(), 0, columns.data()); });
  const double* const tool = poses.data() + 16 * links;
  const double inverse =
      microseconds([&] { return beeline_inverse(arm, tool, q.data(), 0, 1, solution.data()); });
  std::printf("{\"forward\": %.4f, \"jacobian\": %.4f, \"inverse\": %.4f}\n", forward, jacobian,
              inverse);
}
