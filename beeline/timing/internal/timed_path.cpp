#include <algorithm>
#include <cmath>

#include <beeline/timing/internal/timed_path.h>

namespace beeline {
namespace {

/// Where the scaling is at one time.
struct Progress {
  double s, speed, acceleration;
};

Progress point(const TimeScaling& scaling, std::size_t k) {
  return {scaling.s[k], scaling.speed[k], scaling.acceleration[k]};
}

/// `x` seconds into step k of the scaling: with constant acceleration, or the quintic that
/// continues the acceleration on both sides.
Progress progress(const TimeScaling& scaling, std::size_t k, double x) {
  const double h = scaling.t[k + 1] - scaling.t[k], way = scaling.s[k + 1] - scaling.s[k];
  const double v0 = scaling.speed[k], v1 = scaling.speed[k + 1];
  if (!scaling.smooth) {
    const double a = (v1 - v0) / h;
    return {scaling.s[k] + x * (v0 + 0.5 * x * a), v0 + x * a, a};
  }
  const double c1 = h * v0, c2 = 0.5 * h * h * scaling.acceleration[k];
  const double r0 = way - c1 - c2, r1 = h * v1 - c1 - 2 * c2;
  const double r2 = h * h * scaling.acceleration[k + 1] - 2 * c2;
  const double c3 = 10 * r0 - 4 * r1 + 0.5 * r2, c4 = -15 * r0 + 7 * r1 - r2;
  const double c5 = 6 * r0 - 3 * r1 + 0.5 * r2, u = x / h;
  return {scaling.s[k] + u * (c1 + u * (c2 + u * (c3 + u * (c4 + u * c5)))),
          (c1 + u * (2 * c2 + u * (3 * c3 + u * (4 * c4 + u * 5 * c5)))) / h,
          (2 * c2 + u * (6 * c3 + u * (12 * c4 + u * 20 * c5))) / (h * h)};
}

/// Goes along a path and writes down where it is.
class Writer {
 public:
  Writer(Trajectory& trajectory, const JointPath& path) : trajectory_(trajectory), path_(path) {}

  /// Times must not go back. Returns whether it was written.
  bool write(double t, const Progress& now) {
    while (step_ + 2 < path_.size() && path_.s[step_ + 1] <= now.s) ++step_;
    if (!trajectory_.times.empty() && !(t > trajectory_.times.back())) return false;
    PathPoint place = place_of(now.s);
    trajectory_.times.push_back(t);
    trajectory_.positions.push_back(std::move(place.q));
    trajectory_.velocities.push_back(now.speed * place.dq);
    trajectory_.accelerations.push_back(now.acceleration * place.dq +
                                        now.speed * now.speed * place.ddq);
    return true;
  }

 private:
  /// Grid points are given back exactly.
  PathPoint place_of(double s) const {
    for (const std::size_t k : {step_, step_ + 1}) {
      if (path_.s[k] == s) return {path_.q[k], path_.dq[k], path_.ddq[k], {}};
    }
    const double share = (s - path_.s[step_]) / (path_.s[step_ + 1] - path_.s[step_]);
    return path_point(path_, step_, std::clamp(share, 0.0, 1.0));
  }

  Trajectory& trajectory_;
  const JointPath& path_;
  std::size_t step_ = 0;
};

}  // namespace

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

Trajectory at_rate(const std::vector<TimedPath>& motions, double rate, std::vector<double>& ways) {
  Trajectory trajectory;
  ways.clear();
  const double hair = 1e-6 / rate;  // a time this near to the end is the end
  double begin = 0, count = 0, way = 0;
  for (const TimedPath& motion : motions) {
    const TimeScaling& scaling = motion.scaling;
    Writer writer(trajectory, motion.path);
    std::size_t k = 0;
    const bool last = &motion == &motions.back();
    const double end = begin + scaling.duration();
    for (; count / rate < end - (last ? hair : 0); ++count) {
      const double t = count / rate - begin;
      while (k + 2 < scaling.t.size() && scaling.t[k + 1] <= t) ++k;
      const Progress now =
          t <= scaling.t[k] ? point(scaling, k) : progress(scaling, k, t - scaling.t[k]);
      if (writer.write(count / rate, now)) ways.push_back(way + now.s - scaling.s.front());
    }
    way += scaling.s.back() - scaling.s.front();
    if (last && writer.write(end, point(scaling, scaling.t.size() - 1))) ways.push_back(way);
    begin = end;
  }
  return trajectory;
}

}  // namespace beeline
