#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/internal/enum_names.h>
#include <beeline/kinematics/internal/mask.h>
#include <beeline/kinematics/manipulability.h>
#include <beeline/math/decompositions.h>

namespace beeline {
namespace {

/// The names of the rows, which do not depend on the frame.
std::vector<std::string> names_of_rows(const Task& task) {
  return row_names({task.rows, Frame::base});
}

/// The rows of the velocity, in its frame. Throws Error for options that exclude each other.
Task rows_of(const Arm& arm, const Eigen::VectorXd& velocity, const JointRatesOptions& options) {
  Task task = options.task.value_or(default_task(arm));
  if (task.size() == 0) throw Error("the task needs at least one row");
  const Frame frame = options.frame.value_or(task.frame);
  if (task.frame == Frame::tool && frame != Frame::tool) {
    throw Error("task " + name(task) + " is in the tool's axes; the frame must be tool, not " +
                name(frame));
  }
  if (!std::isfinite(options.damping) || options.damping < 0) {
    throw Error("damping is " + number(options.damping) + "; it must be 0 or more");
  }
  if (velocity.size() != task.size()) {
    throw Error("the velocity has " + std::to_string(velocity.size()) + " numbers; it needs " +
                std::to_string(task.size()) + ": " + listed(names_of_rows(task)));
  }
  if (!velocity.allFinite()) throw Error("the velocity must be finite");
  task.frame = frame;
  return task;
}

/// Formats a unit velocity for a sentence, without the components that are 0: `vx 0.6, wz -0.8`.
std::string direction_text(const Task& task, const Eigen::VectorXd& direction) {
  constexpr double rounding = 1e-6;
  const std::vector<std::string> names = names_of_rows(task);
  std::vector<std::string> parts;
  for (Eigen::Index i = 0; i < direction.size(); ++i) {
    if (std::abs(direction[i]) < rounding) continue;
    parts.push_back(names[static_cast<std::size_t>(i)] + " " + number(direction[i]));
  }
  return listed(parts);
}

void compare_with_limits(const Arm& arm, JointRates& result) {
  for (int k = 0; k < arm.dof(); ++k) {
    const double rate = result.rates[k], limit = arm.limits(k).velocity;
    if (!(limit < Limits::none)) result.without_limit.push_back(k);
    if (!(std::abs(rate) > limit)) continue;
    result.excesses.push_back({k, rate, limit});
    result.scale = std::min(result.scale, limit / std::abs(rate));
  }
}

}  // namespace

std::string name(RatesStatus status) {
  constexpr internal::EnumNames<RatesStatus> names("status");
  return names.of(status);
}

JointRates joint_rates(const Arm& arm, const ConfigurationRef& q, const Eigen::VectorXd& velocity,
                       const JointRatesOptions& options) {
  const Task task = rows_of(arm, velocity, options);
  const Eigen::MatrixXd j = selected_rows(task, jacobian(arm, q, task.frame));
  if (!j.allFinite()) throw Error("the Jacobian exceeds the range of numbers, 1e308");
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(j, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::VectorXd& sigma = svd.singularValues();
  constexpr double zero = 1e-8;  // of the largest singular value
  Eigen::Index rank = 0;
  while (rank < sigma.size() && sigma[rank] > zero * sigma[0]) ++rank;

  JointRates result;
  result.singular = rank < sigma.size();
  result.lost_directions = svd.matrixU().rightCols(j.rows() - rank);
  const double damping = options.damping;
  result.rates = Configuration::Zero(arm.dof());
  for (Eigen::Index i = 0; i < (damping > 0 ? sigma.size() : rank); ++i) {
    // sigma / (sigma^2 + damping^2), without squares that overflow.
    const double size = std::hypot(sigma[i], damping);
    const double gain = size > 0 ? sigma[i] / size / size : 0;
    result.rates += gain * svd.matrixU().col(i).dot(velocity) * svd.matrixV().col(i);
  }
  result.tool_velocity = j * result.rates;
  if (!result.rates.allFinite() || !result.tool_velocity.allFinite()) {
    throw Error("the joint rates exceed the range of numbers, 1e308");
  }
  const Eigen::VectorXd missing = velocity - result.tool_velocity;
  result.residual = missing.stableNorm();
  compare_with_limits(arm, result);
  constexpr double rounding = 1e-7;  // of the velocity, where singular values are up to `zero`
  if (damping > 0) {
    result.status = RatesStatus::damped;
  } else if (result.residual > rounding * velocity.stableNorm()) {
    result.status = result.singular ? RatesStatus::singular : RatesStatus::too_few_joints;
    result.reason = {result.singular ? ReasonCode::singular_velocity : ReasonCode::too_few_joints,
                     {{ReasonField::direction, direction_text(task, missing.stableNormalized())},
                      {ReasonField::frame, name(task.frame)}}};
  }
  return result;
}

}  // namespace beeline
