#include <algorithm>
#include <array>

#include <beeline/inverse/internal/pose_tolerance.h>
#include <beeline/inverse/internal/solve.h>

namespace beeline::internal {
namespace {

constexpr std::array<const char*, 6> spatial_names{"x", "y", "z", "roll", "pitch", "yaw"};
constexpr std::array<const char*, 3> planar_names{"x", "y", "theta"};
// The goal, seen from the tool, is the inverse of the tool's deviation
// T_x T_y T_z R_z(yaw) R_y(pitch) R_x(roll), so the joints follow from the last factor to the
// first.
constexpr std::array<int, 6> spatial_order{3, 4, 5, 2, 1, 0};
constexpr std::array<int, 3> planar_order{2, 1, 0};

std::string component(const Arm& arm, int k) {
  return arm.planar() ? planar_names[k] : spatial_names[k];
}

/// Returns the components that may deviate, in the order of their joints.
std::vector<int> deviating(const Arm& arm, const Eigen::VectorXd& tolerance) {
  std::vector<int> components;
  const auto add = [&](const auto& order) {
    for (const int k : order) {
      if (tolerance[k] > 0) components.push_back(k);
    }
  };
  arm.planar() ? add(planar_order) : add(spatial_order);
  return components;
}

Joint deviation_joint(const Arm& arm, int k, double tolerance) {
  const int lengths = arm.planar() ? 2 : 3;
  const int axis = arm.planar() && k == 2 ? 2 : k % 3;
  Joint joint;
  joint.screw =
      k < lengths ? translation_screw(-Vector3::Unit(axis)) : rotation_screw(-Vector3::Unit(axis));
  joint.limits = {.lower = -tolerance, .upper = tolerance};
  joint.name = "tool deviation " + component(arm, k);
  const std::vector<std::string> names = arm.joint_names();
  while (std::find(names.begin(), names.end(), joint.name) != names.end()) joint.name += "'";
  return joint;
}

/// The cost of a deviation is its square, relative to its tolerance. The arm's own joints have a
/// negligible cost.
Eigen::VectorXd weights_of(const Arm& arm, const Eigen::VectorXd& tolerance,
                           const std::vector<int>& components) {
  constexpr double least = 1e-6, most = 1e6;
  const double widest = tolerance.maxCoeff();
  Eigen::VectorXd weights =
      Eigen::VectorXd::Constant(arm.dof() + static_cast<Eigen::Index>(components.size()), least);
  for (std::size_t i = 0; i < components.size(); ++i) {
    const double ratio = widest / tolerance[components[i]];
    weights[arm.dof() + static_cast<Eigen::Index>(i)] = std::min(ratio * ratio, most);
  }
  return weights;
}

/// Returns the options for the arm with deviations.
InverseOptions tolerant_options(const SolverState& state, const std::vector<int>& components) {
  InverseOptions options = state.options;
  options.pose_tolerance.reset();
  options.seed.reset();
  options.task = state.task;
  options.all = options.every_turn = options.ignore_limits = false;
  options.method = InverseMethod::numerical;
  options.redundancy = Redundancy::nearest;
  options.weights = weights_of(state.arm, *state.options.pose_tolerance, components);
  return options;
}

/// The arm of with_deviations(), which a thread keeps.
struct TolerantArm {
  Arm arm;

  struct Key {
    Eigen::VectorXd tolerance;
    bool limited = false;
    bool operator==(const Key& other) const {
      return limited == other.limited && tolerance.size() == other.tolerance.size() &&
             tolerance == other.tolerance;
    }
  };
  static TolerantArm make(const Arm& arm, const Key& key) {
    return {with_deviations(arm, key.tolerance, key.limited)};
  }
};

}  // namespace

Arm with_deviations(const Arm& arm, const Eigen::VectorXd& tolerance, bool limited) {
  std::vector<Joint> joints = arm.joints();
  for (Joint& joint : joints) {
    if (!limited) joint.limits = {};
  }
  const std::size_t own = joints.size();
  for (const int k : deviating(arm, tolerance)) {
    joints.push_back(deviation_joint(arm, k, tolerance[k]));
  }
  if (joints.size() == own) return {arm.name(), joints, arm.tool(), arm.base()};
  joints[own].offset = arm.tool();
  return {arm.name(), joints, Pose::Identity(), arm.base()};
}

std::optional<InverseResult> solve_within_tolerance(SolverState& state, const Request& request) {
  const std::vector<int> components = deviating(state.arm, *state.options.pose_tolerance);
  if (components.empty()) return {};
  const InverseOptions options = tolerant_options(state, components);
  const KeptByThread<TolerantArm> tolerant(
      state.arm, {*state.options.pose_tolerance, !state.options.ignore_limits});
  SolverState with_deviations(tolerant->arm, options);
  const int n = state.arm.dof();
  Configuration start = Configuration::Zero(n + static_cast<Eigen::Index>(components.size()));
  start.head(n) = request.seed;
  InverseResult result =
      solve(with_deviations, request.goal, start, FailureDetail::none, request.budget);
  if (result.solutions.empty()) return {};
  const Configuration found = result.solutions.front();
  result.solutions = {found.head(n)};
  result.deviation = Eigen::VectorXd::Zero(state.options.pose_tolerance->size());
  for (std::size_t i = 0; i < components.size(); ++i) {
    (*result.deviation)[components[i]] = found[n + static_cast<Eigen::Index>(i)];
  }
  result.singular = false;
  result.reason = {};
  return result;
}

}  // namespace beeline::internal
