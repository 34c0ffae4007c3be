#include <algorithm>
#include <cmath>

#include <beeline/timing/internal/section.h>
#include <beeline/trajectory/internal/interval_polynomial.h>
#include <beeline/trajectory/internal/limit_fraction.h>
#include <beeline/trajectory/internal/tool_speed.h>

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
constexpr double shortest = 1.0 / 4096;  // interval between samples, of the duration

// Jumps of the acceleration, or of the jerk of a smooth time scaling, that get samples: as a
// fraction of the largest.
constexpr double large_jump = 0.1;

constexpr int max_tries = 60;  // of numbers of periods

// A slowdown leaves this for the rounding of times to nanoseconds.
constexpr double rounding_margin = 2e-6;

/// The motion of the joints along the path.
class JointMotion {
 public:
  JointMotion(const JointPath& path, const AveragedScaling& scaling)
      : path_(path), scaling_(scaling) {}

  const AveragedScaling& scaling() const { return scaling_; }

  struct State {
    Configuration q, v, a;
    Progress progress;
  };

  State at(double t) const { return at(scaling_.at(t)); }

  State at(const Progress& now) const {
    const auto next = std::upper_bound(path_.s.begin() + 1, path_.s.end() - 1, now.s);
    const auto step = static_cast<std::size_t>(next - path_.s.begin()) - 1;
    PathPoint point = point_at(step, now.s);
    return {std::move(point.q), now.speed * point.dq,
            now.acceleration * point.dq + now.speed * now.speed * point.ddq, now};
  }

 private:
  /// Grid points are returned exactly.
  PathPoint point_at(std::size_t step, double s) const {
    for (const std::size_t k : {step, step + 1}) {
      if (path_.s[k] == s) return {path_.q[k], path_.dq[k], path_.ddq[k], {}};
    }
    const double u = (s - path_.s[step]) / (path_.s[step + 1] - path_.s[step]);
    return path_point(path_, step, std::clamp(u, 0.0, 1.0));
  }

  const JointPath& path_;
  const AveragedScaling& scaling_;
};

/// A sample of the motion: its time and state.
struct Sample {
  double t;
  JointMotion::State state;
};

class Refinement {
 public:
  Refinement(const JointMotion& motion, const PathLimits& limits, const SectionOptions& options)
      : motion_(motion), limits_(limits), options_(options) {}

  /// Appends samples after `a`, up to and including `b`, as close as the interpolation needs.
  void append(std::vector<Sample>& samples, const Sample& a, const Sample& b) const {
    const double h = b.t - a.t;
    std::array<Sample, 3> inner;  // at the quarters
    for (std::size_t i = 0; i < 3; ++i) {
      const double t = a.t + h * 0.25 * static_cast<double>(i + 1);
      inner[i] = {t, motion_.at(t)};
    }
    if (h <= shortest * motion_.scaling().duration() || agrees(a, inner, b)) {
      samples.push_back(b);
      return;
    }
    append(samples, a, inner[1]);
    append(samples, inner[1], b);
  }

 private:
  bool agrees(const Sample& a, const std::array<Sample, 3>& inner, const Sample& b) const {
    const double h = b.t - a.t;
    for (Eigen::Index i = 0; i < a.state.q.size(); ++i) {
      const Polynomial p =
          options_.interpolation == Interpolation::cubic
              ? cubic_between(a.state.q[i], b.state.q[i], h * a.state.v[i], h * b.state.v[i])
              : quintic_between(a.state.q[i], b.state.q[i], h * a.state.v[i], h * b.state.v[i],
                                h * h * a.state.a[i], h * h * b.state.a[i]);
      const Polynomial v = time_derivative(p, 1, h), acceleration = time_derivative(p, 2, h);
      double error_before = acceleration(0) - a.state.a[i];
      for (std::size_t k = 0; k < 4; ++k) {
        const double u = 0.25 * static_cast<double>(k + 1);
        const JointMotion::State& exact = k < 3 ? inner[k].state : b.state;
        const double error = acceleration(u) - exact.a[i];
        if (std::abs(v(u) - exact.v[i]) > velocity_error * limits_.velocity[i]) return false;
        if (std::abs(error) > acceleration_error * limits_.acceleration[i]) return false;
        const double jerk = std::abs(error - error_before) / (0.25 * h);
        if (options_.keep_jerk && jerk > jerk_error * limits_.jerk[i]) return false;
        error_before = error;
      }
    }
    return true;
  }

  const JointMotion& motion_;
  const PathLimits& limits_;
  const SectionOptions& options_;
};

/// The samples with the columns of the interpolation.
SampledSection with_columns(const Arm& arm, const std::vector<Sample>& samples,
                            Interpolation interpolation) {
  SampledSection section;
  Trajectory& trajectory = section.trajectory;
  trajectory.joint_names = arm.joint_names();
  for (const Sample& sample : samples) {
    trajectory.times.push_back(sample.t);
    trajectory.positions.push_back(sample.state.q);
    if (interpolation != Interpolation::linear) trajectory.velocities.push_back(sample.state.v);
    if (interpolation == Interpolation::quintic) trajectory.accelerations.push_back(sample.state.a);
    section.progress.push_back(sample.state.progress);
  }
  return section;
}

/// The samples whatever the interpolation needs: the ends, the kinks of the acceleration or, for
/// linear joints, times without longer gaps, and the required ones, whose s is exact.
std::vector<Sample> first_samples(const JointMotion& motion, const TimeScaling& given,
                                  const SectionOptions& options) {
  const AveragedScaling& scaling = motion.scaling();
  const double duration = scaling.duration();
  std::vector<std::pair<double, Progress>> points{{0, scaling.at(0)},
                                                  {duration, scaling.at(duration)}};
  const auto add = [&](double t) { points.emplace_back(t, scaling.at(t)); };
  const bool linear = options.interpolation == Interpolation::linear;
  const double gaps = std::max(linear ? 1.0 : first_intervals, std::ceil(1 / options.longest_gap));
  for (double i = 1; i < gaps; ++i) add(duration * i / gaps);
  if (!linear) {
    for (const double t : scaling.kinks(large_jump)) add(t);
  }
  for (const double s : options.required) {
    if (!(s > given.s.front() && s < given.s.back())) continue;
    const double t = scaling.time_of(s);
    Progress now = scaling.at(t);
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
    const bool apart = samples.empty() || t > samples.back().t + shortest * duration;
    if (!apart && t < duration && !is_required(now.s)) continue;
    if (!apart && samples.size() > 1 && !is_required(samples.back().state.progress.s))
      samples.pop_back();
    if (samples.empty() || t > samples.back().t) samples.push_back({t, motion.at(now)});
  }
  return samples;
}

/// The limits that the samples keep: known ones, and assumed ones, but for the jerk of a profile
/// that does not keep it.
std::vector<Limits> kept_limits(const Arm& arm, const SectionOptions& options) {
  std::vector<Limits> kept;
  for (const Limits& known : arm.limits()) {
    kept.push_back(motion_limits(known));
    if (!options.keep_jerk) kept.back().jerk = known.jerk;
  }
  return kept;
}

/// The factor by which the samples must be slowed down.
double needed_slowdown(const Arm& arm, const Trajectory& trajectory,
                       const SectionOptions& options) {
  const std::vector<Limits> limits = kept_limits(arm, options);
  const auto usage = [&](int order) { return limit_fraction(limits, trajectory, order).fraction; };
  const double joints = slowdown(usage(1), usage(2), usage(3));
  double tool = 0;
  if (options.tool_speed < Limits::none) {
    tool = tool_speed_bound(arm, trajectory) / options.tool_speed;
  }
  return std::max(joints / options.speed_scale, tool);
}

/// Slows the samples down by k, and moves them to whole nanoseconds along their motion.
void slow_down_in_nanoseconds(SampledSection& section, double slower) {
  constexpr double nanosecond = 1e-9;
  Trajectory& trajectory = section.trajectory;
  slow_down(trajectory, slower);
  for (std::size_t k = 1; k < trajectory.size(); ++k) {
    const double rounded = std::round(trajectory.times[k] / nanosecond) * nanosecond;
    const double dt = rounded - trajectory.times[k];
    trajectory.times[k] = rounded;
    if (k + 1 < trajectory.size()) section.progress[k].s += dt * section.progress[k].speed / slower;
    if (trajectory.velocities.empty() || k + 1 == trajectory.size()) continue;
    trajectory.positions[k] += dt * trajectory.velocities[k];
    if (!trajectory.accelerations.empty()) {
      trajectory.velocities[k] += dt * trajectory.accelerations[k];
    }
  }
}

/// The samples before they are slowed down, with ramps of this width.
SampledSection refined_samples(const Arm& arm, const TimedPath& section,
                               const SectionOptions& options, double width) {
  const AveragedScaling scaling(section.scaling, width);
  const JointMotion motion(section.path, scaling);
  std::vector<Sample> samples = first_samples(motion, section.scaling, options);
  if (options.interpolation != Interpolation::linear) {
    const PathLimits limits = path_limits(arm, options.speed_scale);
    const Refinement refinement(motion, limits, options);
    std::vector<Sample> refined{samples.front()};
    for (std::size_t k = 1; k < samples.size(); ++k) {
      refinement.append(refined, samples[k - 1], samples[k]);
    }
    samples = std::move(refined);
  }
  SampledSection result = with_columns(arm, samples, options.interpolation);
  if (options.move) options.move(result);
  return result;
}

SampledSection without_rate(const Arm& arm, const TimedPath& section, const SectionOptions& options,
                            bool jumps) {
  double width = jumps ? ramp * section.scaling.duration() : 0;
  SampledSection result = refined_samples(arm, section, options, width);
  double factor = std::max(1.0, needed_slowdown(arm, result.trajectory, options));
  // Wider ramps where their jerk exceeds a limit, as long as they cost less than the slowdown.
  for (int attempt = 0; attempt < max_widenings && jumps && factor > worth_widening; ++attempt) {
    const double wider = width * factor * factor * factor;
    if (wider > widest_ramp * section.scaling.duration()) break;
    SampledSection tried = refined_samples(arm, section, options, wider);
    const double needed = std::max(1.0, needed_slowdown(arm, tried.trajectory, options));
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
    if (!(needed_slowdown(arm, result.trajectory, options) > 1)) return result;
  }
}

/// Throws Error for a rate with too few periods in a section, or too many.
void check_rate(double rate, double duration) {
  constexpr double min_periods = 1, max_periods = 1e6;  // some 300 MB for seven joints
  if (rate * duration > max_periods) {
    throw Error(number(rate) + " samples a second make more than " + number(max_periods) + " in " +
                number(duration) + " s");
  }
  if (rate * duration < min_periods) {
    constexpr double up = 1 + 1e-5;  // number() rounds to six digits
    throw Error(number(rate) + " samples a second leave fewer than " + number(min_periods) +
                " period in a motion of " + number(duration) + " s; the rate must be at least " +
                number(up * min_periods / duration));
  }
}

/// Samples at the rate of the motion slowed down to `periods`; its ramps take `width` of them.
SampledSection at_rate(const Arm& arm, const TimedPath& section, const SectionOptions& options,
                       double periods, double width) {
  const double slower = (periods - width) / options.rate / section.scaling.duration();
  const AveragedScaling scaling(section.scaling, width / options.rate / slower);
  const JointMotion motion(section.path, scaling);
  std::vector<Sample> samples;
  for (double k = 0; k <= periods; ++k) {
    const double t = k == periods ? scaling.duration() : k / options.rate / slower;
    samples.push_back({k / options.rate, motion.at(t)});
    JointMotion::State& state = samples.back().state;
    state.v /= slower;
    state.a /= slower * slower;
    state.progress.speed /= slower;
    state.progress.acceleration /= slower * slower;
  }
  SampledSection result = with_columns(arm, samples, options.interpolation);
  if (options.move) options.move(result);
  return result;
}

}  // namespace

SampledSection sample_section(const Arm& arm, const TimedPath& section,
                              const SectionOptions& options) {
  const bool jumps = !section.scaling.smooth && options.interpolation != Interpolation::linear;
  if (!(options.rate > 0)) return without_rate(arm, section, options, jumps);
  check_rate(options.rate, section.scaling.duration());
  // Wider ramps take longer, and need less of a slowdown, as they extend over more samples.
  constexpr double narrowest = 0.5, widest = 2;  // periods
  const double fastest = section.scaling.duration() * options.rate;
  double periods = std::max(1.0, std::ceil(fastest + (jumps ? narrowest : -1e-6)));
  for (int tries = 0; tries < max_tries; ++tries) {
    double least = Limits::none;
    for (const double width : {std::min(periods - fastest, widest), 1.0, 0.0}) {
      if (width > periods - fastest || (width < narrowest && jumps)) continue;
      SampledSection tried = at_rate(arm, section, options, periods, std::max(0.0, width));
      const double factor = needed_slowdown(arm, tried.trajectory, options);
      if (!(factor > 1)) return tried;
      least = std::min(least, factor);
    }
    // Most of the slowdown at once: the excess is at few samples, and others are the worst later.
    constexpr double at_once = 0.7;
    const double excess = std::min(least - 1, 1e3);
    periods = std::max(periods + 1, std::floor(periods * (1 + at_once * excess)));
  }
  throw Error("no samples were found that keep the limits at " + number(options.rate) +
              " samples a second; try another rate");
}

}  // namespace beeline::internal
