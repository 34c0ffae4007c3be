#include <algorithm>
#include <cmath>
#include <vector>

#include <beeline/control/internal/replay_attempt.h>
#include <beeline/error.h>

namespace beeline::internal {
namespace {

constexpr double little = 1.1;  // the largest slowdown of advice beyond whole periods

/// Tries other options of a replay.
class AdviceSearch {
 public:
  AdviceSearch(const Arm& arm, const Trajectory& recording, const ReplayOptions& options,
               BudgetMeter& budget)
      : arm_(arm), recording_(recording), options_(options), budget_(budget) {}

  /// The highest speed found, from this one on down.
  std::string speed(double first) {
    constexpr int max_speeds = 16, small_steps = 4;  // first, as the suggested speed is near
    constexpr double step = 0.8, small_step = 1 - 1e-4;
    double next = first;
    for (int tries = 0; tries < max_speeds; ++tries) {
      const double tried = printed(next, tries > 0);
      const ReplayAttempt attempt = with_speed(tried);
      if (!budget_.complete()) return {};
      if (attempt.replay) {
        return (options_.speed_at.empty() ? "a speed of " : "speeds of at most ") + number(tried) +
               (options_.speed_at.empty() ? " keeps the limits" : " keep the limits");
      }
      next = std::min(attempt.speed.value_or(step * tried),
                      (tries < small_steps ? small_step : step) * tried);
    }
    return {};
  }

  /// The highest of some speeds, down to half the present one, at the present rate; 0 if none does.
  double speed_at_this_rate(double present) {
    for (const double factor : {0.95, 0.9, 0.8, 0.7, 0.6, 0.5}) {
      const double tried = printed(factor * present, false);
      if (with_speed(tried).replay) return tried;
      if (!budget_.complete()) break;
    }
    return 0;
  }

  /// The usual rate that is nearest to the present one by its ratio, above or below; 0 if none
  /// does.
  double rate() {
    const double present = replay_rate(options_);
    const double duration = recording_.times.back() - recording_.times.front();
    std::vector<double> rates{1000, 500, 250, 200, 125, 100, 60, 50, 25, 20, 10};
    const auto far = [&](double tried) { return std::abs(std::log(tried / present)); };
    std::sort(rates.begin(), rates.end(), [&](double a, double b) { return far(a) < far(b); });
    for (const double tried : rates) {
      if (tried == present || tried * duration < least_periods()) continue;
      ReplayOptions options = options_;
      options.rate = tried;
      if (works(options)) return tried;
      if (!budget_.complete()) break;
    }
    return 0;
  }

  /// A speed at the present rate, another rate, or both.
  std::string speed_or_rate(double highest_speed) {
    const double speed = speed_at_this_rate(highest_speed);
    const double rate = budget_.complete() ? this->rate() : 0;
    if (!(speed > 0 || rate > 0)) return {};
    const bool steady = options_.speed_at.empty();
    std::string text;
    if (speed > 0) {
      text = (steady ? "a speed of " : "speeds of at most ") + number(speed) + " at this rate";
    }
    if (rate > 0) text += (text.empty() ? "" : ", or ") + ("a rate of " + number(rate));
    return text + (steady || !(speed > 0) || rate > 0 ? " keeps the limits" : " keep the limits") +
           why_far(rate);
  }

  /// Why only a rate far from the present one was found.
  std::string why_far(double rate) const {
    constexpr double far = 2;
    const double present = replay_rate(options_);
    if (!(rate > 0) || present < far * rate || recording_.interpolation() != Interpolation::linear)
      return {};
    return "; the recording is linear between its samples, and finer sampling shows the corners, "
           "which retime() smooths";
  }

  std::string recorded_samples() {
    if (!options_.speed_at.empty()) return {};
    ReplayOptions options = options_;
    options.rate = 0;
    return works(options) ? "the recorded samples, without a rate, keep the limits" : "";
  }

  std::string ramp() {
    for (const double factor : {2., 5., 10.}) {
      ReplayOptions options = options_;
      options.ramp = factor * options_.ramp;
      if (works(options)) return "a ramp of " + number(options.ramp) + " s keeps the limits";
      if (!budget_.complete()) return {};
    }
    return {};
  }

 private:
  /// With speed changes 4 samples are needed at least, see replay().
  double least_periods() const { return options_.speed_at.empty() ? 1 : 4; }

  /// x, or a number a little below it, with six digits as messages print it.
  static double printed(double x, bool below) {
    const double down = below ? 1 - 1e-5 : 1;
    const double unit = std::pow(10, std::floor(std::log10(down * x)) - 5);
    return std::round(down * x / unit) * unit;
  }

  /// Speeds are at most this one.
  ReplayAttempt with_speed(double speed) {
    ReplayOptions options = options_;
    options.speed = std::min(options.speed, speed);
    for (SpeedChange& change : options.speed_at) change.speed = std::min(change.speed, speed);
    return attempt_replay(arm_, recording_, options, little, budget_);
  }

  bool works(const ReplayOptions& options) {
    return static_cast<bool>(attempt_replay(arm_, recording_, options, little, budget_).replay);
  }

  const Arm& arm_;
  const Trajectory& recording_;
  const ReplayOptions& options_;
  BudgetMeter& budget_;
};

/// The highest speed asked for.
double highest_speed(const ReplayOptions& options) {
  double highest = options.speed_at.empty() ? options.speed : 0;
  for (const SpeedChange& change : options.speed_at) highest = std::max(highest, change.speed);
  return highest;
}

}  // namespace

std::string tried_advice(const Arm& arm, const Trajectory& recording, const ReplayOptions& options,
                         const ReplayAttempt& failed, BudgetMeter& budget) {
  AdviceSearch search(arm, recording, options, budget);
  std::string advice;
  const auto or_else = [&](const auto& tried) {
    if (advice.empty() && budget.complete()) advice = tried();
  };
  if (!failed.speed && replay_rate(options) > 0) {
    or_else([&] { return search.speed_or_rate(highest_speed(options)); });
    or_else([&] { return search.recorded_samples(); });
    if (!options.speed_at.empty()) or_else([&] { return search.ramp(); });
  }
  or_else([&] { return search.speed(failed.speed.value_or(0.8 * highest_speed(options))); });
  if (!budget.complete()) return {};
  return "; " +
         (advice.empty() ? "no other rate, ramp or speed was found that keeps the limits" : advice);
}

}  // namespace beeline::internal
