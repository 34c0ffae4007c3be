#include <algorithm>

#include <beeline/kinematics/internal/tool_motion.h>
#include <beeline/kinematics/internal/tool_taylor_bound.h>
#include <beeline/trajectory/internal/interval_polynomial.h>
#include <beeline/trajectory/internal/tool_speed.h>

namespace beeline::internal {
namespace {

constexpr int max_depth = 8;                      // of halving
constexpr double small_remainder = 1e-3;          // of a bound that is not refined
constexpr double remainder_factor = 120.0 / 384;  // 5! / 384, of the fifth Taylor bound

class SpeedBound {
 public:
  SpeedBound(const Arm& arm, double known) : arm_(arm), known_(known), largest_(known) {}

  /// Takes an interval of h seconds into account.
  void take(const std::vector<Polynomial>& coordinates, double h, int depth = 0) {
    const auto [v0, a0] = velocity(coordinates, 0);
    const auto [v1, a1] = velocity(coordinates, 1);
    const double at_ends =
        std::max({v0.norm(), (v0 + a0 / 3).norm(), (v1 - a1 / 3).norm(), v1.norm()});
    reached_ = std::max({reached_, v0.norm() / h, v1.norm() / h});
    const double remainder = remainder_factor * tool_taylor_bound(arm_, coordinates).position.c[5];
    const double bound = (at_ends + remainder) / h;
    if (bound <= std::max(largest_, reached_)) return;
    // Whether the speed exceeds a known bound is decided more precisely.
    const bool is_undecided = known_ > 0 && reached_ <= known_;
    const bool tight = !is_undecided && at_ends + remainder <=
                                            (1 + small_remainder) * std::max(v0.norm(), v1.norm());
    if (tight || depth == max_depth) {
      largest_ = bound;
      return;
    }
    std::vector<Polynomial> first, second;
    for (const Polynomial& p : coordinates) {
      first.push_back(p.part(0, 0.5));
      second.push_back(p.part(0.5, 1));
    }
    take(first, h / 2, depth + 1);
    take(second, h / 2, depth + 1);
  }

  double largest() const { return std::max(largest_, reached_); }

 private:
  struct Velocity {
    Vector3 value, derivative;
  };

  Velocity velocity(const std::vector<Polynomial>& coordinates, double u) const {
    const PoseMotion tool = tool_motion(arm_, coordinates, u);
    return {tool.velocity.head<3>(), tool.acceleration.head<3>()};
  }

  const Arm& arm_;
  double known_, largest_, reached_ = 0;
};

}  // namespace

double tool_speed_bound(const Arm& arm, const Trajectory& trajectory, BudgetMeter& budget) {
  SpeedBound bound(arm, 0);
  for (std::size_t k = 0; k + 1 < trajectory.size() && !budget.ended(); ++k) {
    bound.take(interval_polynomials(trajectory, k), trajectory.times[k + 1] - trajectory.times[k]);
  }
  return bound.largest();
}

std::vector<double> tool_speed_bounds(const Arm& arm, const Trajectory& trajectory,
                                      const std::vector<double>& known) {
  std::vector<double> bounds;
  for (std::size_t k = 0; k + 1 < trajectory.size(); ++k) {
    SpeedBound bound(arm, known[k]);
    bound.take(interval_polynomials(trajectory, k), trajectory.times[k + 1] - trajectory.times[k]);
    bounds.push_back(bound.largest());
  }
  return bounds;
}

}  // namespace beeline::internal
