#include <beeline/planning/internal/current_scene.h>
#include <beeline/trajectory/internal/append.h>

namespace beeline::internal {

CurrentScene::CurrentScene(const CollisionModel& model, const Program& program)
    : model_(model), program_(program), parts_(model, program) {}

void CurrentScene::arrive(std::size_t moves, const ConfigurationRef& q) {
  parts_.change(moves, q);
  if (parts_.changed().empty()) return;
  is_changed_ = true;
  changed_.reset();
}

const CollisionModel& CurrentScene::model() {
  if (is_changed_ && !changed_) changed_.emplace(parts_.model());
  return changed_ ? *changed_ : model_;
}

decltype(InverseOptions::blocked_by) CurrentScene::blocked() {
  return [&current = model()](const ConfigurationRef& q) { return blocked_by(current, q); };
}

Reason CurrentScene::erase_blocked(std::vector<Configuration>& configurations) {
  Reason first;
  std::erase_if(configurations, [&](const Configuration& q) {
    Reason reason = blocked_by(model(), q);
    const bool blocked(reason);
    if (blocked && !first) first = std::move(reason);
    return blocked;
  });
  return first;
}

Reason CurrentScene::blocked_ahead(const ProgramPart& part, const PathMotion& motion,
                                   const Budget& budget) {
  CarriedParts parts = parts_;
  parts.change(part.first, motion.trajectory.positions.front());
  std::optional<CollisionModel> changed;
  if (!parts.changed().empty()) changed.emplace(parts.model());
  std::size_t last = part.first;
  while (last < part.last && !has_change(program_, last + 1)) ++last;
  const std::size_t end = motion.arrivals[part.last_segment(last)];
  return prove_clearance(changed ? *changed : model(), samples_between(motion.trajectory, 0, end),
                         {.budget = budget})
      .reason;
}

}  // namespace beeline::internal
