#include <beeline/collision/collision_model.h>
#include <beeline/io/text/scene.h>
#include <beeline/kinematics/forward.h>

#include <tests/fuzz/target.h>

// An arm that is read and written again reads back as the same arm.
BEELINE_FUZZ_TARGET(arm_json) {
  using namespace beeline;
  fuzz::may_refuse([&] {
    const Arm arm = arm_from_text(input, "fuzzed.json");
    const Arm again = arm_from_json(arm_to_json(arm), "written.json");
    fuzz::require(again.dof() == arm.dof(), "the same joints");
    const Configuration q = middle_configuration(arm);
    const Pose difference = forward_kinematics(arm, q).inverse() * forward_kinematics(again, q);
    const double size = 1 + std::abs(arm.reach().radius) + q.cwiseAbs().maxCoeff();
    fuzz::require(!(difference.matrix() - Pose::Identity().matrix()).hasNaN(), "finite poses");
    fuzz::require(difference.translation().norm() < 1e-6 * size || !std::isfinite(size),
                  "the same pose");
    const ArmShapes shapes = arm_shapes_from_text(input, "fuzzed.json");
    CollisionModel(arm, shapes.links, {}, {.budget = {.max_work = 10}});
  });
}
