#include <algorithm>
#include <cmath>

#include <beeline/certificate/internal/clearance_search.h>
#include <beeline/planning/internal/free_edges.h>

namespace beeline::internal {
namespace {

// A pair that is nearer than twice its clearance need not be decided: another path is as good.
const ClearanceOptions coarse{.resolution = 1};

constexpr int at_once = SampledCollisions::at_once;

}  // namespace

FreeEdges::FreeEdges(const CollisionModel& model, int most, BudgetMeter& budget)
    : model_(model),
      most_(static_cast<std::size_t>(most)),
      budget_(budget),
      samples_(model.bodies()),
      edge_{model.bodies().joint_names, {0, 1}, {Configuration(), Configuration()}, {}, {}} {}

void FreeEdges::sample_more_densely() {
  constexpr double least_spacing = 1e-3;
  spacing_ = std::max(least_spacing, spacing_ / 2);
}

int FreeEdges::sample_count(double length) const {
  constexpr double most = 1e4;  // of a motion, which are then farther apart
  return static_cast<int>(std::clamp(std::ceil(length / spacing_), 1.0, most));
}

int FreeEdges::first_blocked(const Configuration& a, const Configuration& change,
                             const Fractions& fractions) {
  if (budget_.ended()) return 0;
  lanes_.resize(static_cast<std::size_t>(at_once * a.size()));
  double* row = lanes_.data();
  for (Eigen::Index i = 0; i < a.size(); ++i, row += at_once) {
    for (std::size_t k = 0; k < at_once; ++k) row[k] = a[i] + fractions[k] * change[i];
  }
  return samples_.first_blocked(lanes_.data());
}

double FreeEdges::sampled_fraction(const Configuration& a, const Configuration& b) {
  if (ended()) return 0;
  ++count_;
  const Configuration change = b - a;
  const int count = sample_count(change.norm());
  const Fractions steps = Fractions::LinSpaced(1, at_once);
  for (int next = 0; next < count; next += at_once) {
    const int blocked = first_blocked(a, change, ((next + steps) / count).min(1));
    if (blocked == at_once) continue;
    if (next + blocked > 0) return static_cast<double>(next + blocked) / count;
    // In a narrow place the motion before the first sample counts.
    const double between = 1.0 / (count * (at_once + 1));
    return between * first_blocked(a, change, between * steps);
  }
  return 1;
}

bool FreeEdges::seems_free(const Configuration& a, const Configuration& b) {
  if (ended()) return false;
  ++count_;
  const Configuration change = b - a;
  const int batches = (sample_count(change.norm()) + at_once - 1) / at_once;
  for (int batch = 0; batch < batches; ++batch) {
    const Fractions spread = batch + 1 + batches * Fractions::LinSpaced(0, at_once - 1);
    if (first_blocked(a, change, spread / (at_once * batches + 1)) < at_once) return false;
  }
  return true;
}

bool FreeEdges::is_free(const Configuration& a, const Configuration& b) {
  edge_.positions = {a, b};
  return is_free(edge_, budget_);
}

bool FreeEdges::is_free_closely(const Configuration& a, const Configuration& b,
                                std::int64_t max_work) {
  edge_.positions = {a, b};
  Budget budget = budget_.part();
  budget.max_work = max_work;
  ClearanceOptions options{.budget = budget};
  options.resolution *= 2;
  return static_cast<bool>(prove_clearance(model_, edge_, options));
}

bool FreeEdges::are_free(const std::vector<Configuration>& waypoints) {
  BudgetMeter rest({.max_work = 10'000});  // about 50 ms
  for (std::size_t k = 1; k < waypoints.size(); ++k) {
    edge_.positions = {waypoints[k - 1], waypoints[k]};
    if (is_free(edge_, budget_)) continue;
    if (budget_.complete() || !is_free(edge_, rest)) return false;
  }
  return true;
}

bool FreeEdges::is_free(const Trajectory& motion, BudgetMeter& budget) const {
  const MotionTubes tubes(motion);
  ClearanceSearch search(model_.bodies(), tubes, coarse, budget);
  return static_cast<bool>(search.until_first_fault().run());
}

}  // namespace beeline::internal
