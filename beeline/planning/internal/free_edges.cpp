#include <beeline/certificate/internal/clearance_search.h>
#include <beeline/planning/internal/free_edges.h>

namespace beeline::internal {
namespace {

// A pair that is nearer than twice its clearance need not be decided: another way is as good.
const ClearanceOptions coarse{.resolution = 1};

}  // namespace

FreeEdges::FreeEdges(const CollisionModel& model, int most, BudgetMeter& budget)
    : model_(model),
      most_(static_cast<std::size_t>(most)),
      budget_(budget),
      edge_{model.bodies().joint_names, {0, 1}, {Configuration(), Configuration()}, {}, {}} {}

double FreeEdges::free_fraction(const Configuration& a, const Configuration& b) {
  edge_.positions = {a, b};
  return free_time(edge_);
}

double FreeEdges::free_time(const Trajectory& motion) {
  if (ended()) return 0;
  ++count_;
  const MotionTubes tubes(motion);
  const ClearanceProof proof =
      ClearanceSearch(model_.bodies(), tubes, coarse, budget_).until_first_fault().run();
  if (proof) return motion.times.back();
  return proof.status > ClearanceStatus::not_decided ? 0 : proof.begin;
}

}  // namespace beeline::internal
