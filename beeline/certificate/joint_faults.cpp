#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <beeline/certificate/internal/fault_list.h>
#include <beeline/certificate/internal/recovery_check.h>
#include <beeline/certificate/verify.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/internal/enum_names.h>
#include <beeline/model/internal/joint_reason.h>
#include <beeline/trajectory/internal/end_velocity.h>
#include <beeline/trajectory/internal/interval_polynomial.h>
#include <beeline/trajectory/internal/mean_derivative.h>
#include <beeline/trajectory/internal/recovery.h>

namespace beeline {

using namespace internal;

namespace {

// Fraction by which a velocity, acceleration or jerk may exceed its limit. It covers the rounding
// of motions that use their limits fully.
constexpr double limit_slack = 1e-6;
constexpr std::size_t stencil = 3;  // steps of the longest difference, the third

class FaultSearch {
 public:
  FaultSearch(const Arm& arm, const Trajectory& trajectory, const MovingEnds& moving,
              double limit_tolerance, double recover)
      : arm_(arm),
        moving_(moving),
        slack_(std::max(limit_slack, limit_tolerance)),
        trajectory_(trajectory),
        t_(trajectory.times),
        q_(trajectory.positions),
        v_(trajectory.velocities),
        recovery_(arm, trajectory, recover) {}

  std::optional<JointFault> first(BudgetMeter& budget) {
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
    for (std::size_t k = derivative_fault->sample; k < end; ++k) {
      found_.reset();
      for (int i = 0; i < arm_.dof() && !found_; ++i) check_positions(k, i);
      if (found_) return found_;
    }
    return derivative_fault;
  }

  /// Returns every kind of fault; those found so far if the budget ends the search.
  std::vector<FaultsOfKind> kinds(BudgetMeter& budget) {
    std::vector<FaultsOfKind> list;
    list_ = &list;
    for (std::size_t k = 0; k < t_.size(); ++k) {
      if (k % batch == 0 && budget.ended(batch)) break;
      for (int i = 0; i < arm_.dof(); ++i) check_positions(k, i);
      for (int i = 0; i < arm_.dof(); ++i) check_derivatives(k, i);
    }
    list_ = nullptr;
    return list;
  }

 private:
  static constexpr std::size_t batch = 64;  // samples, which take about a microsecond

  void check_positions(std::size_t k, int i) {
    const Limits limits = recovery_.limits(k, i);
    const auto inside = [&](double q) { return within_position_limits(limits, q); };
    const double here = q_[k][i];
    if (!inside(here)) {
      return report(Fault::limits, k, i, excess_over(limits, here),
                    outside(ReasonCode::outside_limits, i, here));
    }
    if (k + 1 == t_.size()) return;
    if (recovery_.is_returning(k, i)) check_return(k, i);
    const double step = q_[k + 1][i] - q_[k][i];
    if (flips(k, i, step)) {
      return report(Fault::flip, k, i, std::abs(step),
                    {ReasonCode::rotates_too_far, {{ReasonField::change, step}}});
    }
    if (v_.empty() || !inside(q_[k + 1][i])) return;  // the next sample has this fault
    const Polynomial p = interval_polynomial(trajectory_, k, i);
    Extremes between = enclosure(p);
    if (inside(between.smallest) && inside(between.largest)) return;
    between = extremes(p);
    if (inside(between.smallest) && inside(between.largest)) return;
    const bool above = excess_over(limits, between.largest) > excess_over(limits, between.smallest);
    const double extreme = above ? between.largest : between.smallest;
    Reason reason = outside(ReasonCode::moves_outside_limits, i, extreme);
    reason.set(ReasonField::interpolation, name(trajectory_.interpolation()));
    report(Fault::limits, k, i, excess_over(limits, extreme), std::move(reason));
  }

  /// Whether a joint may have rotated in the other direction, or jumped. It has not if there are
  /// velocities, which are not of that direction, and the step is one that its limit allows.
  bool flips(std::size_t k, int i, double step) const {
    if (std::abs(step) < std::numbers::pi) return false;
    if (kind(arm_.joint_of(i)) == JointKind::prismatic) return false;
    const double most = (1 + slack_) * motion_limits(arm_.limits(i)).velocity;
    if (v_.empty() || std::abs(step) > most * (t_[k + 1] - t_[k])) return true;
    return step * (v_[k][i] + v_[k + 1][i]) < 0;
  }

  /// Checks that the excess of a joint that starts outside its limits does not rise.
  void check_return(std::size_t k, int i) {
    const double rise = recovery_.rise(k, i);
    if (!(rise > position_slack)) return;
    const double here = q_[k][i];
    report(Fault::limits, k, i, excess_over(arm_.limits(i), here) + rise,
           outside(ReasonCode::excess_rises, i, here).set(ReasonField::change, rise));
  }

  void check_derivatives(std::size_t k, int i) {
    const Limits &known = arm_.limits(i), limits = motion_limits(known);
    check_rest(k, i);
    check_derivative(Fault::velocity, k, i, 1, limits.velocity, known.velocity);
    check_derivative(Fault::acceleration, k, i, 2, limits.acceleration, known.acceleration);
    check_derivative(Fault::jerk, k, i, 3, known.jerk, known.jerk);
  }

  /// Returns how much the rounding of times to doubles may change a derivative of a coordinate that
  /// moves at `velocity`, at most a fraction of the limit. A time error dt moves the position by
  /// velocity * dt. This matters after hours.
  double time_rounding(std::size_t k, int order, double velocity, double limit) const {
    constexpr double factors[] = {2, 20, 300};  // max factors of the polynomials of one interval
    constexpr double largest = 1e-4;            // max fraction of the limit
    const std::size_t end = std::min(k + static_cast<std::size_t>(order), t_.size() - 1);
    double shortest = Limits::none;
    for (std::size_t j = k; j < end; ++j) shortest = std::min(shortest, t_[j + 1] - t_[j]);
    const double dt = std::numeric_limits<double>::epsilon() * std::abs(t_[end]);
    const double change = factors[order - 1] * velocity * dt / std::pow(shortest, order);
    return std::min(change, largest * limit);
  }

  /// `known` is the joint's own limit, or infinity if `limit` is assumed.
  void check_derivative(Fault fault, std::size_t k, int i, int order, double limit, double known) {
    if (found_ || !(limit < Limits::none)) return;
    const auto allowed = [&](double value) {
      const double excess = value - limit * (1 + slack_);
      return excess <= 0 ||
             excess <= time_rounding(k, order, motion_limits(arm_.limits(i)).velocity, limit);
    };
    const auto above = [&](ReasonCode code, double value) {
      return Reason{code,
                    {{ReasonField::quantity, name(fault)},
                     {ReasonField::value, value},
                     {ReasonField::limit, limit},
                     {ReasonField::assumed, !(known < Limits::none)}}};
    };
    if (order > bounded_order(trajectory_.interpolation())) {
      const double needed = needed_derivative(trajectory_, k, i, order);
      if (allowed(needed)) return;
      // A divided difference is of the jump at the next sample.
      return report(fault, k + 1, i, needed / limit, above(ReasonCode::derivative_needed, needed));
    }
    if (k + 1 == t_.size()) return;
    const Polynomial p =
        time_derivative(interval_polynomial(trajectory_, k, i), order, t_[k + 1] - t_[k]);
    const auto largest = [](const Extremes& of) { return std::max(-of.smallest, of.largest); };
    if (allowed(largest(enclosure(p)))) return;
    const double reached = largest(extremes(p));
    if (allowed(reached)) return;
    report(fault, k, i, reached / limit, above(ReasonCode::derivative_reached, reached));
  }

  /// Whether a coordinate moves at the start or the end.
  void check_rest(std::size_t k, int i) {
    const bool first = k == 0, last = k + 1 == t_.size();
    if (found_ || t_.size() < 2 || !((first && !moving_.start) || (last && !moving_.end))) return;
    const Limits limits = motion_limits(arm_.limits(i));
    const EndVelocity end =
        end_velocity(trajectory_, i, limits, first ? TrajectoryEnd::first : TrajectoryEnd::last);
    if (end.at_rest()) return;
    report(Fault::moving, k, i, std::abs(end.velocity) / limits.velocity,
           {first ? ReasonCode::starts_moving : ReasonCode::ends_moving,
            {{ReasonField::value, end.velocity}}});
  }

  Reason outside(ReasonCode code, int i, double q) const {
    const Limits& limits = arm_.limits(i);
    return {code,
            {{ReasonField::value, q},
             {ReasonField::lower, limits.lower},
             {ReasonField::upper, limits.upper}}};
  }

  /// Reports a fault. `amount` compares it with others of its kind.
  void report(Fault fault, std::size_t k, int i, double amount, Reason reason) {
    if (found_) return;
    set_joint(arm_.joint_of(i), reason);
    if (list_ == nullptr) {
      found_ = {fault, k, std::move(reason)};
    } else {
      add_fault(trajectory_, fault, k, amount, std::move(reason), *list_);
    }
  }

  const Arm& arm_;
  MovingEnds moving_;
  double slack_;  ///< fraction by which derivatives may exceed their limits
  const Trajectory& trajectory_;
  const std::vector<double>& t_;
  const std::vector<Configuration>&q_, &v_;
  RecoveryCheck recovery_;
  std::optional<JointFault> found_;
  std::vector<FaultsOfKind>* list_ = nullptr;  ///< all faults are added to it, if there is one
};

}  // namespace

std::string name(Fault fault) {
  constexpr internal::EnumNames<Fault> names("fault");
  return names.of(fault);
}

std::optional<JointFault> first_joint_fault(const Arm& arm, const Trajectory& trajectory,
                                            const MovingEnds& moving, const Budget& budget,
                                            double limit_tolerance, double recover) {
  check_fits(arm, trajectory);
  check_limit_tolerance(limit_tolerance);
  check_recover(recover);
  BudgetMeter meter(budget);
  return FaultSearch(arm, trajectory, moving, limit_tolerance, recover).first(meter);
}

std::vector<FaultsOfKind> internal::joint_faults(const Arm& arm, const Trajectory& trajectory,
                                                 const VerifyOptions& options,
                                                 BudgetMeter& budget) {
  return FaultSearch(arm, trajectory, options.moving, options.limit_tolerance, options.recover)
      .kinds(budget);
}

void internal::check_limit_tolerance(double limit_tolerance) {
  constexpr double largest = 0.1;
  if (limit_tolerance >= 0 && limit_tolerance <= largest) return;
  throw Error("", "limit_tolerance", " must be from 0 to 0.1, not " + number(limit_tolerance));
}

}  // namespace beeline
