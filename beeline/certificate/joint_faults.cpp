#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <ostream>

#include <beeline/certificate/joint_faults.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/internal/rounded_number.h>
#include <beeline/math/revolution.h>
#include <beeline/trajectory/internal/end_velocity.h>
#include <beeline/trajectory/internal/interval_polynomial.h>
#include <beeline/trajectory/internal/mean_derivative.h>

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

/// The same, with the digits that show it to differ from a limit.
std::string excess_quantity(const Arm& arm, int i, double value, double limit,
                            const std::string& per) {
  return number_apart(value, limit) + " " + unit(arm.joint_of(i)) + per;
}

class FaultSearch {
 public:
  FaultSearch(const Arm& arm, const Trajectory& trajectory, const MovingEnds& moving, double slack)
      : arm_(arm),
        moving_(moving),
        slack_(slack),
        trajectory_(trajectory),
        t_(trajectory.times),
        q_(trajectory.positions),
        v_(trajectory.velocities) {}

  std::optional<JointFault> first(BudgetMeter& budget) {
    constexpr std::size_t batch = 64;  // samples, of about a microsecond
    for (std::size_t k = 0; k < t_.size(); ++k) {
      if (k % batch == 0 && budget.ended(batch)) return {};
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
                    "is at " + quantity(arm_, i, here) + ", outside " + range(i, here));
    }
    if (k + 1 == t_.size()) return;
    const double step = q_[k + 1][i] - q_[k][i];
    const bool prismatic = kind(arm_.joint_of(i)) == JointKind::prismatic;
    if (!prismatic && std::abs(step) >= std::numbers::pi) {
      return report(Fault::flip, k, i,
                    "rotates by " + number(step) + " rad to the next sample, " +
                        number(std::abs(step) / (revolution)) + " revolutions");
    }
    if (v_.empty() || !inside(q_[k + 1][i])) return;  // reported at the next sample
    const Polynomial p = interval_polynomial(trajectory_, k, i);
    Extremes between = enclosure(p);
    if (inside(between.smallest) && inside(between.largest)) return;
    between = extremes(p);
    if (inside(between.smallest) && inside(between.largest)) return;
    const double extreme = inside(between.smallest) ? between.largest : between.smallest;
    report(Fault::limits, k, i,
           "moves to " + quantity(arm_, i, extreme) + " before the next sample, by the " +
               name(trajectory_.interpolation()) + " with its velocities: outside " +
               range(i, extreme));
  }

  void check_derivatives(std::size_t k, int i) {
    const Limits &known = arm_.limits(i), limits = motion_limits(known);
    check_rest(k, i);
    check_derivative(Fault::velocity, k, i, 1, limits.velocity, known.velocity, "/s");
    check_derivative(Fault::acceleration, k, i, 2, limits.acceleration, known.acceleration, "/s^2");
    check_derivative(Fault::jerk, k, i, 3, known.jerk, known.jerk, "/s^3");
  }

  /// How much the rounding of times to doubles may change a derivative of a coordinate that moves
  /// at `velocity`, at most a fraction of the limit: a time that is off by dt moves the position by
  /// velocity * dt. It matters after a dwell of hours; between samples of some microseconds jerk is
  /// then known to its limit at best.
  double time_rounding(std::size_t k, int order, double velocity, double limit) const {
    constexpr double factors[] = {2, 20, 300};     // of the polynomials of one interval, at most
    constexpr double largest[] = {1e-4, 1e-4, 1};  // of the limit
    const std::size_t end = std::min(k + static_cast<std::size_t>(order), t_.size() - 1);
    double shortest = Limits::none;
    for (std::size_t j = k; j < end; ++j) shortest = std::min(shortest, t_[j + 1] - t_[j]);
    const double dt = std::numeric_limits<double>::epsilon() * std::abs(t_[end]);
    const double change = factors[order - 1] * velocity * dt / std::pow(shortest, order);
    return std::min(change, largest[order - 1] * limit);
  }

  /// `known` is the joint's own limit, infinite where `limit` is assumed.
  void check_derivative(Fault fault, std::size_t k, int i, int order, double limit, double known,
                        const char* per) {
    if (found_ || !(limit < Limits::none)) return;
    const auto allowed = [&](double value) {
      const double excess = value - limit * (1 + slack_);
      return excess <= 0 ||
             excess <= time_rounding(k, order, motion_limits(arm_.limits(i)).velocity, limit);
    };
    const auto limit_text = [&] {
      const std::string value = quantity(arm_, i, limit, per);
      return known < Limits::none ? "its limit is " + value
                                  : "its limit is not known, " + value +
                                        " is assumed (--limits or --" + name(fault) + " gives it)";
    };
    if (order > bounded_order(trajectory_.interpolation())) {
      const double needed = needed_derivative(trajectory_, k, i, order);
      if (allowed(needed)) return;
      return report(fault, k, i,
                    "needs " + excess_quantity(arm_, i, needed, limit, per) +
                        " over the next samples; " + limit_text());
    }
    if (k + 1 == t_.size()) return;
    const Polynomial p =
        time_derivative(interval_polynomial(trajectory_, k, i), order, t_[k + 1] - t_[k]);
    const auto largest = [](const Extremes& of) { return std::max(-of.smallest, of.largest); };
    if (allowed(largest(enclosure(p)))) return;
    const double reached = largest(extremes(p));
    if (allowed(reached)) return;
    report(fault, k, i,
           "reaches " + excess_quantity(arm_, i, reached, limit, per) +
               " before the next sample; " + limit_text());
  }

  /// Whether a coordinate moves at the start or the end.
  void check_rest(std::size_t k, int i) {
    const bool first = k == 0, last = k + 1 == t_.size();
    if (found_ || t_.size() < 2 || !((first && !moving_.start) || (last && !moving_.end))) return;
    const EndVelocity end = end_velocity(trajectory_, i, motion_limits(arm_.limits(i)),
                                         first ? TrajectoryEnd::first : TrajectoryEnd::last);
    if (end.at_rest()) return;
    report(Fault::moving, k, i,
           std::string(first ? "starts" : "ends") + " at " + quantity(arm_, i, end.velocity, "/s") +
               ", not at rest");
  }

  /// "its limits of 0 to 1 rad", with the excess of q where the digits do not show it.
  std::string range(int i, double q) const {
    const Limits& limits = arm_.limits(i);
    const double limit = q > limits.upper ? limits.upper : limits.lower;
    return "its limits of " + number(limits.lower) + " to " + quantity(arm_, i, limits.upper) +
           (number(q) == number(limit) ? " by " + quantity(arm_, i, std::abs(q - limit)) : "");
  }

  void report(Fault fault, std::size_t k, int i, const std::string& what) {
    if (!found_) found_ = {fault, k, "joint " + arm_.joint_of(i).name + " " + what};
  }

  const Arm& arm_;
  MovingEnds moving_;
  double slack_;  ///< fraction by which derivatives may exceed their limits
  const Trajectory& trajectory_;
  const std::vector<double>& t_;
  const std::vector<Configuration>&q_, &v_;
  std::optional<JointFault> found_;
};

}  // namespace

std::string name(Fault fault) {
  constexpr const char* names[] = {"none",      "limits",      "flip",     "deviation",
                                   "backwards", "not_through", "velocity", "acceleration",
                                   "jerk",      "moving",      "dwell",    "tool_speed"};
  return names[static_cast<int>(fault)];
}

std::ostream& operator<<(std::ostream& out, Fault fault) { return out << name(fault); }

std::optional<JointFault> first_joint_fault(const Arm& arm, const Trajectory& trajectory,
                                            const MovingEnds& moving, const Budget& budget,
                                            double limit_tolerance) {
  check_fits(arm, trajectory);
  check_limit_tolerance(limit_tolerance);
  BudgetMeter meter(budget);
  return FaultSearch(arm, trajectory, moving, std::max(limit_slack, limit_tolerance)).first(meter);
}

void internal::check_limit_tolerance(double limit_tolerance) {
  constexpr double largest = 0.1;
  if (limit_tolerance >= 0 && limit_tolerance <= largest) return;
  throw Error("limit_tolerance must be from 0 to 0.1, not " + number(limit_tolerance));
}

}  // namespace beeline
