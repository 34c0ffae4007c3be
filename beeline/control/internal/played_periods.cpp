#include <algorithm>
#include <cmath>

#include <beeline/control/internal/played_section.h>
#include <beeline/error.h>
#include <beeline/trajectory/internal/append.h>

namespace beeline::internal {
namespace {

constexpr double period_rounding = 1e-6;  // fraction of a period

/// The search for the numbers of periods of all sections.
class PeriodSearch {
 public:
  PeriodSearch(const PlayedMotion& motion, double speed, double rate)
      : motion_(motion), rate_(rate) {
    for (const RecordedSection& section : motion.sections) {
      const double own = section.rests ? std::min(1.0, speed) : speed;
      const double asked = length(section) * rate / own;
      asked_ += asked;
      fewest_.push_back(std::max(1.0, std::ceil(asked - period_rounding)));
    }
    check_samples(total(fewest_), asked_ / rate, rate);
    periods_ = fewest_;
  }

  PlayedSection run() {
    constexpr int max_rounds = 40;
    std::vector<bool> open(periods_.size(), true);  // sections whose samples are not found yet
    for (int round = 0; round < max_rounds; ++round) {
      std::size_t first = motion_.first;
      for (std::size_t i = 0; i < periods_.size(); ++i) {
        if (open[i] && !find_alone(i, first)) return failure();
        first += static_cast<std::size_t>(periods_[i]);
      }
      const Trajectory whole = all_sections();
      if (whole.size() == 0) return failure();
      const auto excess = periods_.size() > 1 ? largest_excess(motion_.held, whole) : std::nullopt;
      if (!excess) return {whole, total(periods_) / asked_, {}};
      note(whole, *excess, 0);
      open = lengthen_at(*excess);
      if (std::find(open.begin(), open.end(), true) == open.end()) return failure();
    }
    return failure();
  }

 private:
  double length(const RecordedSection& section) const {
    return motion_.recording.times[section.end] - motion_.recording.times[section.begin];
  }

  static double total(const std::vector<double>& periods) {
    double sum = 0;
    for (const double n : periods) sum += n;
    return sum;
  }

  /// Returns the samples of a section with its number of periods. The first of them has the number
  /// `first`.
  Trajectory samples_of(std::size_t i, std::size_t first) const {
    const auto& times = motion_.recording.times;
    const RecordedSection& section = motion_.sections[i];
    const auto played = times_from(first, static_cast<std::size_t>(periods_[i]) + 1, rate_);
    const double speed = length(section) / played.back(), begin = times[section.begin];
    std::vector<ParameterState> progress;
    for (const double t : played) progress.push_back({begin + t * speed, speed, 0});
    progress.back().s = times[section.end];
    return samples_at(motion_, played, progress);
  }

  bool may_grow(std::size_t i) const {
    return periods_[i] <= motion_.max_slowdown * fewest_[i] + 1;
  }

  void note(Trajectory samples, const LimitExcess& excess, double begin) {
    if (first_excess_) return;
    for (double& t : samples.times) t += begin;
    first_excess_ = exceeded_limit(motion_.arm, samples, excess);
  }

  /// Lengthens section i, from sample `first` on, until it keeps the limits by itself, at most by
  /// the largest slowdown. Returns whether it does.
  bool find_alone(std::size_t i, std::size_t first) {
    constexpr double first_step = 1e-4,
                     growth = 1.6;  // of the search's steps
    // Factor on the largest slowdown; the search stops at a larger needed slowdown.
    constexpr double hopeless = 2;
    // Fraction of a slowdown taken at once: other samples are the worst later.
    constexpr double at_once = 0.8;
    if (motion_.sections[i].rests) return true;
    HeldLimits held = motion_.held;
    held.starts_at_rest = held.starts_at_rest || i > 0;
    held.ends_at_rest = held.ends_at_rest || i + 1 < periods_.size();
    double& periods = periods_[i];
    for (double least = first_step; may_grow(i); least *= growth) {
      const Trajectory tried = samples_of(i, first);
      if (tried.size() == 0) return false;
      const auto excess = largest_excess(held, tried);
      if (!excess) return true;
      note(tried, *excess, time_at_rate(first, rate_));
      if (excess->slowdown > hopeless * motion_.max_slowdown) return false;
      const double step = std::max(least, at_once * (excess->slowdown - 1));
      periods = std::max(periods + 1, std::floor(periods * (1 + step)));
    }
    return false;
  }

  /// Returns the samples of all sections. A stop with two accelerations gets the smaller one.
  Trajectory all_sections() const {
    Trajectory whole;
    whole.joint_names = motion_.arm.joint_names();
    std::size_t first = motion_.first;
    for (std::size_t i = 0; i < periods_.size(); ++i) {
      const Trajectory next = samples_of(i, first);
      if (next.size() == 0) return {};
      if (!whole.accelerations.empty() &&
          next.accelerations.front().norm() < whole.accelerations.back().norm()) {
        whole.accelerations.back() = next.accelerations.front();
      }
      append(whole, next);
      first += static_cast<std::size_t>(periods_[i]);
    }
    for (std::size_t k = 0; k < whole.size(); ++k) {
      whole.times[k] = time_at_rate(motion_.first + k, rate_) - time_at_rate(motion_.first, rate_);
    }
    return whole;
  }

  /// Lengthens the sections at the excess of the whole motion, and their neighbours. Returns which
  /// ones.
  std::vector<bool> lengthen_at(const LimitExcess& excess) {
    constexpr double stencil = 3;  // intervals of a third difference
    std::vector<bool> lengthened(periods_.size(), false);
    const auto sample = static_cast<double>(excess.sample);
    double begin = 0;
    for (std::size_t i = 0; i < periods_.size(); ++i) {
      const double end = begin + periods_[i];
      const bool near = sample < end && sample + stencil >= begin;
      if (near && may_grow(i)) {
        periods_[i] += 1;
        lengthened[i] = true;
      }
      begin = end;
    }
    return lengthened;
  }

  PlayedSection failure() const {
    if (motion_.budget.ended()) return ended_section(motion_);
    Reason reason = first_excess_;
    return {.trajectory = {}, .reason = reason.set(ReasonField::rate, rate_)};
  }

  const PlayedMotion& motion_;
  double rate_;
  double asked_ = 0;                 // requested number of periods, not whole
  std::vector<double> fewest_ = {};  // least number of periods of each section
  std::vector<double> periods_ = {};
  Reason first_excess_ = {};
};

}  // namespace

PlayedSection in_periods(const PlayedMotion& motion, double speed, double rate) {
  return PeriodSearch(motion, speed, rate).run();
}

}  // namespace beeline::internal
