#include <algorithm>
#include <cmath>
#include <limits>

#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/kinematics/jacobian.h>
#include <beeline/math/revolution.h>
#include <beeline/planning/internal/self_motion.h>

namespace beeline::internal {
namespace {

constexpr double solved_to = 1e-7;  // metres and radians: nodes only guide a motion
constexpr int max_solver_steps = 12;
constexpr std::size_t max_nodes = 1000;  // of a curve in one direction
constexpr double smallest_fraction =
    1e-2;  // of the regular one, before a singularity ends the curve

using Node = RedundantConfiguration;

/// The dot product, in two partial sums.
double dot(const double* a, const double* b, Eigen::Index count) {
  double even = 0, odd = 0;
  Eigen::Index i = 0;
  for (; i + 1 < count; i += 2) {
    even += a[i] * b[i];
    odd += a[i + 1] * b[i + 1];
  }
  const double sum = even + odd;
  return i < count ? sum + a[i] * b[i] : sum;
}

/// Applies the reflection I - scale v v^T, where v = (1, tail), to the numbers from x on.
void reflect(double scale, const double* tail, Eigen::Index count, double* x) {
  const double product = x[0] + dot(tail, x + 1, count);
  x[0] -= scale * product;
  for (Eigen::Index r = 0; r < count; ++r) x[r + 1] -= scale * tail[r] * product;
}

/// Returns a unit vector n with J n = 0 for a matrix with one column more than rows: the last
/// column of Q in J^T = Q R, by Householder's reflections. The rows of J are consecutive.
Node null_vector(double (&j)[6][7], Eigen::Index rows) {
  double scale[6];
  for (Eigen::Index c = 0; c < rows; ++c) {
    const Eigen::Index count = rows - c;
    double* const tail = j[c] + c + 1;
    const double first = j[c][c], below = dot(tail, tail, count);
    if (below <= std::numeric_limits<double>::min()) {
      std::fill_n(tail, count, 0);
      scale[c] = 0;
      continue;
    }
    const double image = -std::copysign(std::sqrt(first * first + below), first);
    for (Eigen::Index r = 0; r < count; ++r) tail[r] /= first - image;
    scale[c] = (image - first) / image;
    for (Eigen::Index other = c + 1; other < rows; ++other) {
      reflect(scale[c], tail, count, j[other] + c);
    }
  }
  Node null = Node::Unit(rows + 1, rows);
  for (Eigen::Index c = rows; c-- > 0;) {
    reflect(scale[c], j[c] + c + 1, rows - c, null.data() + c);
  }
  return null;
}

}  // namespace

SelfMotion::SelfMotion(const Arm& arm, const Task& task, const Bounds& bounds,
                       const std::vector<bool>& cyclic, double step)
    : arm_(arm),
      task_(task),
      bounds_(bounds),
      half_period_(arm.dof()),
      step_(step),
      problem_(numerical_problem(arm, task, no_bounds(arm))) {
  for (Eigen::Index k = 0; k < half_period_.size(); ++k) {
    half_period_[k] = cyclic[static_cast<std::size_t>(k)] ? revolution / 2 : Limits::none;
  }
}

bool SelfMotion::solve(const Pose& pose, Node& q) {
  const LaneOptions options{
      .tolerance = solved_to, .max_iterations = max_solver_steps, .polish = false};
  if (task_.size() == 6) {
    if (!gauss_newton(problem_, pose, q.data(), options, solver_)) return false;
    for (Eigen::Index k = 0; k < q.size(); ++k) {
      const auto i = static_cast<std::size_t>(k);
      q[k] = solver_.q[i] * problem_.coordinates[i].unit;
    }
    return true;
  }
  const NumericalResult found =
      levenberg_marquardt(arm_, pose, task_, problem_.bounds, Configuration(q),
                          {.tolerance = solved_to, .max_iterations = max_solver_steps});
  if (found.converged) q = found.q;
  return found.converged;
}

double SelfMotion::margin(const Node& q) const {
  double least = Limits::none;
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    if (half_period_[k] < Limits::none) continue;
    least = std::min(least, limit_margin(q[k], bounds_.lower[k], bounds_.upper[k]));
  }
  return least;
}

Node SelfMotion::difference(const Node& b, const Node& a) const {
  Node d(b.size());
  for (Eigen::Index k = 0; k < d.size(); ++k) d[k] = coordinate_difference(k, b[k], a[k]);
  return d;
}

/// Computes a unit vector of the null space of the task's Jacobian, oriented as `direction` before.
bool SelfMotion::tangent(const Node& q, Node& direction) const {
  double j[6][7];
  Eigen::Map<Eigen::Matrix<double, 7, 6>> rows(*j);  // as columns
  if (task_.size() == 6) {
    Eigen::Matrix<double, 6, 7> columns;
    jacobian(arm_, q, columns, task_.frame);
    columns.topRows<3>() /= problem_.length;
    rows = columns.transpose();
  } else {
    rows.topLeftCorner(q.size(), task_.size()) =
        task_jacobian(arm_, Configuration(q), task_, problem_.length).transpose();
  }
  const Node null = null_vector(j, task_.size());
  if (!null.allFinite()) return false;
  direction = null.dot(direction) < 0 ? Node(-null) : null;
  return true;
}

/// Finds the configuration on the self-motion between two of its nodes at which the first joint
/// reaches its limit, by regula falsi along the chord.
bool SelfMotion::to_limit(const Pose& pose, const Node& inside, const Node& outside,
                          Node& at_limit) {
  constexpr double exceeded = -1e-8, reached = 1e-6;  // margins that count as at the limit
  Node in = inside, out = outside;
  for (int i = 0; i < 12; ++i) {
    double u = 1;
    for (Eigen::Index k = 0; k < in.size(); ++k) {
      const double step = out[k] - in[k];
      if (out[k] > bounds_.upper[k]) u = std::min(u, (bounds_.upper[k] - in[k]) / step);
      if (out[k] < bounds_.lower[k]) u = std::min(u, (bounds_.lower[k] - in[k]) / step);
    }
    Node next = in + std::max(u, 0.0) * (out - in);
    if (!solve(pose, next)) break;
    const double left = margin(next);
    if (left >= exceeded && left < reached) {
      at_limit = next.cwiseMax(bounds_.lower).cwiseMin(bounds_.upper);
      return true;
    }
    (left < 0 ? out : in) = next;
  }
  at_limit = in;
  return (in - inside).squaredNorm() > 0;
}

/// Appends nodes from the last one in a direction; returns whether the curve closes.
bool SelfMotion::follow(const Pose& pose, bool limited, Node direction, std::vector<Node>& nodes) {
  const Node first = nodes.front();
  const std::size_t begin = nodes.size();
  double step = step_;
  while (nodes.size() < begin + max_nodes) {
    const Node q = nodes.back();
    Node along = direction;
    if (!tangent(q, along)) return false;
    Node next = q + step * along;
    const Node predicted = next;
    const bool found = solve(pose, next) && (next - predicted).norm() < 0.3 * step;
    if (!found) {
      step /= 2;
      if (step < smallest_fraction * step_) return false;
      continue;
    }
    if (limited && margin(next) < 0) {
      Node end;
      if (to_limit(pose, q, next, end)) nodes.push_back(end);
      return false;
    }
    const Node back = difference(first, q), chord = next - q;
    const double u = back.dot(chord) / chord.squaredNorm();
    if (nodes.size() > begin + 2 && u >= 0 && u <= 1 && (back - u * chord).norm() < 0.2 * step) {
      return true;
    }
    nodes.push_back(next);
    direction = along;
    step = std::min(1.5 * step, step_);
  }
  return false;
}

SelfMotionCurve SelfMotion::traced(const Pose& pose, const Node& q, bool limited) {
  SelfMotionCurve curve{{q}};
  Node direction = Node::Zero(q.size());
  if (!tangent(q, direction)) return curve;
  curve.closed = follow(pose, limited, direction, curve.nodes);
  if (curve.closed) return curve;
  std::reverse(curve.nodes.begin(), curve.nodes.end());
  std::vector<Node> back{q};
  follow(pose, limited, -direction, back);
  curve.nodes.insert(curve.nodes.end(), back.begin() + 1, back.end());
  return curve;
}

SelfMotionCurve SelfMotion::curve_through(const Pose& pose, const Node& q) {
  constexpr std::size_t enough = 5;  // nodes, so that parts of a short curve are followed too
  SelfMotionCurve curve = traced(pose, q, true);
  while (!curve.closed && curve.nodes.size() > 1 && curve.nodes.size() < enough) {
    std::vector<Node> finer;
    for (std::size_t i = 0; i + 1 < curve.nodes.size(); ++i) {
      finer.push_back(curve.nodes[i]);
      Node middle = (curve.nodes[i] + curve.nodes[i + 1]) / 2;
      if (solve(pose, middle) && margin(middle) >= 0) finer.push_back(middle);
    }
    finer.push_back(curve.nodes.back());
    if (finer.size() == curve.nodes.size()) break;
    curve.nodes = std::move(finer);
  }
  return curve;
}

SelfMotionCurve SelfMotion::unlimited_curve_through(const Pose& pose, const Node& q) {
  return traced(pose, q, false);
}

std::optional<Node> SelfMotion::move_inside(const Pose& pose, Node q, double reach) {
  double best = margin(q);
  Node direction = Node::Zero(q.size());
  double step = reach / 2;
  for (int i = 0; i < 24 && best < 0; ++i) {
    if (!tangent(q, direction)) return {};
    bool better = false;
    for (const double side : {step, -step}) {
      Node next = q + side * direction;
      const Node predicted = next;
      if (!solve(pose, next) || (next - predicted).norm() > 0.5 * step) continue;
      const double here = margin(next);
      if (here <= best) continue;
      if (side < 0) direction = -direction;
      q = next;
      best = here;
      better = true;
      break;
    }
    if (!better) step /= 2;
    if (step < 1e-5) break;
  }
  return best >= 0 ? std::optional(q) : std::nullopt;
}

namespace {

/// The nearest of `count` nodes from `first` on, round a closed curve; with `any`, the first that
/// is found within the tolerance.
std::optional<std::size_t> node_near(const SelfMotion& motion, const SelfMotionCurve& curve,
                                     const Node& q, double tolerance, std::size_t first,
                                     std::size_t count, bool any = false) {
  const std::size_t all = curve.nodes.size();
  std::optional<std::size_t> best;
  double least = tolerance;
  Node to;
  const double reach = motion.step() + tolerance;
  const auto next = [all](std::size_t i) { return i + 1 < all ? i + 1 : 0; };
  std::size_t i = first % all;
  for (std::size_t n = 0; n < count && !(any && best); ++n, i = next(i)) {
    if (!motion.difference_within(reach, q, curve.nodes[i], to)) continue;
    const std::size_t j = next(i);
    const double distance = to.norm();
    if (distance < least) {
      least = distance;
      best = i;
    }
    if (j == 0 && !curve.closed) continue;
    const Node chord = motion.difference(curve.nodes[j], curve.nodes[i]);
    const double u = to.dot(chord) / chord.squaredNorm();
    if (!(u > 0 && u < 1)) continue;
    const double off = (to - u * chord).norm();
    if (off >= least) continue;
    least = off;
    best = u < 0.5 ? i : j;
  }
  return best;
}

}  // namespace

std::optional<std::size_t> node_near(const SelfMotion& motion, const SelfMotionCurve& curve,
                                     const Node& q, double tolerance) {
  return node_near(motion, curve, q, tolerance, 0, curve.nodes.size());
}

bool passes(const SelfMotion& motion, const SelfMotionCurve& curve, const Node& q,
            double tolerance) {
  return node_near(motion, curve, q, tolerance, 0, curve.nodes.size(), true).has_value();
}

SelfMotionCurves curves_through(SelfMotion& motion, const Pose& pose,
                                const std::vector<Node>& solutions, BudgetMeter& budget) {
  constexpr std::size_t beside = 4;  // nodes to either side of the last place that are tried first
  const double near = 0.2 * motion.step();
  constexpr std::size_t compared_nodes = 128;  // take as long as a unit of work
  SelfMotionCurves found;
  for (const Node& q : solutions) {
    std::optional<SelfMotionCurves::Place> place;
    std::size_t compared = 0;
    if (!found.places.empty()) {
      const auto [c, i] = found.places.back();
      const std::size_t count = found.curves[c].nodes.size();
      const auto node = node_near(motion, found.curves[c], q, near, i + count - std::min(beside, i),
                                  std::min(2 * beside, count));
      if (node) place = {c, *node};
    }
    for (std::size_t c = 0; c < found.curves.size() && !place; ++c) {
      if (const auto node = node_near(motion, found.curves[c], q, near)) place = {c, *node};
      compared += found.curves[c].nodes.size();
    }
    if (!place) {
      found.curves.push_back(motion.curve_through(pose, q));
      const auto node = node_near(motion, found.curves.back(), q, near);
      place = {found.curves.size() - 1, node.value_or(0)};
    }
    found.places.push_back(*place);
    if (budget.ended(static_cast<std::int64_t>(compared / compared_nodes))) break;
  }
  return found;
}

}  // namespace beeline::internal
