#include <beeline/planning/internal/program_verifier.h>

namespace beeline {

using namespace internal;

Verification verify(const Arm& arm, const Trajectory& given, const Program& program,
                    const VerifyOptions& options) {
  check_program(arm, program, options.task);
  const Trajectory trajectory = matched_to(arm, given);
  if (trajectory.size() == 0) throw Error("the trajectory has no samples");
  BudgetMeter budget(options.budget);
  return ProgramVerifier(arm, trajectory, program, options, budget).run();
}

}  // namespace beeline
