#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <beeline/certificate/joint_faults.h>
#include <beeline/error.h>
#include <beeline/math/hermite.h>

namespace beeline {
namespace {

constexpr double forgiven = 1e-6;   // of a velocity, acceleration or jerk, as a share of its limit
constexpr std::size_t stencil = 3;  // steps of the longest difference
constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();

void check_fits(const Arm& arm, const Trajectory& trajectory) {
  check_trajectory(trajectory);
  if (trajectory.joint_names.size() == static_cast<std::size_t>(arm.dof())) return;
  throw Error("a trajectory of " + std::to_string(trajectory.joint_names.size()) +
              " joints is not one of arm " + arm.name() + ", which has " +
              std::to_string(arm.dof()));
}

bool slides(const Arm& arm, int i) { return kind(arm.joint_of(i)) == JointKind::prismatic; }

std::string amount(const Arm& arm, int i, double value, const std::string& per = "") {
  return number(value) + " " + unit(arm.joint_of(i)) + per;
}

class Search {
 public:
  Search(const Arm& arm, const Trajectory& trajectory)
      : arm_(arm),
        trajectory_(trajectory),
        t_(trajectory.times),
        q_(trajectory.positions),
        v_(trajectory.velocities) {}

  std::optional<JointFault> first() {
    for (std::size_t k = 0; k < t_.size(); ++k) {
      for (int i = 0; i < arm_.dof() && !found_; ++i) look_at_positions(k, i);
      if (found_) return found_;
      for (int i = 0; i < arm_.dof() && !found_; ++i) look_at_differences(k, i);
      if (found_) break;
    }
    // A leap shows in the differences before it: then it is the leap that is told.
    const std::optional<JointFault> shown = found_;
    const std::size_t end = shown ? std::min(shown->sample + stencil + 1, t_.size()) : 0;
    for (std::size_t k = shown ? shown->sample + 1 : 0; k < end; ++k) {
      found_.reset();
      for (int i = 0; i < arm_.dof() && !found_; ++i) look_at_positions(k, i);
      if (found_) return found_;
    }
    return shown;
  }

 private:
  void look_at_positions(std::size_t k, int i) {
    const Limits& limits = arm_.limits(i);
    const auto inside = [&](double q) { return within_position_limits(limits, q); };
    const double here = q_[k][i];
    if (!inside(here)) {
      return tell(Fault::limits, k, i, "is at " + amount(arm_, i, here) + ", outside " + range(i));
    }
    if (k + 1 == t_.size()) return;
    const double h = t_[k + 1] - t_[k], step = q_[k + 1][i] - q_[k][i];
    if (!slides(arm_, i) && std::abs(step) >= std::numbers::pi) {
      return tell(Fault::flip, k, i,
                  "turns by " + number(step) + " rad to the next sample, " +
                      number(std::abs(step) / (2 * std::numbers::pi)) + " of a turn");
    }
    if (v_.empty() || !inside(q_[k + 1][i])) return;  // the next sample's own fault
    const auto [least, largest] =
        extremes(cubic_between(here, q_[k + 1][i], v_[k][i], v_[k + 1][i], h));
    if (inside(least) && inside(largest)) return;
    tell(Fault::limits, k, i,
         "comes to " + amount(arm_, i, inside(least) ? largest : least) +
             " before the next sample, by its velocities: outside " + range(i));
  }

  void look_at_differences(std::size_t k, int i) {
    const Limits& limits = arm_.limits(i);
    difference(Fault::velocity, k, i, 1, limits.velocity, "/s");
    difference(Fault::acceleration, k, i, 2, limits.acceleration, "/s^2");
    difference(Fault::jerk, k, i, 3, limits.jerk, "/s^3");
  }

  void difference(Fault fault, std::size_t k, int i, int order, double limit, const char* per) {
    if (found_ || !(limit < Limits::none)) return;
    const double value = mean_derivative(trajectory_, k, i, order);
    if (value <= limit * (1 + forgiven)) return;
    tell(fault, k, i,
         "needs " + amount(arm_, i, value, per) + " over the next samples; its limit is " +
             amount(arm_, i, limit, per));
  }

  std::string range(int i) const {
    const Limits& limits = arm_.limits(i);
    return "its limits of " + number(limits.lower) + " to " + amount(arm_, i, limits.upper);
  }

  void tell(Fault fault, std::size_t k, int i, const std::string& what) {
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

double mean_derivative(const Trajectory& trajectory, std::size_t k, int coordinate, int order) {
  if (order < 1 || order > 3) {
    throw Error("derivatives are told to the third, not the " + std::to_string(order) + "th");
  }
  const auto count = static_cast<std::size_t>(order);
  if (k + count >= trajectory.size()) return 0;
  double table[4] = {}, lost = 0, factorial = 1;
  for (std::size_t j = 0; j <= count; ++j) {
    table[j] = trajectory.positions[k + j][coordinate];
    lost = std::max(lost, rounding * std::abs(table[j]));
  }
  for (std::size_t level = 1; level <= count; ++level) {
    factorial *= static_cast<double>(level);
    double shortest = Limits::none;
    for (std::size_t j = 0; j + level <= count; ++j) {
      const double h = trajectory.times[k + j + level] - trajectory.times[k + j];
      table[j] = (table[j + 1] - table[j]) / h;
      shortest = std::min(shortest, h);
    }
    lost = 2 * lost / shortest;
  }
  return std::max(0.0, std::abs(table[0]) - lost) * factorial;
}

double slowdown_for_limits(const Arm& arm, const Trajectory& trajectory, bool keep_jerk) {
  check_fits(arm, trajectory);
  double factor = 1;
  for (int i = 0; i < arm.dof(); ++i) {
    const Limits& limits = arm.limits(i);
    const double velocity = held_velocity(limits);
    for (std::size_t k = 0; k < trajectory.size(); ++k) {
      const auto share = [&](int order, double limit) {
        return mean_derivative(trajectory, k, i, order) / limit;
      };
      factor = std::max({factor, share(1, velocity), std::sqrt(share(2, limits.acceleration)),
                         keep_jerk ? std::cbrt(share(3, limits.jerk)) : 0});
    }
  }
  return factor;
}

std::optional<JointFault> first_joint_fault(const Arm& arm, const Trajectory& trajectory) {
  check_fits(arm, trajectory);
  return Search(arm, trajectory).first();
}

}  // namespace beeline
