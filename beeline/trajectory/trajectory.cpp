#include <algorithm>
#include <cmath>
#include <ostream>

#include <beeline/error.h>
#include <beeline/internal/enum_names.h>
#include <beeline/trajectory/internal/interval_polynomial.h>
#include <beeline/trajectory/internal/joint_columns.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline {
namespace {

constexpr internal::EnumNames<Interpolation> interpolations("interpolation");

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

/// A coordinate is factor * recorded + shift.
struct Affine {
  double factor = 1, shift = 0;
};

void check_match(const MatchOptions& options, std::size_t columns) {
  const auto is_unit = [](double unit) { return unit > 0 && std::isfinite(unit); };
  if (!is_unit(options.angle_unit)) {
    throw Error("the unit of recorded angles must be above 0, not " + number(options.angle_unit));
  }
  for (const auto& [name, sign, offset, unit] : options.joint_map) {
    const std::string what = "joint " + name + " of the joint_map: the ";
    if (std::abs(sign) != 1) throw Error(what + "sign must be 1 or -1, not " + number(sign));
    if (!std::isfinite(offset)) throw Error(what + "offset must be finite");
    if (unit && !is_unit(*unit)) throw Error(what + "unit must be above 0, not " + number(*unit));
  }
  if (options.column_units.empty()) return;
  if (options.column_units.size() != columns) {
    throw Error("a trajectory of " + std::to_string(columns) + " joints has " +
                std::to_string(options.column_units.size()) + " column_units");
  }
  for (const std::optional<double>& unit : options.column_units) {
    if (unit && !is_unit(*unit)) {
      throw Error("a unit of column_units must be above 0, not " + number(*unit));
    }
  }
}

/// Returns the map from the values of a column to its coordinate, for each coordinate.
std::vector<Affine> maps_of(const Arm& arm, const MatchOptions& options,
                            const std::vector<Eigen::Index>& columns) {
  std::vector<Affine> maps(columns.size());
  for (std::size_t k = 0; k < maps.size(); ++k) {
    const bool slides = kind(arm.joint_of(static_cast<Eigen::Index>(k))) == JointKind::prismatic;
    const MappedJoint joint = options.joint_map.empty() ? MappedJoint() : options.joint_map[k];
    std::optional<double> unit = joint.unit;
    if (!unit && !options.column_units.empty()) {
      unit = options.column_units[static_cast<std::size_t>(columns[k])];
    }
    if (!unit) unit = slides ? 1 : options.angle_unit;
    maps[k] = {*unit * joint.sign, *unit * joint.offset};
  }
  return maps;
}

/// Returns these columns as coordinates of the arm, or as rates of them.
std::vector<Configuration> column(const std::vector<Configuration>& recorded,
                                  const std::vector<Eigen::Index>& order,
                                  const std::vector<Affine>& maps, bool rates) {
  std::vector<Configuration> mapped;
  mapped.reserve(recorded.size());
  for (const Configuration& values : recorded) {
    Configuration& q = mapped.emplace_back(static_cast<Eigen::Index>(order.size()));
    for (std::size_t k = 0; k < order.size(); ++k) {
      const auto& [factor, shift] = maps[k];
      // A zero keeps its sign.
      const double value = factor == 1 ? values[order[k]] : factor * values[order[k]];
      q[static_cast<Eigen::Index>(k)] = rates || shift == 0 ? value : value + shift;
    }
  }
  return mapped;
}

}  // namespace

std::string name(Interpolation value) { return interpolations.of(value); }

std::vector<std::string> interpolation_names() { return interpolations.all(); }

Interpolation interpolation_named(const std::string& name) { return interpolations.named(name); }

std::ostream& operator<<(std::ostream& out, const Trajectory& trajectory) {
  const std::size_t joints = trajectory.joint_names.size(), samples = trajectory.size();
  out << joints << (joints == 1 ? " joint, " : " joints, ") << samples
      << (samples == 1 ? " sample" : " samples");
  if (samples == 0) return out;
  return out << ", " << number(trajectory.times.back() - trajectory.times.front()) << " s, "
             << name(trajectory.interpolation());
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

Trajectory matched_to(const Arm& arm, const Trajectory& trajectory, const MatchOptions& options) {
  check_trajectory(trajectory);
  check_match(options, trajectory.joint_names.size());
  const internal::JointColumns order =
      internal::joint_columns(arm, trajectory.joint_names, options.joint_map);
  const auto taken = [&](const std::vector<Configuration>& recorded,
                         const std::vector<Eigen::Index>& columns, bool rates) {
    return column(recorded, columns, maps_of(arm, options, columns), rates);
  };
  Trajectory matched{arm.joint_names(), trajectory.times, {}, {}, {}};
  matched.positions = taken(trajectory.positions, order.positions, false);
  if (!order.velocities.empty()) {
    matched.velocities = taken(trajectory.positions, order.velocities, true);
    if (!order.accelerations.empty()) {
      matched.accelerations = taken(trajectory.positions, order.accelerations, true);
    }
    return matched;
  }
  matched.velocities = taken(trajectory.velocities, order.positions, true);
  matched.accelerations = taken(trajectory.accelerations, order.positions, true);
  return matched;
}

}  // namespace beeline
