#include <algorithm>
#include <cmath>

#include <beeline/timing/internal/joint_motion.h>
#include <beeline/timing/internal/sampled_section.h>
#include <beeline/timing/internal/section_limits.h>
#include <beeline/timing/internal/uniform_section.h>
#include <beeline/trajectory/internal/append.h>
#include <beeline/trajectory/internal/interval_polynomial.h>

namespace beeline::internal {
namespace {

// Width of the ramps of acceleration, as a fraction of the duration: the motion takes so much
// longer.
constexpr double ramp = 0.003;
constexpr double widest_ramp = 0.2;       // the same, where limits of jerk need it
constexpr double worth_widening = 1.002;  // of a slowdown
constexpr int max_widenings = 3;

// The difference of an interpolation from the motion along the path that is not refined, as
// fractions of the limits of velocity, acceleration and jerk.
constexpr double velocity_error = 1e-3, acceleration_error = 3e-3, jerk_error = 0.04;
constexpr double first_intervals = 8;
// Change of a joint between two samples, rad or m: a player that takes them for angles must not
// turn it the other way (less than half a revolution).
constexpr double largest_change = 3;
constexpr double shortest = 1.0 / 4096;  // interval between samples, of the duration

// Grid points of a path up to which ramps and shortest intervals are these fractions of the
// duration. They are smaller for longer paths, which have more turns.
constexpr double usual_grid = 1024;

/// The part of these fractions that holds for a section.
double scale_of(const TimedSection& section) {
  return std::min(1.0, usual_grid / static_cast<double>(section.path.size()));
}

// Jumps of the acceleration, or of the jerk of a smooth time scaling, that get samples: as a
// fraction of the largest.
constexpr double large_jump = 0.1;

// A slowdown leaves this for the rounding of times to nanoseconds.
constexpr double rounding_margin = 2e-6;

class Refinement {
 public:
  /// Intervals are not divided below `least_gap`, s. The largest velocity of the samples scales the
  /// accepted error of the velocity.
  Refinement(const JointMotion& motion, const PathLimits& limits, const SectionOptions& options,
             double least_gap, const std::vector<Sample>& samples)
      : motion_(motion),
        limits_(limits),
        options_(options),
        shortest_(least_gap),
        velocity_error_(velocity_error * used_velocity(samples)) {}

  /// Appends samples after `a`, up to and including `b`, as close as the interpolation needs.
  /// Appends only some if the budget ends.
  void append(std::vector<Sample>& samples, const Sample& a, const Sample& b) const {
    if (options_.budget.ended(0)) return;
    const double h = b.t - a.t;
    std::array<Sample, 3> inner;  // at the quarters
    for (std::size_t i = 0; i < 3; ++i) {
      const double t = a.t + h * 0.25 * static_cast<double>(i + 1);
      inner[i] = {t, motion_.at(t)};
    }
    if (h <= shortest_ || agrees(a, inner, b)) {
      samples.push_back(b);
      return;
    }
    append(samples, a, inner[1]);
    append(samples, inner[1], b);
  }

 private:
  bool agrees(const Sample& a, const std::array<Sample, 3>& inner, const Sample& b) const {
    const double h = b.t - a.t;
    if ((b.state.q - a.state.q).cwiseAbs().maxCoeff() > largest_change) return false;
    for (Eigen::Index i = 0; i < a.state.q.size(); ++i) {
      const Polynomial p =
          options_.timing.interpolation == Interpolation::cubic
              ? cubic_between(a.state.q[i], b.state.q[i], h * a.state.v[i], h * b.state.v[i])
              : quintic_between(a.state.q[i], b.state.q[i], h * a.state.v[i], h * b.state.v[i],
                                h * h * a.state.a[i], h * h * b.state.a[i]);
      const Polynomial v = time_derivative(p, 1, h), acceleration = time_derivative(p, 2, h);
      double error_before = acceleration(0) - a.state.a[i];
      for (std::size_t k = 0; k < 4; ++k) {
        const double u = 0.25 * static_cast<double>(k + 1);
        const JointMotion::State& exact = k < 3 ? inner[k].state : b.state;
        const double error = acceleration(u) - exact.a[i];
        if (std::abs(v(u) - exact.v[i]) > velocity_error_ * limits_.velocity[i]) return false;
        if (std::abs(error) > acceleration_error * limits_.acceleration[i]) return false;
        const double jerk = std::abs(error - error_before) / (0.25 * h);
        if (options_.keeps_jerk() && jerk > jerk_error * limits_.jerk[i]) return false;
        error_before = error;
      }
    }
    return true;
  }

  /// The largest fraction of a velocity limit that the samples use, if the tool's speed is limited:
  /// the joints may be so slow that an error of a fraction of their limits exceeds it.
  double used_velocity(const std::vector<Sample>& samples) const {
    constexpr double least = 1e-3;
    if (!(options_.tool_speeds.lowest() < Limits::none)) return 1;
    double used = least;
    for (const Sample& sample : samples) {
      used = std::max(used, (sample.state.v.array() / limits_.velocity.array()).abs().maxCoeff());
    }
    return std::min(used, 1.0);
  }

  const JointMotion& motion_;
  const PathLimits& limits_;
  const SectionOptions& options_;
  double shortest_;
  double velocity_error_;
};

/// The samples whatever the interpolation needs: the ends and the required ones, whose s is exact;
/// for cubics and quintics also even times and the kinks of the acceleration. Required ones nearer
/// to one before them than shortest_interval are left out: the rounding of their positions would
/// count.
std::vector<Sample> first_samples(const JointMotion& motion, const TimeScaling& given,
                                  const SectionOptions& options, double least_gap) {
  const AveragedScaling& scaling = motion.scaling();
  const double duration = scaling.duration();
  // The motion is exactly at rest at both ends, despite rounding in the time scaling.
  std::vector<std::pair<double, ParameterState>> points{{0, {scaling.at(0).s, 0, 0}},
                                                        {duration, {scaling.at(duration).s, 0, 0}}};
  const auto add = [&](double t) { points.emplace_back(t, scaling.at(t)); };
  const bool linear = options.timing.interpolation == Interpolation::linear;
  const double gaps = linear ? 1 : first_intervals;
  for (double i = 1; i < gaps; ++i) add(duration * i / gaps);
  if (!linear) {
    for (const double t : scaling.kinks(large_jump)) {
      if (options.budget.ended()) return {};
      add(t);
    }
  }
  for (const double s : options.required) {
    if (!(s > given.s.front() && s < given.s.back())) continue;
    if (options.budget.ended()) return {};
    const double t = scaling.time_of(s, options.budget);
    ParameterState now = scaling.at(t);
    now.s = s;
    points.emplace_back(t, now);
  }
  std::sort(points.begin(), points.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Sample> samples;
  for (const auto& [t, now] : points) {
    const auto is_required = [&](double s) {
      return std::binary_search(options.required.begin(), options.required.end(), s);
    };
    const bool apart = samples.empty() || t > samples.back().t + least_gap;
    if (!apart && t < duration && !is_required(now.s)) continue;
    if (!apart && samples.size() > 1 && !is_required(samples.back().state.progress.s))
      samples.pop_back();
    const double gap = samples.empty() ? duration : t - samples.back().t;
    const bool last = t >= duration;
    if (last && gap < shortest_interval && samples.size() > 1) samples.pop_back();
    if (last || gap >= shortest_interval) samples.push_back({t, motion.at(now)});
  }
  return samples;
}

/// Slows the samples down by k, and moves them to whole nanoseconds along their motion.
void slow_down_in_nanoseconds(SampledSection& section, double slower) {
  Trajectory& trajectory = section.trajectory;
  slow_down(trajectory, slower);
  for (std::size_t k = 1; k < trajectory.size(); ++k) {
    const double rounded = round_to_nanoseconds(trajectory.times[k]);
    const double dt = rounded - trajectory.times[k];
    trajectory.times[k] = rounded;
    if (trajectory.velocities.empty() || k + 1 == trajectory.size()) continue;
    section.progress[k].s += dt * section.progress[k].speed / slower;
    trajectory.positions[k] += dt * trajectory.velocities[k];
    if (!trajectory.accelerations.empty()) {
      trajectory.velocities[k] += dt * trajectory.accelerations[k];
    }
  }
}

/// Returns the samples with ramps of this width before they are slowed down. Empty if the budget
/// ends the computation.
SampledSection refined_samples(const Arm& arm, const TimedSection& section,
                               const SectionOptions& options, double width) {
  const AveragedScaling scaling(section.scaling, width);
  const JointMotion motion(section.path, scaling);
  const double least_gap = shortest * scale_of(section) * scaling.duration();
  std::vector<Sample> samples = first_samples(motion, section.scaling, options, least_gap);
  if (samples.empty()) return {};
  if (options.timing.interpolation != Interpolation::linear) {
    const PathLimits limits = path_limits(arm, options.timing.speed_scale);
    const Refinement refinement(motion, limits, options, least_gap, samples);
    std::vector<Sample> refined{samples.front()};
    for (std::size_t k = 1; k < samples.size(); ++k) {
      if (options.budget.ended()) return {};
      refinement.append(refined, samples[k - 1], samples[k]);
    }
    if (options.budget.ended(0)) return {};
    samples = std::move(refined);
  }
  return with_columns(arm, samples, options.timing.interpolation);
}

/// Whether samples would need an acceleration that jumps.
bool has_jumps(const TimedSection& section, const SectionOptions& options) {
  return !section.scaling.smooth && options.timing.interpolation != Interpolation::linear;
}

double ramp_width(const TimedSection& section, const SectionOptions& options) {
  return has_jumps(section, options) ? ramp * scale_of(section) * section.scaling.duration() : 0;
}

SampledSection without_rate(const Arm& arm, const TimedSection& section,
                            const SectionOptions& options) {
  const bool jumps = has_jumps(section, options);
  double width = ramp_width(section, options);
  SampledSection result = refined_samples(arm, section, options, width);
  if (result.trajectory.size() == 0) return result;
  double factor = std::max(1.0, needed_slowdown(arm, result, options).both());
  if (options.budget.ended()) return {};
  // Wider ramps where their jerk exceeds a limit, as long as they cost less than the slowdown.
  for (int attempt = 0; attempt < max_widenings && jumps && factor > worth_widening; ++attempt) {
    if (options.budget.ended()) break;
    const double wider = width * factor * factor * factor;
    if (wider > widest_ramp * section.scaling.duration()) break;
    SampledSection tried = refined_samples(arm, section, options, wider);
    if (tried.trajectory.size() == 0) break;
    const double needed = std::max(1.0, needed_slowdown(arm, tried, options).both());
    if (!(needed * tried.trajectory.times.back() < factor * result.trajectory.times.back())) break;
    width = wider;
    factor = needed;
    result = std::move(tried);
  }
  const SampledSection exact = result;
  for (double margin = rounding_margin;;
       margin *= 4) {  // rounding is nearly always below the first
    result = exact;
    slow_down_in_nanoseconds(result, factor * (1 + margin));
    if (!(needed_slowdown(arm, result, options).both() > 1)) return result;
    if (options.budget.ended()) return {};
  }
}

/// Samples slowed down as a whole.
SampledSection slowed(const Arm& arm, const TimedSection& section, const SectionOptions& options) {
  return options.timing.rate > 0 ? uniform_section(arm, section, options)
                                 : without_rate(arm, section, options);
}

/// Samples that exceed limits where the interpolation or the path between grid points does.
SampledSection unslowed(const Arm& arm, const TimedSection& section,
                        const SectionOptions& options) {
  return options.timing.rate > 0
             ? shortest_uniform_section(arm, section, options)
             : refined_samples(arm, section, options, ramp_width(section, options));
}

/// Whether the profile is a minimum of the duration, so that lower limits at one place slow only
/// the motion there down. The other profiles have one form, which becomes slower as a whole.
bool is_optimised(Profile profile) {
  switch (profile) {
    case Profile::fastest:
    case Profile::jerk:
      return true;
    case Profile::trapezoidal:
    case Profile::quintic:
    case Profile::s_curve:
      return false;
  }
  throw Error("unknown profile");
}

/// Samples whose places that exceed limits get lower ones, where the slowdown of the whole is
/// large.
SampledSection locally_slowed(const Arm& arm, TimedSection section, const SectionOptions& options) {
  SampledSection best = slowed(arm, section, options);
  if (!best) return best;
  if (!is_optimised(section.profile) || options.timing.interpolation == Interpolation::linear)
    return best;
  constexpr std::size_t large_grid = 2000;  // grid points, for which a round takes seconds
  const int max_rounds = section.path.size() > large_grid ? 2 : 6;
  constexpr double small = 1.006, periods = 2;
  const double period = options.timing.rate > 0 ? 1 / options.timing.rate : 0;
  const double shortest_duration = section.scaling.duration();
  for (int round = 0; round < max_rounds; ++round) {
    if (options.budget.ended()) return best;
    const double duration = best.duration();
    if (duration <= small * shortest_duration + periods * period) return best;
    const SampledSection free = unslowed(arm, section, options);
    if (!free || !lower_limits(arm, free, options, section)) return best;
    section.scaling =
        time_scaling(section.path, section.limits, section.profile, options.budget.part());
    if (!section.scaling) return best;
    SampledSection tried = slowed(arm, section, options);
    if (tried && tried.duration() < duration) best = std::move(tried);
  }
  return best;
}

}  // namespace

SampledSection sample_section(const Arm& arm, const TimedSection& section,
                              const SectionOptions& options) {
  SampledSection best = locally_slowed(arm, section, options);
  if (section.profile != Profile::fastest || options.budget.ended()) return best;
  // The ramps of acceleration may take longer than a motion with limited jerk.
  TimedSection gentle = section;
  gentle.profile = Profile::jerk;
  gentle.scaling = time_scaling(section.path, section.limits, Profile::jerk, options.budget.part());
  if (!gentle.scaling) return best;
  if (best && !(gentle.scaling.duration() < best.duration())) return best;
  SectionOptions limited = options;
  limited.timing.profile = Profile::jerk;
  SampledSection other = locally_slowed(arm, gentle, limited);
  return other && (!best || other.duration() < best.duration()) ? other : best;
}

}  // namespace beeline::internal
