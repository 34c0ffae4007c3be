#include <algorithm>

#include <beeline/timing/internal/averaged_scaling.h>
#include <beeline/timing/internal/graded_stop.h>
#include <beeline/timing/internal/sampled_section.h>

namespace beeline::internal {
namespace {

constexpr double largest_growth = 2;  // of an interval over the one before it

enum class StopSide { before, after };

/// Returns the time from a stop to a sample of the section on this side of it.
double from_stop(StopSide side, const AveragedScaling& motion, double s, BudgetMeter& budget) {
  const double t = motion.time_of(s, budget);
  return side == StopSide::after ? t : motion.duration() - t;
}

/// Returns the interval between the stop and the sample nearest to it.
double interval_at(StopSide side, const LinearSamples& samples, BudgetMeter& budget) {
  const AveragedScaling motion(samples.scaling, 0);
  const auto next = [&](double s) {
    const bool inside = s > samples.scaling.s.front() && s < samples.scaling.s.back();
    const double t = inside ? from_stop(side, motion, s, budget) : 0;
    return t >= shortest_interval ? t : 0;
  };
  const auto nearest = [&](const auto& begin, const auto& end) {
    for (auto s = begin; s != end; ++s) {
      if (const double t = next(*s); t > 0) return t;
    }
    return motion.duration();
  };
  return side == StopSide::after ? nearest(samples.required.begin(), samples.required.end())
                                 : nearest(samples.required.rbegin(), samples.required.rend());
}

/// Returns the sum of `count` intervals after one of length 1, each `growth` times the one before.
double sum_of_intervals(int count, double growth) {
  double sum = 0, interval = 1;
  for (int i = 0; i < count; ++i) sum += interval *= growth;
  return sum;
}

/// Divides the interval at a stop into intervals that grow from the length of its neighbour.
void divide_interval(StopSide side, double interval, double neighbour, const LinearSamples& samples,
                     BudgetMeter& budget) {
  const double ratio = interval / std::max(neighbour, shortest_interval);
  if (!(ratio > largest_growth) || !budget.complete()) return;
  int count = 1;
  while (sum_of_intervals(count, largest_growth) < ratio) ++count;
  double low = 1, high = largest_growth;
  for (int i = 0; i < 40; ++i) {
    const double middle = (low + high) / 2;
    (sum_of_intervals(count, middle) < ratio ? low : high) = middle;
  }
  const AveragedScaling motion(samples.scaling, 0);
  for (int i = 1; i < count; ++i) {
    const double t = interval * sum_of_intervals(i, high) / ratio;
    samples.required.push_back(motion.at(side == StopSide::after ? t : motion.duration() - t).s);
  }
  std::sort(samples.required.begin(), samples.required.end());
}

}  // namespace

void grade_stop(const LinearSamples& before, const LinearSamples& after, BudgetMeter& budget) {
  const double last = interval_at(StopSide::before, before, budget);
  const double first = interval_at(StopSide::after, after, budget);
  divide_interval(StopSide::before, last, first, before, budget);
  divide_interval(StopSide::after, first, last, after, budget);
}

}  // namespace beeline::internal
