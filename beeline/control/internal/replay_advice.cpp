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

  /// Adds the highest speed found, searching downwards from this one.
  bool add_speed(double first, Reason& reason) {
    constexpr int max_speeds = 16,
                  small_steps = 4;  // small steps first, because the suggested speed is near
    constexpr double step = 0.8, small_step = 1 - 1e-4;
    double next = first;
    for (int tries = 0; tries < max_speeds; ++tries) {
      const double tried = printed(next, tries > 0);
      const ReplayAttempt attempt = with_speed(tried);
      if (!budget_.complete()) return false;
      if (attempt.replay) {
        set_speed(tried, reason);
        return true;
      }
      next = std::min(attempt.speed.value_or(step * tried),
                      (tries < small_steps ? small_step : step) * tried);
    }
    return false;
  }

  /// Returns the highest of some speeds, down to half the present one, at the present rate; 0 if
  /// none keeps the limits.
  double speed_at_this_rate(double present) {
    for (const double factor : {0.95, 0.9, 0.8, 0.7, 0.6, 0.5}) {
      const double tried = printed(factor * present, false);
      if (with_speed(tried).replay) return tried;
      if (!budget_.complete()) break;
    }
    return 0;
  }

  /// Returns the usual rate nearest to the present one by its ratio, above or below; 0 if none
  /// keeps the limits.
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

  /// Adds a speed at the present rate, another rate, or both.
  bool add_speed_or_rate(double highest_speed, Reason& reason) {
    const double speed = speed_at_this_rate(highest_speed);
    const double rate = budget_.complete() ? this->rate() : 0;
    if (speed > 0) {
      set_speed(speed, reason);
      reason.set(ReasonField::kept_at_rate, true);
    }
    if (rate > 0) reason.set(ReasonField::kept_rate, rate);
    if (shows_corners(rate)) reason.set(ReasonField::shows_corners, true);
    return speed > 0 || rate > 0;
  }

  /// Returns whether the recording is linear, so that only a rate far from the present one was
  /// found.
  bool shows_corners(double rate) const {
    constexpr double far = 2;
    return rate > 0 && replay_rate(options_) >= far * rate &&
           recording_.interpolation() == Interpolation::linear;
  }

  bool add_recorded_samples(Reason& reason) {
    if (!options_.speed_at.empty()) return false;
    ReplayOptions options = options_;
    options.rate = 0;
    if (!works(options)) return false;
    reason.set(ReasonField::kept_without_rate, true);
    return true;
  }

  bool add_ramp(Reason& reason) {
    for (const double factor : {2., 5., 10.}) {
      ReplayOptions options = options_;
      options.ramp = factor * options_.ramp;
      if (works(options)) {
        reason.set(ReasonField::kept_ramp, options.ramp);
        return true;
      }
      if (!budget_.complete()) return false;
    }
    return false;
  }

 private:
  /// Speed changes need at least 4 samples, see replay().
  double least_periods() const { return options_.speed_at.empty() ? 1 : 4; }

  /// Returns x, or a number a little below it, with six digits as messages print it.
  static double printed(double x, bool below) {
    const double down = below ? 1 - 1e-5 : 1;
    const double unit = std::pow(10, std::floor(std::log10(down * x)) - 5);
    return std::round(down * x / unit) * unit;
  }

  void set_speed(double speed, Reason& reason) const {
    reason.set(ReasonField::kept_speed, speed);
    if (!options_.speed_at.empty()) reason.set(ReasonField::speed_changes, true);
  }

  /// Max speed.
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

/// Returns the highest requested speed.
double highest_speed(const ReplayOptions& options) {
  double highest = options.speed_at.empty() ? options.speed : 0;
  for (const SpeedChange& change : options.speed_at) highest = std::max(highest, change.speed);
  return highest;
}

}  // namespace

void add_advice(const Arm& arm, const Trajectory& recording, const ReplayOptions& options,
                const ReplayAttempt& failed, BudgetMeter& budget, Reason& reason) {
  AdviceSearch search(arm, recording, options, budget);
  const Reason before = reason;
  bool found = false;
  const auto or_else = [&](const auto& add) {
    if (!found && budget.complete()) found = add();
  };
  if (!failed.speed && replay_rate(options) > 0) {
    or_else([&] { return search.add_speed_or_rate(highest_speed(options), reason); });
    or_else([&] { return search.add_recorded_samples(reason); });
    if (!options.speed_at.empty()) or_else([&] { return search.add_ramp(reason); });
  }
  const double first = failed.speed.value_or(0.8 * highest_speed(options));
  or_else([&] { return search.add_speed(first, reason); });
  if (!budget.complete()) {
    reason = before;
  } else if (!found) {
    reason.set(ReasonField::none_kept, true);
  }
}

}  // namespace beeline::internal
