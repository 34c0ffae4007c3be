#include "search.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include <beeline/error.h>

namespace beeline::bench {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double same = 1e-4;        // distance below which two solutions count as one
constexpr double converged = 1e-12;  // error of a solution, metres and radians

/// The tool pose and its Jacobian, in the world's axes.
struct State {
  Pose world_T_tool = Pose::Identity();
  Matrix6 jacobian;
};

State state_at(const Screws& screws, const Twist& q) {
  State state;
  Pose base_T_link = Pose::Identity();  // product of the exponentials of the joints so far
  std::array<Vector3, 6> axes, points;
  for (int i = 0; i < 6; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Vector3& axis = screws.axis[k];
    axes[k] = base_T_link.linear() * axis;
    points[k] = base_T_link * screws.point[k];
    Pose motion = Pose::Identity();
    if (screws.slides[k]) {
      motion.translation() = q[i] * axis;
    } else {
      motion.linear() = Eigen::AngleAxisd(q[i], axis).toRotationMatrix();
      motion.translation() = screws.point[k] - motion.linear() * screws.point[k];
    }
    base_T_link = base_T_link * motion;
  }
  state.world_T_tool = base_T_link * screws.home;
  for (int i = 0; i < 6; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Vector3 arm = state.world_T_tool.translation() - points[k];
    state.jacobian.col(i) << (screws.slides[k] ? axes[k] : Vector3(axes[k].cross(arm))),
        (screws.slides[k] ? Vector3(Vector3::Zero()) : axes[k]);
  }
  return state;
}

Twist error_of(const Pose& goal, const Pose& reached) {
  const Eigen::AngleAxisd turn(Rotation(goal.linear() * reached.linear().transpose()));
  Twist error;
  error << goal.translation() - reached.translation(), turn.angle() * turn.axis();
  return error;
}

/// Newton's method with damping that vanishes with the error (Chan & Lawrence 1988).
bool descend(const Screws& screws, const Pose& goal, Twist& q) {
  constexpr int max_steps = 60;
  constexpr double longest_step = 1.0;
  bool close = false;
  for (int step = 0; step < max_steps; ++step) {
    const State state = state_at(screws, q);
    const Twist error = error_of(goal, state.world_T_tool);
    if (error.norm() < converged) return true;
    if (close && error.norm() > 1e-3) return false;
    close = error.norm() < 1e-6;
    Matrix6 normal = state.jacobian.transpose() * state.jacobian;
    normal.diagonal().array() += 0.01 * error.squaredNorm() + 1e-18;
    Twist change = normal.ldlt().solve(state.jacobian.transpose() * error);
    if (!change.allFinite()) return false;
    change *= std::min(1.0, longest_step / change.cwiseAbs().maxCoeff());
    q += change;
  }
  return false;
}

}  // namespace

std::vector<Configuration> searched_solutions(const Screws& screws, const Pose& goal,
                                              const SearchEffort& effort, Engine& engine) {
  if (screws.free != 6) throw Error("the search is for six joints that move");
  Screws six = screws;  // a locked last joint is part of the tool
  if (screws.joints == 7) {
    Configuration still = Configuration::Zero(7);
    still[6] = screws.last;
    six.home = forward(screws, still);
  }
  const double size = screws.home.translation().norm() + goal.translation().norm();
  std::vector<Configuration> found;
  int in_vain = 0;
  for (int start = 0; start < effort.starts && in_vain < effort.patience; ++start, ++in_vain) {
    Twist q;
    for (int i = 0; i < 6; ++i) {
      const double far = screws.slides[i] ? size : pi;
      q[i] = uniform(engine, -far, far);
    }
    if (!descend(six, goal, q)) continue;
    Configuration whole(screws.joints);
    whole.head<6>() = q;
    if (screws.joints == 7) whole[6] = screws.last;
    if (!(miss(goal, forward(screws, whole)) < 1e-9)) continue;
    const bool known = std::any_of(found.begin(), found.end(), [&](const Configuration& other) {
      return difference(screws, whole, other) < same;
    });
    if (known) continue;
    found.push_back(whole);
    in_vain = 0;
  }
  return found;
}

}  // namespace beeline::bench
