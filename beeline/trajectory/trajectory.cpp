#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/trajectory/internal/interval_polynomial.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline {
namespace {

void check_column(const std::vector<Configuration>& column, const Trajectory& trajectory,
                  const std::string& what) {
  if (column.size() != trajectory.size()) {
    throw Error("a trajectory of " + std::to_string(trajectory.size()) + " times has " +
                std::to_string(column.size()) + " " + what);
  }
  for (std::size_t k = 0; k < column.size(); ++k) {
    const auto joints = static_cast<Eigen::Index>(trajectory.joint_names.size());
    if (column[k].size() == joints && column[k].allFinite()) continue;
    throw Error("sample " + std::to_string(k + 1) + " of the trajectory needs " +
                std::to_string(joints) + " finite " + what);
  }
}

/// The column of the trajectory that belongs to each coordinate of the arm.
std::vector<Eigen::Index> column_order(const Arm& arm, const Trajectory& trajectory) {
  std::vector<std::string> missing;
  std::vector<std::string> unknown = trajectory.joint_names;
  std::vector<Eigen::Index> order;
  for (const std::string& joint : arm.joint_names()) {
    const auto& names = trajectory.joint_names;
    const auto found = std::find(names.begin(), names.end(), joint);
    if (found == names.end()) missing.push_back(joint);
    order.push_back(found - names.begin());
    std::erase(unknown, joint);
  }
  if (missing.empty() && unknown.empty()) return order;
  std::string text = "the trajectory does not fit arm " + arm.name() + ":";
  if (!missing.empty()) text += " it lacks " + listed(missing) + ";";
  if (!unknown.empty()) text += " the arm has no " + listed(unknown) + ";";
  throw Error(text + " the arm's joints are " + listed(arm.joint_names()));
}

}  // namespace

std::string name(Interpolation interpolation) {
  return interpolation_names()[static_cast<std::size_t>(interpolation)];
}

std::vector<std::string> interpolation_names() { return {"linear", "cubic", "quintic"}; }

Interpolation interpolation_named(const std::string& name) {
  const std::vector<std::string> names = interpolation_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) throw unknown_name("interpolation", name, names);
  return static_cast<Interpolation>(found - names.begin());
}

Trajectory at_rest(const Arm& arm, const ConfigurationRef& q) {
  check_configuration(arm, q);
  const Configuration still = Configuration::Zero(arm.dof());
  return {arm.joint_names(), {0}, {q}, {still}, {still}};
}

void check_trajectory(const Trajectory& trajectory) {
  for (auto joint = trajectory.joint_names.begin(); joint != trajectory.joint_names.end();
       ++joint) {
    if (std::find(trajectory.joint_names.begin(), joint, *joint) == joint) continue;
    throw Error("two joints of the trajectory are called " + *joint);
  }
  check_column(trajectory.positions, trajectory, "positions");
  if (!trajectory.velocities.empty()) check_column(trajectory.velocities, trajectory, "velocities");
  if (!trajectory.accelerations.empty()) {
    check_column(trajectory.accelerations, trajectory, "accelerations");
    if (trajectory.velocities.empty() && trajectory.size() > 0) {
      throw Error("the trajectory has accelerations without velocities: a controller needs both");
    }
  }
  for (std::size_t k = 0; k < trajectory.size(); ++k) {
    const bool later = k == 0 || trajectory.times[k] > trajectory.times[k - 1];
    if (later && std::isfinite(trajectory.times[k])) continue;
    throw Error("time does not increase at sample " + std::to_string(k + 1) +
                " of the trajectory: " + number(trajectory.times[k]) + " s");
  }
}

TrajectoryState sample(const Trajectory& trajectory, double t, Side side) {
  if (trajectory.size() == 0) throw Error("the trajectory has no samples");
  if (std::isnan(t)) throw Error("the time at which a trajectory is sampled is NaN");
  const auto& times = trajectory.times;
  const bool before = side == Side::before;
  const Configuration still =
      Configuration::Zero(static_cast<Eigen::Index>(trajectory.joint_names.size()));
  if (before ? t <= times.front() : t < times.front()) {
    return {trajectory.positions.front(), still, still, still};
  }
  if (before ? t > times.back() : t >= times.back()) {
    return {trajectory.positions.back(), still, still, still};
  }
  const auto next = before ? std::lower_bound(times.begin(), times.end(), t)
                           : std::upper_bound(times.begin(), times.end(), t);
  const auto k = static_cast<std::size_t>(next - times.begin()) - 1;
  const double h = times[k + 1] - times[k], u = (t - times[k]) / h;
  TrajectoryState state{still, still, still, still};
  for (Eigen::Index i = 0; i < still.size(); ++i) {
    const internal::Polynomial p = internal::interval_polynomial(trajectory, k, i);
    const internal::Polynomial d = p.derivative(), dd = d.derivative();
    state.position[i] = u < 1 ? p(u) : trajectory.positions[k + 1][i];
    state.velocity[i] = d(u) / h;
    state.acceleration[i] = dd(u) / (h * h);
    state.jerk[i] = dd.derivative()(u) / (h * h * h);
  }
  return state;
}

Trajectory matched_to(const Arm& arm, const Trajectory& trajectory) {
  check_trajectory(trajectory);
  const std::vector<Eigen::Index> order = column_order(arm, trajectory);
  const auto reordered = [&order](std::vector<Configuration> column) {
    for (Configuration& q : column) q = Configuration(q(order));
    return column;
  };
  return {arm.joint_names(), trajectory.times, reordered(trajectory.positions),
          reordered(trajectory.velocities), reordered(trajectory.accelerations)};
}

}  // namespace beeline
