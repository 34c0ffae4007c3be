#include <algorithm>
#include <cmath>
#include <limits>

#include <beeline/certificate/clearance.h>
#include <beeline/certificate/internal/clearance_search.h>
#include <beeline/collision/internal/nearest_pair.h>

namespace beeline {
namespace {

using internal::ClearanceSearch;
using internal::MotionTubes;

constexpr double fraction_of_part = 1.0 / 120;  // of the duration

/// The clearance of all pairs; none if they differ.
std::optional<double> common_clearance(const internal::CollisionBodies& bodies) {
  for (const auto& obstacle : bodies.obstacle_bodies) {
    if (obstacle.clearance != bodies.options.clearance) return std::nullopt;
  }
  return bodies.options.clearance;
}

class OverTime {
 public:
  OverTime(const CollisionModel& model, const MotionTubes& tubes, internal::BudgetMeter& budget)
      : model_(model),
        tubes_(tubes),
        budget_(budget),
        apart_(internal::apart_pairs_of(model, tubes)) {
    const std::vector<double>& times = tubes.trajectory().times;
    longest_ = fraction_of_part * (times.back() - times.front());
    found_.clearance = common_clearance(model.bodies());
    largest_clearance_ = model.clearance();
    for (const auto& obstacle : model.bodies().obstacle_bodies) {
      largest_clearance_ = std::max(largest_clearance_, obstacle.clearance);
    }
  }

  ClearanceOverTime run() {
    found_.times.push_back(tubes_.trajectory().times.front());
    divide(tubes_.all());
    found_.ending = budget_.ending();
    return std::move(found_);
  }

 private:
  void divide(const MotionTubes::Range& range) {
    const std::vector<double>& times = tubes_.trajectory().times;
    if (times[range.last] - times[range.first] <= longest_) {
      add(range, times[range.first], times[range.last]);
    } else if (range.is_interval()) {
      divide({.coefficients = tubes_.coefficients(range.first),
              .second_half = {},
              .from = times[range.first],
              .to = times[range.last],
              .rounding = tubes_.rounding(range.first)});
    } else {
      divide(range.first_half());
      divide(range.second_half());
    }
  }

  void divide(const ClearanceSearch::Part& part) {
    if (part.to - part.from <= longest_ || !part.is_divisible()) {
      return add(part, part.from, part.to);
    }
    ClearanceSearch::Part first = part, second = part;
    first.to = second.from = part.middle();
    internal::add_halving_rounding(part.coefficients, first.rounding);
    second.rounding = first.rounding;
    internal::halve(part.coefficients, first.coefficients, second.coefficients);
    divide(first);
    divide(second);
  }

  /// Adds a range of intervals or a part of one.
  template <class Place>
  void add(const Place& place, double from, double to) {
    if (budget_.ended()) return;
    constexpr int samples = 5;
    double found = std::numeric_limits<double>::infinity(), distance = 0;
    for (int i = 0; i < samples; ++i) {
      const double time = i + 1 == samples ? to : from + (to - from) * i / (samples - 1);
      const BodyDistance pair =
          internal::nearest_pair(model_, sample(tubes_.trajectory(), time).position, apart_);
      const double excess = pair.upper - pair.clearance;
      if (i > 0 || found_.sampled.empty()) {  // the first is the last of the part before
        found_.sample_times.push_back(time);
        found_.sampled.push_back(excess);
      }
      if (excess >= found) continue;
      found = excess;
      distance = pair.upper;
    }
    const double bound = proved_bound(place, found, distance);
    if (!budget_.complete()) return;
    found_.proved.push_back(bound);
    found_.times.push_back(to);
  }

  /// Returns the largest distance beyond the clearance that was proved, up to the one found: at
  /// least the one that all distances have, as they are not negative.
  template <class Place>
  double proved_bound(const Place& place, double found, double distance) {
    for (double step = 0.005; step < 1; step *= 2) {
      const double bound = found - step * std::max(distance, model_.clearance());
      if (bound <= -largest_clearance_) break;
      if (proves(place, bound)) return bound;
    }
    return found > 0 && proves(place, 0) ? 0 : -largest_clearance_;
  }

  template <class Place>
  bool proves(const Place& place, double bound) {
    const ClearanceOptions options;
    const ClearanceProof proof =
        ClearanceSearch(model_.bodies(), tubes_, options, budget_, bound, true).run(place);
    return proof.status == ClearanceStatus::clear;
  }

  const CollisionModel& model_;
  const MotionTubes& tubes_;
  internal::BudgetMeter& budget_;
  internal::ApartPairs apart_;
  double longest_ = 0, largest_clearance_ = 0;
  ClearanceOverTime found_;
};

}  // namespace

ClearanceOverTime clearance_over_time(const CollisionModel& model, const Trajectory& trajectory,
                                      const Budget& budget) {
  const Trajectory adapted = internal::adapted_motion(model, trajectory);
  internal::BudgetMeter meter(budget);
  const MotionTubes tubes(adapted.size() > 0 ? adapted : trajectory);
  if (internal::counted_pairs(model, tubes) == 0) return {};
  return OverTime(model, tubes, meter).run();
}

}  // namespace beeline
