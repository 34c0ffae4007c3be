#include <algorithm>
#include <cmath>
#include <vector>

#include <beeline/inverse/analytic/pieper_solver.h>
#include <beeline/inverse/numerical/bounds.h>
#include <beeline/inverse/numerical/seed_table.h>
#include <beeline/kinematics/jacobian.h>
#include <beeline/math/decompositions.h>

namespace beeline::internal {
namespace {

Pose rotation_about_z(double angle) { return Pose(Eigen::AngleAxisd(angle, Vector3::UnitZ())); }

/// Returns a b. Eigen's product is a function that every object file of a program has. The linker
/// may keep one that calls functions for its parts, and takes four times as long.
Pose rigid_product(const Pose& a, const Pose& b) {
  Pose product = Pose::Identity();
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 3; ++i) {
      product(i, j) = a(i, 0) * b(0, j) + a(i, 1) * b(1, j) + a(i, 2) * b(2, j);
    }
  }
  for (int i = 0; i < 3; ++i) product(i, 3) += a(i, 3);
  return product;
}

/// Returns the inverse of a rigid motion, for the same reason without Eigen's.
Pose rigid_inverse(const Pose& a) {
  Pose inverse = Pose::Identity();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) inverse(i, j) = a(j, i);
    inverse(i, 3) = -(a(0, i) * a(0, 3) + a(1, i) * a(1, 3) + a(2, i) * a(2, 3));
  }
  return inverse;
}

/// Whether every joint is revolute or prismatic and has a coordinate of its own.
bool supported(const Arm& arm, const Chain& chain) {
  if (static_cast<int>(chain.links.size()) != arm.dof()) return false;
  return std::none_of(chain.links.begin(), chain.links.end(), [](const Chain::Link& link) {
    return (link.theta_per_q != 0) == (link.d_per_q != 0);
  });
}

/// Returns the frame at the tool's origin whose z axis is this direction, seen from the tool.
Pose tool_T_axis(const Vector3& axis) {
  return frame_along(axis.unitOrthogonal(), axis, Vector3::Zero());
}

/// Appends revolute joints at the origin of the tool, about the given axes, seen from the tool, in
/// order.
Chain with_virtual_joints(const Chain& chain, const std::vector<Vector3>& axes) {
  Chain longer = chain;
  Pose last_T_tool = chain.tool;
  for (const Vector3& axis : axes) {
    const Pose last_T_joint = last_T_tool * tool_T_axis(axis);
    // The rotation is Rot_z(first) Rot_x(alpha) Rot_z(theta_offset). Rot_z(first) is added to the
    // link before.
    const Rotation r = last_T_joint.linear();
    const double alpha = std::atan2(std::hypot(r(0, 2), r(1, 2)), r(2, 2));
    const double first = std::atan2(r(0, 2), -r(1, 2));
    longer.links.back().theta_offset += first;
    Chain::Link link;
    link.cos_alpha = std::cos(alpha);
    link.sin_alpha = std::sin(alpha);
    link.translation = rotation_about_z(-first) * last_T_joint.translation();
    const Pose tilt = rotation_about_z(first) * Eigen::AngleAxisd(alpha, Vector3::UnitX());
    const Rotation about_z = tilt.linear().transpose() * r;
    link.theta_offset = std::atan2(about_z(1, 0), about_z(0, 0));
    link.theta_per_q = 1;
    link.coordinate = static_cast<int>(longer.links.size());
    longer.links.push_back(link);
    last_T_tool = tool_T_axis(axis).inverse(Eigen::Isometry);
  }
  longer.tool = last_T_tool;
  return longer;
}

/// Virtual joints that complete an arm to six joints: axes of the tool.
struct VirtualJoints {
  std::string axes;
  bool free = false;  ///< whether any value solves the task; otherwise the value is zero
};

/// Returns the virtual joints that may be tried for a task, in order. A spherical wrist of all
/// three virtual joints may be singular, which does not matter: its joints are free.
std::vector<VirtualJoints> virtual_joints(int dof, const Task& task) {
  const bool spatial = task.size() == 6;
  const Task position{{true, true, true, false, false, false}, task.frame};
  if (dof == 6 && spatial) return {{"", false}};
  if (dof == 5 && spatial) return {{"z", false}, {"y", false}, {"x", false}};
  if (dof == 4 && spatial) {
    return {{"xy", false}, {"yx", false}, {"zx", false},
            {"zy", false}, {"xz", false}, {"yz", false}};
  }
  if (dof == 3 && task == position) return {{"zyx", true}, {"zxy", true}};
  return {};
}

std::vector<Vector3> directions(const std::string& axes) {
  std::vector<Vector3> all;
  for (const char axis : axes) all.push_back(Vector3::Unit(axis - 'x'));
  return all;
}

/// Returns the axis of the only rotation that the task does not determine, 0 to 2.
std::optional<int> undetermined_axis(const Task& task) {
  if (task.positions() < 3 || task.orientations() != 2) return std::nullopt;
  const auto* const row = std::find(task.rows.begin() + 3, task.rows.end(), false);
  return static_cast<int>(row - task.rows.begin()) - 3;
}

/// Whether the last joint rotates the tool about this axis of the tool, at the tool's origin.
bool rotates_about(const Chain& chain, const Vector3& axis) {
  const Vector3 direction = chain.tool.linear().row(2);
  const double distance = chain.tool.translation().head<2>().norm();
  return direction.cross(axis).norm() < special &&
         distance <= special * size_of(axes_of(chain), chain.tool);
}

/// Whether coordinate k of seven moves in self-motions. The pose determines the value of one that
/// stands still, or nearly: a grid of values misses the solutions. Prismatic coordinates count in
/// units of unit_of_length(), as radians.
bool moves_in_self_motion(const Arm& arm, int k) {
  constexpr int trials = 8;
  constexpr double rounding = 1e-9;  // of singular values, relative
  constexpr double least = 0.05;     // part of a self-motion of unit length
  const double unit = unit_of_length(arm);
  Splitmix random(1);
  Configuration q(7);
  for (int trial = 0; trial < trials; ++trial) {
    for (double& value : q) value = 2 * random.next() - 1;
    Eigen::MatrixXd columns = jacobian(arm, q);
    columns.topRows<3>() /= unit;
    for (int i = 0; i < 7; ++i) {
      if (kind(arm.joint_of(i)) == JointKind::prismatic) columns.col(i) *= unit;
    }
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(columns, Eigen::ComputeFullV);
    const auto& sigma = svd.singularValues();
    const auto rank = (sigma.array() > rounding * sigma[0]).count();
    if (svd.matrixV().row(k).tail(7 - rank).norm() > least) return true;
  }
  return false;
}

/// A rotation without special directions.
Pose sample_goal() { return Pose(Eigen::AngleAxisd(1.1, Vector3(0.3, -0.5, 0.8).normalized())); }

}  // namespace

bool PieperSolver::lock_last(const Chain& chain) {
  Chain six = chain;
  six.links.pop_back();
  six.tool = Pose::Identity();
  const auto loop = pieper_loop(six);
  if (!loop) return false;
  loop_ = *loop;
  locked_ = 6;
  coordinates_ = {0, 1, 2, 3, 4, 5};
  locked_link_ = chain.links.back();
  before_locked_ = constant_transform(locked_link_);
  after_locked_ = chain.tool;
  return true;
}

bool PieperSolver::lock_first(const Chain& chain) {
  Chain six = chain;
  six.links.erase(six.links.begin());
  six.base = constant_transform(six.links.front());
  six.links.front().translation.setZero();
  six.links.front().cos_alpha = 1;
  six.links.front().sin_alpha = 0;
  const auto loop = pieper_loop(six);
  if (!loop) return false;
  loop_ = *loop;
  locked_ = 0;
  coordinates_ = {1, 2, 3, 4, 5, 6};
  locked_link_ = chain.links.front();
  before_locked_ = chain.base;
  return true;
}

bool PieperSolver::add_virtual(const Chain& chain, const std::vector<Vector3>& axes, bool free) {
  // With two joints about one axis only their sum is determined, also if one of them is zero.
  if (!free && !axes.empty() && rotates_about(chain, axes.front())) return false;
  const auto loop = pieper_loop(with_virtual_joints(chain, axes));
  if (!loop) return false;
  loop_ = *loop;
  for (int k = 0; k < 6; ++k) {
    const bool real = k < dof_;
    coordinates_[k] = real ? k : virtual_joint;
    free_[k] = !real && free;
  }
  return true;
}

bool PieperSolver::leave_free(const Chain& chain, int axis, Frame frame) {
  if (frame == Frame::base) {
    world_axis_ = axis;
    const Vector3 seen = sample_goal().linear().row(axis);
    return add_virtual(chain, {seen}, true);
  }
  if (!rotates_about(chain, Vector3::Unit(axis)))
    return add_virtual(chain, {Vector3::Unit(axis)}, true);
  // Any axis normal to the last joint's would do.
  for (const int normal : {(axis + 1) % 3, (axis + 2) % 3}) {
    if (!add_virtual(chain, {Vector3::Unit(normal)}, false)) continue;
    locked_ = 4;
    coordinates_[4] = virtual_joint;
    return true;
  }
  return false;
}

std::optional<PieperSolver> PieperSolver::make(const Arm& arm, const Task& task) {
  const Chain& chain = chain_of(arm);
  if (!supported(arm, chain)) return std::nullopt;
  PieperSolver solver;
  solver.dof_ = arm.dof();
  if (arm.dof() == 7 && task.size() == 6) {
    if (moves_in_self_motion(arm, 6) && solver.lock_last(chain)) return solver;
    if (moves_in_self_motion(arm, 0) && solver.lock_first(chain)) return solver;
    return std::nullopt;
  }
  if (const auto axis = undetermined_axis(task); axis && arm.dof() == 5) {
    if (solver.leave_free(chain, *axis, task.frame)) return solver;
    return std::nullopt;
  }
  for (const VirtualJoints& added : virtual_joints(arm.dof(), task)) {
    if (solver.add_virtual(chain, directions(added.axes), added.free)) return solver;
  }
  return std::nullopt;
}

const PieperSolver* PieperSolver::for_goal(const Chain& chain, const Pose& world_T_tool,
                                           std::unique_ptr<PieperSolver>& own) const {
  if (!world_axis_) return this;
  const Vector3 seen = world_T_tool.linear().row(*world_axis_);
  const auto loop = pieper_loop(with_virtual_joints(chain, {seen.normalized()}), &world_T_tool);
  if (!loop) return nullptr;
  own = std::make_unique<PieperSolver>(*this);
  own->loop_ = *loop;
  return own.get();
}

PieperRequest PieperSolver::request(const ConfigurationRef& seed, const Configuration& weights,
                                    const Configuration& lower, const Configuration& upper,
                                    double tolerance) const {
  PieperRequest request{};
  // This is about a thousand times the rounding of one pass. Random configurations away from
  // singularities stay below it, and a branch above it costs a refinement.
  constexpr double rounding = 1e-12;
  request.max_residual = std::min(rounding * std::max(1.0, loop_.size), tolerance);
  constexpr double full_circle = 4;  // more than pi: any value of a free joint is within limits
  for (int i = 0; i < 6; ++i) {
    const int k = loop_.order[i];
    const int own = coordinates_[k];
    request.wraps[k] = !(i < 3 && loop_.prismatic[i]);
    if (own == virtual_joint) {
      const bool any = free_[k] || k == locked_;
      request.seed[k] = 0;
      request.weight[k] = k == locked_ ? 0 : 1;
      request.lower[k] = any ? -full_circle : 0;
      request.upper[k] = any ? full_circle : 0;
      continue;
    }
    request.seed[k] = seed[own];
    request.weight[k] = weights[own];
    request.lower[k] = lower[own];
    request.upper[k] = upper[own];
  }
  return request;
}

void PieperSolver::branches(const Pose& world_T_tool, double locked_value, PieperRequest& request,
                            PieperBranches& found) const {
  Pose goal = world_T_tool;
  if (locked_ && !spins()) {
    const Pose locked = rigid_product(before_locked_, joint_motion(locked_link_, locked_value));
    goal = *locked_ == 0 ? rigid_product(rigid_inverse(locked), goal)
                         : rigid_product(goal, rigid_inverse(rigid_product(locked, after_locked_)));
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 4; ++j) request.world_T_tool[4 * i + j] = goal(i, j);
  }
  pieper_branches(loop_, request, found);
}

std::vector<int> PieperSolver::free_joints(const PieperBranches& found) const {
  std::vector<int> joints;
  for (int i = 0; i < 4; ++i) {
    if (found.free[i] != 0) joints.push_back(loop_.order[i]);
  }
  return joints;
}

void PieperSolver::configuration(const PieperBranches& found, int lane, double locked_value,
                                 double* q) const {
  for (int k = 0; k < 6; ++k) {
    if (coordinates_[k] != virtual_joint) q[coordinates_[k]] = found.q[k][lane];
  }
  if (locked_) q[*locked_] = locked_value;
}

}  // namespace beeline::internal
