#include <beeline/certificate/verify.h>
#include <beeline/kinematics/forward.h>
#include <beeline/planning/move_along.h>

#include <tests/fuzz/bytes.h>
#include <tests/fuzz/target.h>

// A motion that is planned is proved again from its columns.
BEELINE_FUZZ_TARGET(line) {
  using namespace beeline;
  fuzz::Bytes bytes(input);
  fuzz::may_refuse([&] {
    const Arm arm = bytes.arm();
    const Configuration q = bytes.configuration(arm);
    PathMotionOptions options{.tolerance = 1e-3, .orientation_tolerance = 1e-2};
    options.max_samples = 2000;
    options.budget.max_work = 20'000;
    if (bytes.flag()) options.rate = bytes.integer(10, 200);
    if (bytes.flag()) options.interpolation = Interpolation::linear;
    std::vector<Pose> waypoints;
    for (int i = bytes.integer(1, 3); i > 0; --i) {
      Configuration next = q;
      for (double& value : next) value += 0.3 * bytes.unit();
      waypoints.push_back(forward_kinematics(arm, next));
    }
    const PathMotion motion = move_in_lines(arm, q, waypoints, options);
    fuzz::require(motion || bool(motion.reason), "a reason");
    if (!motion) return;
    const Verification proof = verify(
        arm, motion.trajectory, waypoints,
        {.tolerance = options.tolerance, .orientation_tolerance = options.orientation_tolerance});
    fuzz::require(static_cast<bool>(proof),
                  "a planned motion is proved: " + sentence(proof.reason));
  });
}
