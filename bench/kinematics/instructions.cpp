// Repeats one kernel call for callgrind: bench_instructions forward|jacobian ARM. Instruction
// counts are reproducible where times are not.

#include <cstdio>
#include <cstring>

#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/jacobian.h>

#include "../inverse/arms.h"

namespace {

constexpr int calls = 1000;
volatile double sink = 0;

}  // namespace

extern "C" {

__attribute__((noinline)) void counted_forward(const beeline::Arm& arm,
                                               const beeline::Configuration& q) {
  for (int i = 0; i < calls; ++i) sink = beeline::forward_kinematics(arm, q)(0, 3);
}

__attribute__((noinline)) void counted_jacobian(const beeline::Arm& arm,
                                                const beeline::Configuration& q,
                                                beeline::Jacobian& columns) {
  for (int i = 0; i < calls; ++i) sink = beeline::jacobian(arm, q, columns)(0, 3);
}
}

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: bench_instructions forward|jacobian ARM\n");
    return 2;
  }
  const beeline::Arm arm = beeline::bench::bench_arm(argv[2]).arm;
  const beeline::Configuration q = beeline::Configuration::Constant(arm.dof(), 0.3);
  beeline::Jacobian columns(6, arm.dof());
  if (std::strcmp(argv[1], "jacobian") == 0) {
    counted_jacobian(arm, q, columns);
  } else {
    counted_forward(arm, q);
  }
  std::printf("%d\n", calls);
  return 0;
}
