#include <algorithm>
#include <cmath>

#include <beeline/math/hermite.h>
#include <beeline/timing/internal/timed_path.h>

namespace beeline::internal {
namespace {

/// s and its time derivatives at one time.
struct Progress {
  double s, speed, acceleration;
};

Progress point(const TimeScaling& scaling, std::size_t k) {
  return {scaling.s[k], scaling.speed[k], scaling.acceleration[k]};
}

/// The progress `x` seconds after point k of the scaling, before the next point.
Progress progress(const TimeScaling& scaling, std::size_t k, double x) {
  const double h = scaling.t[k + 1] - scaling.t[k], s0 = scaling.s[k];
  const double v0 = scaling.speed[k], v1 = scaling.speed[k + 1];
  if (!scaling.smooth) {
    const double a = (v1 - v0) / h;
    return {s0 + x * (v0 + 0.5 * x * a), v0 + x * a, a};
  }
  const Quintic<double> quintic =
      quintic_between(scaling.s[k + 1] - s0, h * v0, h * h * scaling.acceleration[k], h * v1,
                      h * h * scaling.acceleration[k + 1]);
  const double u = x / h;
  return {s0 + quintic.change(u), quintic.first(u) / h, quintic.second(u) / (h * h)};
}

/// Appends samples of a path to a trajectory.
class Writer {
 public:
  Writer(Trajectory& trajectory, const JointPath& path) : trajectory_(trajectory), path_(path) {}

  /// Appends the sample at time t unless t is that of the last one. Path parameters must not
  /// decrease. Returns whether it was appended.
  bool write(double t, const Progress& now) {
    while (step_ + 2 < path_.size() && path_.s[step_ + 1] <= now.s) ++step_;
    if (!trajectory_.times.empty() && !(t > trajectory_.times.back())) return false;
    PathPoint point = point_at(now.s);
    trajectory_.times.push_back(t);
    trajectory_.positions.push_back(std::move(point.q));
    trajectory_.velocities.push_back(now.speed * point.dq);
    trajectory_.accelerations.push_back(now.acceleration * point.dq +
                                        now.speed * now.speed * point.ddq);
    return true;
  }

 private:
  /// Grid points are returned exactly.
  PathPoint point_at(double s) const {
    for (const std::size_t k : {step_, step_ + 1}) {
      if (path_.s[k] == s) return {path_.q[k], path_.dq[k], path_.ddq[k], {}};
    }
    const double u = (s - path_.s[step_]) / (path_.s[step_ + 1] - path_.s[step_]);
    return path_point(path_, step_, std::clamp(u, 0.0, 1.0));
  }

  Trajectory& trajectory_;
  const JointPath& path_;
  std::size_t step_ = 0;
};

}  // namespace

void slow_down(TimeScaling& scaling, double k) {
  for (double& t : scaling.t) t *= k;
  for (double& v : scaling.speed) v /= k;
  for (double& a : scaling.acceleration) a /= k * k;
}

void append_points(Trajectory& trajectory, const TimedPath& motion, double gap) {
  const double begin = trajectory.times.empty() ? 0 : trajectory.times.back();
  const TimeScaling& scaling = motion.scaling;
  Writer writer(trajectory, motion.path);
  for (std::size_t k = 0; k < scaling.t.size(); ++k) {
    writer.write(begin + scaling.t[k], point(scaling, k));
    if (k + 1 == scaling.t.size()) break;
    const double h = scaling.t[k + 1] - scaling.t[k], parts = std::ceil(h / gap);
    for (double part = 1; part < parts; ++part) {
      const double x = h * part / parts;
      writer.write(begin + scaling.t[k] + x, progress(scaling, k, x));
    }
  }
}

Trajectory at_rate(const std::vector<TimedPath>& motions, double rate,
                   std::vector<double>& arc_lengths) {
  Trajectory trajectory;
  arc_lengths.clear();
  const double tolerance = 1e-6 / rate;  // times this near to the end count as the end
  double begin = 0, count = 0, length = 0;
  for (const TimedPath& motion : motions) {
    const TimeScaling& scaling = motion.scaling;
    Writer writer(trajectory, motion.path);
    std::size_t k = 0;
    const bool last = &motion == &motions.back();
    const double end = begin + scaling.duration();
    for (; count / rate < end - (last ? tolerance : 0); ++count) {
      const double t = count / rate - begin;
      while (k + 2 < scaling.t.size() && scaling.t[k + 1] <= t) ++k;
      const Progress now =
          t <= scaling.t[k] ? point(scaling, k) : progress(scaling, k, t - scaling.t[k]);
      if (writer.write(count / rate, now))
        arc_lengths.push_back(length + now.s - scaling.s.front());
    }
    length += scaling.s.back() - scaling.s.front();
    if (last && writer.write(end, point(scaling, scaling.t.size() - 1)))
      arc_lengths.push_back(length);
    begin = end;
  }
  return trajectory;
}

}  // namespace beeline::internal
