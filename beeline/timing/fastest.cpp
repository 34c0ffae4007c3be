#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/timing/fastest.h>
#include <beeline/timing/internal/step_polygon.h>

namespace beeline {
namespace {

constexpr double shortest_duration = 1e-3;  // seconds: times increase even where nothing moves

double squared(double x) { return x * x; }

/// The middle of a step for one joint: of the quintic that has the path's values at both ends.
struct Middle {
  double dq, ddq;
};
inline Middle middle(const JointPath& path, std::size_t k, Eigen::Index i, double h) {
  const double d0 = path.dq[k][i], d1 = path.dq[k + 1][i];
  const double c0 = path.ddq[k][i], c1 = path.ddq[k + 1][i];
  const double chord = (path.q[k + 1][i] - path.q[k][i]) / h;
  return {1.875 * chord - 0.4375 * (d0 + d1) - h / 32 * (c0 - c1),
          1.5 * (d1 - d0) / h - 0.25 * (c0 + c1)};
}

/// A path with limits, in the form that both passes ask for.
class Passes {
 public:
  Passes(const JointPath& path, const PathLimits& limits)
      : path_(path),
        limits_(limits),
        slowness_(limits.velocity.cwiseInverse()),
        polygon_(strips_, strips_of_a_step()) {
    prepare();
  }

  double most(std::size_t k) const { return max_[k]; }

  SquaredSpeeds begins(std::size_t k, const SquaredSpeeds& ends) {
    polygon_.go_to(k * strips_of_a_step());
    return polygon_.begins(ends, max_[k]);
  }

  double furthest_end(std::size_t k, double x, const SquaredSpeeds& ends) {
    polygon_.go_to(k * strips_of_a_step());
    return polygon_.furthest_end(x, ends);
  }

  /// From here on the limits of velocity count as lower by this factor.
  void slow_down(double factor) {
    slowness_ *= factor;
    const double begin = max_.front(), end = max_.back();  // the speeds asked for there stay
    prepare();
    max_.front() = begin;
    max_.back() = end;
  }

  /// The largest share of a velocity limit between the places at which the strips keep it.
  double largest_share(const std::vector<double>& b) const {
    double largest = 0;
    for (std::size_t k = 0; k + 1 < path_.size(); ++k) {
      const double h = path_.s[k + 1] - path_.s[k], most = std::max(b[k], b[k + 1]);
      for (Eigen::Index i = 0; i < slowness_.size(); ++i) {
        const double d0 = path_.dq[k][i], d1 = path_.dq[k + 1][i], mid = middle(path_, k, i, h).dq;
        const double scale = squared(slowness_[i]);
        if (std::max({d0 * d0, mid * mid, d1 * d1}) * scale * most < 0.9) continue;
        for (const double x : {0.125, 0.375, 0.625, 0.875}) {
          const double slope =
              (1 - x) * (1 - 2 * x) * d0 + 4 * x * (1 - x) * mid + x * (2 * x - 1) * d1;
          largest = std::max(largest, slope * slope * scale * ((1 - x) * b[k] + x * b[k + 1]));
        }
      }
    }
    return std::sqrt(largest);
  }

 private:
  std::size_t strips_of_a_step() const {
    return static_cast<std::size_t>(3 * slowness_.size() + 3);
  }

  void prepare() {
    const double fastest = squared((path_.s.back() - path_.s.front()) / shortest_duration);
    max_.resize(path_.size());
    for (std::size_t k = 0; k < path_.size(); ++k) {
      double slowest = path_.dq[k].cwiseAbs().cwiseProduct(slowness_).maxCoeff();
      if (!limits_.speed.empty()) slowest = std::max(slowest, 1 / limits_.speed[k]);
      max_[k] = std::min(fastest, 1 / squared(slowest));
    }
    strips_.along.resize((path_.size() - 1) * strips_of_a_step());
    strips_.across.resize(strips_.along.size());
    for (std::size_t k = 0; k + 1 < path_.size(); ++k) prepare_step(k);
  }

  /// With u = (y - x) / 2h a joint's acceleration is q' u + q'' b, a parabola of s where the path
  /// is cubic: within its limit where the three coefficients of its Bernstein form are. Its
  /// velocity is within at the ends, by `most`, and here at the quarters.
  void prepare_step(std::size_t k) {
    const double h = path_.s[k + 1] - path_.s[k], half = 0.5 / h;
    double* along = &strips_.along[k * strips_of_a_step()];
    double* across = &strips_.across[k * strips_of_a_step()];
    double slowest[3] = {0, 0, 0};  // inverse of the speed at each quarter of the step
    for (Eigen::Index i = 0; i < slowness_.size(); ++i) {
      const double d0 = path_.dq[k][i], d1 = path_.dq[k + 1][i];
      const double scale = 1 / limits_.acceleration[i];
      const Middle mid = middle(path_, k, i, h);
      const double push0 = d0 * half, push = mid.dq * half, push1 = d1 * half;
      const double x0 = path_.ddq[k][i] - push0, y1 = path_.ddq[k + 1][i] + push1;
      *along++ = x0 * scale;
      *across++ = push0 * scale;
      *along++ = (mid.ddq - 2 * push - 0.5 * (x0 - push1)) * scale;
      *across++ = (mid.ddq + 2 * push - 0.5 * (push0 + y1)) * scale;
      *along++ = -push1 * scale;
      *across++ = y1 * scale;
      const double first = 0.375 * d0 + 0.75 * mid.dq - 0.125 * d1;
      const double third = -0.125 * d0 + 0.75 * mid.dq + 0.375 * d1;
      slowest[0] = std::max(slowest[0], std::abs(first) * slowness_[i]);
      slowest[1] = std::max(slowest[1], std::abs(mid.dq) * slowness_[i]);
      slowest[2] = std::max(slowest[2], std::abs(third) * slowness_[i]);
    }
    for (int j = 0; j < 3; ++j) {
      const double share = 0.25 * (j + 1), most = squared(slowest[j]);
      *along++ = (1 - share) * most;
      *across++ = share * most;
    }
  }

  const JointPath& path_;
  const PathLimits& limits_;
  Configuration slowness_;  ///< inverses of the limits of velocity
  Strips strips_;           ///< of all steps
  StepPolygon polygon_;
  std::vector<double> max_;
};

/// Both passes, into b: the squared speeds at the grid points. Returns why there are none; empty
/// when there are.
std::string squared_speeds(const JointPath& path, const EndSpeeds& ends, Passes& passes,
                           std::vector<double>& b) {
  const std::size_t last = path.size() - 1;
  const double within = 1 + 1e-9;  // a speed that was computed to be the largest is not refused
  if (squared(ends.end) > passes.most(last) * within) {
    return "the speed at the path's end is above its limits: " + number(ends.end) + " instead of " +
           number(std::sqrt(passes.most(last)));
  }
  std::vector<SquaredSpeeds> controllable(last + 1);
  controllable[last].least = controllable[last].most = squared(ends.end);
  for (std::size_t k = last; k-- > 0;) {
    controllable[k] = passes.begins(k, controllable[k + 1]);
    if (!controllable[k].none()) continue;
    return "the speed at the path's end cannot be reached: no speed at s = " + number(path.s[k]) +
           " leads to it within the limits";
  }
  b.assign(last + 1, 0);
  b[0] = squared(ends.begin);
  if (b[0] > controllable[0].most * within || b[0] * within < controllable[0].least) {
    const bool high = b[0] > controllable[0].most;
    return "the speed at the path's begin, " + number(ends.begin) + ", is too " +
           (high ? "high" : "low") + " for what follows, which takes " +
           number(std::sqrt(high ? controllable[0].most : controllable[0].least));
  }
  for (std::size_t k = 0; k < last; ++k) {
    b[k + 1] = passes.furthest_end(k, b[k], controllable[k + 1]);
    if (b[k] + b[k + 1] > 0) continue;
    return "from s = " + number(path.s[k]) + " on the path cannot be moved along";
  }
  return {};
}

/// The squared speeds of the grid points as a scaling, slower by a factor.
TimeScaling timed(const JointPath& path, const std::vector<double>& b, double slower) {
  const std::size_t points = path.size();
  TimeScaling scaling;
  scaling.s = path.s;
  scaling.t.resize(points);
  scaling.speed.resize(points);
  scaling.acceleration.resize(points);
  double before = 0;
  for (std::size_t k = 0; k < points; ++k) {
    scaling.speed[k] = std::sqrt(b[k]) / slower;
    if (k > 0) {
      scaling.t[k] = scaling.t[k - 1] +
                     2 * (path.s[k] - path.s[k - 1]) / (scaling.speed[k - 1] + scaling.speed[k]);
    }
    const bool last = k + 1 == points;
    const double after =
        last ? before : 0.5 * (b[k + 1] - b[k]) / (path.s[k + 1] - path.s[k]) / squared(slower);
    scaling.acceleration[k] = k == 0 ? after : 0.5 * (before + after);
    before = after;
  }
  return scaling;
}

void check(const JointPath& path, const PathLimits& limits, const EndSpeeds& ends) {
  check_path(path);
  check_limits(limits, path);
  for (const double speed : {ends.begin, ends.end}) {
    if (speed >= 0 && std::isfinite(speed)) continue;
    throw Error("a path's speed at an end must be zero or more, not " + number(speed));
  }
}

}  // namespace

TimeScaling fastest(const JointPath& path, const PathLimits& limits, const EndSpeeds& ends) {
  check(path, limits, ends);
  Passes passes(path, limits);
  std::vector<double> b;
  std::string reason = squared_speeds(path, ends, passes, b);
  const double found = reason.empty() ? passes.largest_share(b) : 0;
  const double over = found + 0.25 * std::max(0.0, found - 1);  // its peaks are between eighths
  const bool at_rest = ends.begin == 0 && ends.end == 0;
  if (at_rest && over <= 1.001) return timed(path, b, std::max(over, 1.0));
  if (over > 1) {
    passes.slow_down(over * (1 + 1e-9));
    reason = squared_speeds(path, ends, passes, b);
  }
  if (reason.empty()) return timed(path, b, 1);
  TimeScaling none;
  none.reason = std::move(reason);
  return none;
}

}  // namespace beeline
