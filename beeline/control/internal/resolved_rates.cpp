#include <algorithm>
#include <cmath>

#include <beeline/control/internal/resolved_rates.h>
#include <beeline/error.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {
namespace {

constexpr double damping = 1e-7;  // of the size of the Jacobian: where its directions begin to fade
constexpr double done = 1e-6;     // of the command may be left over by a solution

}  // namespace

ResolvedRates::ResolvedRates(const Arm& arm, const Task& task)
    : weight(arm.dof()),
      held(static_cast<std::size_t>(arm.dof())),
      arm_(arm),
      task_(task),
      columns_(6, arm.dof()),
      rows_(6, arm.dof()),
      way_(arm.dof()),
      kept_(arm.dof()),
      null_(arm.dof()),
      rates_{Eigen::VectorXd::Zero(arm.dof()), Eigen::VectorXd::Zero(arm.dof())} {
  directions_.motion.resize(arm.dof(), 6);
  for (int i = 0; i < 6; ++i) {
    scale_[i] = !task.rows[i] ? 0 : i < 3 ? 1 / internal::unit_of_length(arm) : 1;
  }
  for (int k = 0; k < arm.dof(); ++k) {
    weight[k] = velocity_limit_of(arm.limits(k));
  }
}

bool ResolvedRates::take(const ConfigurationRef& q, const Twist& command) {
  jacobian(arm_, q, columns_, task_.frame);
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    rows_.col(k) = weight[k] * scale_.cwiseProduct(columns_.col(k));
  }
  for (int i = 0; i < 6; ++i) command_[i] = scale_[i] > 0 ? scale_[i] * command[i] : 0;
  constexpr double absurd = 1e100;  // beyond, squares overflow
  if (!(command_.lpNorm<Eigen::Infinity>() < absurd)) {
    throw Error("the commanded velocity must be finite, and below 1e100");
  }
  return command_.squaredNorm() > 0;
}

double ResolvedRates::share_done(const Eigen::VectorXd& velocity) const {
  Rows sum = Rows::Zero();
  for (Eigen::Index k = 0; k < velocity.size(); ++k) sum += velocity[k] / weight[k] * rows_.col(k);
  return std::clamp(sum.dot(command_) / command_.squaredNorm(), 0.0, 1.0);
}

/// How fast the tool's rows for this velocity change when q moves by it, by a difference: columns_
/// are those at `ahead_` seconds from now then.
ResolvedRates::Rows ResolvedRates::turn_along(const ConfigurationRef& q,
                                              const Eigen::VectorXd& velocity) {
  constexpr double aside = 1e-5;  // radians or metres
  ahead_ = aside / std::max(velocity.lpNorm<Eigen::Infinity>(), 1e-300);
  kept_ = q + ahead_ * velocity;
  jacobian(arm_, kept_, columns_, task_.frame);
  Rows here = Rows::Zero(), ahead = Rows::Zero();
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    here += velocity[k] / weight[k] * rows_.col(k);
    ahead += velocity[k] * columns_.col(k);
  }
  return (scale_.cwiseProduct(ahead) - here) / ahead_;
}

/// Least squares for what the held coordinates leave; whether the command is done by it.
bool ResolvedRates::solve_least_squares() {
  Rows left = command_;
  SixByRoots::Gram gram = SixByRoots::Gram::Zero();
  for (Eigen::Index k = 0; k < way_.size(); ++k) {
    if (held[k]) {
      left -= rows_.col(k) * way_[k];
    } else {
      way_[k] = 0;
      gram += rows_.col(k) * rows_.col(k).transpose();
    }
  }
  gram.diagonal().array() += damping * damping * gram.trace() + 1e-300;
  factors_.factor(gram);
  for (int pass = 0; pass < 2; ++pass) {  // the second takes most of the damping back
    const Rows y = factors_.solve(left);
    for (Eigen::Index k = 0; k < way_.size(); ++k) {
      if (held[k]) continue;
      const double more = rows_.col(k).dot(y);
      way_[k] += more;
      left -= more * rows_.col(k);
    }
  }
  return left.norm() <= done * command_.norm() && way_.allFinite();
}

bool ResolvedRates::solve_with_others(const std::vector<Room>& rooms) {
  std::fill(held.begin(), held.end(), char{0});
  bool solved = solve_least_squares();
  for (Eigen::Index spare = way_.size() - command_.size(); solved && spare > 0; --spare) {
    Eigen::Index worst = -1;
    double most = 1;
    for (Eigen::Index k = 0; k < way_.size(); ++k) {
      const Room& room = rooms[k];
      const double v = weight[k] * way_[k];
      if (room.kind(v) != ServoLimit::position || held[k]) continue;
      const double allowed = room.allowed(v);
      if (std::abs(v) > most * allowed) most = std::abs(v) / std::max(allowed, 1e-300), worst = k;
    }
    if (worst < 0) break;
    const Room& room = rooms[worst];
    kept_ = way_;
    held[worst] = 1;
    way_[worst] = (way_[worst] > 0 ? room.upper : room.lower) / weight[worst];
    if (!solve_least_squares()) {  // not without this one: back to it
      held[worst] = 0;
      solve_least_squares();
      way_ = kept_;
      break;
    }
  }
  return solved;
}

/// The command stays as it is: J' v + J v' = 0. Near a singularity the bend is one over the way
/// that is left to it.
void ResolvedRates::fill_bend(const ConfigurationRef& q) {
  const Rows y = factors_.solve(turn_along(q, rates_.velocity));
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    rates_.bend[k] = held[k] ? 0 : -weight[k] * rows_.col(k).dot(y);
  }
}

const Rates& ResolvedRates::solve(const ConfigurationRef& q, const std::vector<Room>& rooms,
                                  const Eigen::VectorXd& before, double time_step) {
  rates_.regular = solve_with_others(rooms);
  rates_.share = 1;
  if (rates_.regular) {
    directions_.u.setIdentity();
    rates_.velocity = weight.cwiseProduct(way_);
    fill_bend(q);
  } else {
    std::fill(held.begin(), held.end(), char{0});
    rates_.bend.setZero();
    rates_.share = solve_singular(q, before, time_step);
    rates_.velocity = weight.cwiseProduct(way_);
  }
  return rates_;
}

void ResolvedRates::keep_tool(Eigen::VectorXd& motion) {
  Rows moved = Rows::Zero();
  for (Eigen::Index k = 0; k < motion.size(); ++k) {
    motion[k] = held[k] ? 0 : motion[k] / weight[k];
    moved += motion[k] * rows_.col(k);
  }
  const Rows y = factors_.solve(moved);
  for (Eigen::Index k = 0; k < motion.size(); ++k) {
    if (held[k]) continue;
    motion[k] = weight[k] * (motion[k] - rows_.col(k).dot(y));
  }
}

}  // namespace beeline::internal
