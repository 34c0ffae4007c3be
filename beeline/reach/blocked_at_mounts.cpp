#include <memory>

#include <beeline/reach/place.h>

namespace beeline {

std::function<BlockedAtMount(const Pose&)> blocked_at_mounts(const CollisionModel& model) {
  return [&model](const Pose& world_T_mount) -> BlockedAtMount {
    const auto there = std::make_shared<const CollisionModel>(with_mount(model, world_T_mount));
    const Reason base = base_blocked_by(*there);
    if (base) {
      return {.configuration = [base](const ConfigurationRef&) { return base; },
              .motions = {
                  .reason = [base](const Trajectory&, const ClearanceOptions&) { return base; }}};
    }
    return {.configuration = [there](const ConfigurationRef& q) { return blocked_by(*there, q); },
            .motions = blocked_motions(there)};
  };
}

}  // namespace beeline
