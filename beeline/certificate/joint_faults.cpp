#include <algorithm>
#include <cmath>
#include <numbers>
#include <ostream>

#include <beeline/certificate/internal/mean_derivative.h>
#include <beeline/certificate/joint_faults.h>
#include <beeline/math/hermite.h>

namespace beeline {

using namespace internal;

namespace {

// A velocity, acceleration or jerk may exceed its limit by this fraction: rounding of motions that
// use their limits fully.
constexpr double limit_slack = 1e-6;
constexpr std::size_t stencil = 3;  // steps of a third difference, the longest

std::string quantity(const Arm& arm, int i, double value, const std::string& per = "") {
  return number(value) + " " + unit(arm.joint_of(i)) + per;
}

class FaultSearch {
 public:
  FaultSearch(const Arm& arm, const Trajectory& trajectory)
      : arm_(arm),
        trajectory_(trajectory),
        t_(trajectory.times),
        q_(trajectory.positions),
        v_(trajectory.velocities) {}

  std::optional<JointFault> first() {
    for (std::size_t k = 0; k < t_.size(); ++k) {
      for (int i = 0; i < arm_.dof() && !found_; ++i) check_positions(k, i);
      if (found_) return found_;
      for (int i = 0; i < arm_.dof() && !found_; ++i) check_derivatives(k, i);
      if (found_) break;
    }
    // A jump in position also exceeds limits in the differences before it; the jump itself is
    // reported.
    const std::optional<JointFault> derivative_fault = found_;
    if (!derivative_fault) return {};
    const std::size_t end = std::min(derivative_fault->sample + stencil + 1, t_.size());
    for (std::size_t k = derivative_fault->sample + 1; k < end; ++k) {
      found_.reset();
      for (int i = 0; i < arm_.dof() && !found_; ++i) check_positions(k, i);
      if (found_) return found_;
    }
    return derivative_fault;
  }

 private:
  void check_positions(std::size_t k, int i) {
    const Limits& limits = arm_.limits(i);
    const auto inside = [&](double q) { return within_position_limits(limits, q); };
    const double here = q_[k][i];
    if (!inside(here)) {
      return report(Fault::limits, k, i,
                    "is at " + quantity(arm_, i, here) + ", outside " + range(i));
    }
    if (k + 1 == t_.size()) return;
    const double h = t_[k + 1] - t_[k], step = q_[k + 1][i] - q_[k][i];
    const bool prismatic = kind(arm_.joint_of(i)) == JointKind::prismatic;
    if (!prismatic && std::abs(step) >= std::numbers::pi) {
      return report(Fault::flip, k, i,
                    "rotates by " + number(step) + " rad to the next sample, " +
                        number(std::abs(step) / (2 * std::numbers::pi)) + " revolutions");
    }
    if (v_.empty() || !inside(q_[k + 1][i])) return;  // reported at the next sample
    const auto [lowest, highest] =
        extremes(cubic_between(here, q_[k + 1][i], v_[k][i], v_[k + 1][i], h));
    if (inside(lowest) && inside(highest)) return;
    report(Fault::limits, k, i,
           "moves to " + quantity(arm_, i, inside(lowest) ? highest : lowest) +
               " before the next sample, by the cubic with its velocities: outside " + range(i));
  }

  void check_derivatives(std::size_t k, int i) {
    const Limits& limits = arm_.limits(i);
    check_derivative(Fault::velocity, k, i, 1, limits.velocity, "/s");
    check_derivative(Fault::acceleration, k, i, 2, limits.acceleration, "/s^2");
    check_derivative(Fault::jerk, k, i, 3, limits.jerk, "/s^3");
  }

  void check_derivative(Fault fault, std::size_t k, int i, int order, double limit,
                        const char* per) {
    if (found_ || !(limit < Limits::none)) return;
    const double value = mean_derivative(trajectory_, k, i, order);
    if (value <= limit * (1 + limit_slack)) return;
    report(fault, k, i,
           "needs " + quantity(arm_, i, value, per) + " over the next samples; its limit is " +
               quantity(arm_, i, limit, per));
  }

  std::string range(int i) const {
    const Limits& limits = arm_.limits(i);
    return "its limits of " + number(limits.lower) + " to " + quantity(arm_, i, limits.upper);
  }

  void report(Fault fault, std::size_t k, int i, const std::string& what) {
    if (!found_) found_ = {fault, k, "joint " + arm_.joint_of(i).name + " " + what};
  }

  const Arm& arm_;
  const Trajectory& trajectory_;
  const std::vector<double>& t_;
  const std::vector<Configuration>&q_, &v_;
  std::optional<JointFault> found_;
};

}  // namespace

std::string name(Fault fault) {
  constexpr const char* names[] = {"none",        "limits",   "flip",         "deviation",
                                   "not_through", "velocity", "acceleration", "jerk"};
  return names[static_cast<int>(fault)];
}

std::ostream& operator<<(std::ostream& out, Fault fault) { return out << name(fault); }

std::optional<JointFault> first_joint_fault(const Arm& arm, const Trajectory& trajectory) {
  check_fits(arm, trajectory);
  return FaultSearch(arm, trajectory).first();
}

}  // namespace beeline
