#include <algorithm>
#include <cmath>

#include <beeline/certificate/internal/path_checks.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/planning/internal/knot_sequence.h>
#include <beeline/planning/internal/null_space.h>

namespace beeline::internal {
namespace {

// The weight w of c(q), see the header. A joint in the inner half of its range costs less than
// 0.006 s^2 per layer, which is less than a step of 0.1 s; a joint at a limit costs 0.15 s^2.
constexpr double limit_weight = 0.003;  // seconds squared
constexpr double limit_offset = 0.02;
// Caps seconds per radian or metre, so that their squares are finite for any velocity limit.
constexpr double max_seconds_per_unit = 1e100;

}  // namespace

KnotCosts::KnotCosts(const Arm& arm) : seconds_per_unit(arm.dof()), bounds(bounds_of(arm)) {
  for (int k = 0; k < arm.dof(); ++k) {
    seconds_per_unit[k] = std::min(1 / velocity_limit_of(arm.limits(k)), max_seconds_per_unit);
  }
}

double GraphOptions::clearance_margin(const ConfigurationRef& q) const {
  return spare_clearance ? spare_clearance(q) / enough_spare_clearance : Limits::none;
}

std::optional<double> GraphOptions::clearance_margin(const ConfigurationRef& q,
                                                     BudgetMeter& budget) const {
  if (!spare_clearance) return Limits::none;
  if (budget.ended(spare_clearance_work)) return {};
  return clearance_margin(q);
}

double KnotCosts::node(const ConfigurationRef& q, double clearance_margin) const {
  double sum = limit_weight / (std::max(0.0, clearance_margin) + limit_offset);
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    const double margin = std::max(0.0, limit_margin(q[k], bounds.lower[k], bounds.upper[k]));
    sum += limit_weight / (margin + limit_offset);
  }
  return sum;
}

double KnotCosts::edge(const ConfigurationRef& step) const {
  return step.cwiseProduct(seconds_per_unit).squaredNorm();
}

std::optional<Configuration> solved_near(const Arm& arm, const Pose& pose, const Task& task,
                                         const Bounds& bounds, const Configuration& guess) {
  const NumericalResult found = levenberg_marquardt(arm, pose, task, bounds, guess,
                                                    {.tolerance = 1e-9, .max_iterations = 20});
  return found.converged ? std::optional(found.q) : std::nullopt;
}

double weighted_length(const Arm& arm, const Segment& segment) {
  constexpr int chords = 8;
  constexpr double per_radian = 0.2;
  const double per_metre = 1 / unit_of_length(arm);
  double size = 0;
  Pose before = pose_at(segment, 0);
  for (int i = 1; i <= chords; ++i) {
    const Pose here = pose_at(segment, static_cast<double>(i) / chords);
    const Twist chord = pose_difference(here, before);
    size += per_metre * chord.head<3>().norm() + per_radian * chord.tail<3>().norm();
    before = here;
  }
  return size;
}

std::vector<double> layer_parameters(const Arm& arm, const ToolPath& path, const Task& task,
                                     double spacing) {
  // Layers of one segment: the minimum suffices for a cubic spline, the maximum bounds the time.
  constexpr double min_layers = 4, max_layers = 400;
  const double nearest = spacing / 8;
  std::vector<double> parameters;
  double since = 0;  // the length behind the last layer
  for (std::size_t w = 0; w < path.segments.size(); ++w) {
    if (stands_still(path.segments[w], task)) continue;
    const double begin = static_cast<double>(w), length = weighted_length(arm, path.segments[w]);
    const bool last = w + 1 == path.segments.size() || corner_at(path, begin + 1) ||
                      stands_still(path.segments[w + 1], task);
    since += length;
    if (!last && since < nearest) continue;
    const double wanted = std::clamp(std::ceil(length / spacing), min_layers, max_layers);
    const double count = std::min(wanted, std::max(1.0, std::floor(since / nearest)));
    for (double i = 1; i <= count; ++i) parameters.push_back(begin + i / count);
    since = 0;
  }
  return parameters;
}

namespace {

/// Returns the bounds moved inwards by a margin, or by the margin of q if it is smaller.
Bounds inner(Bounds bounds, double margin, const Configuration& q) {
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    margin = std::min(margin, limit_margin(q[k], bounds.lower[k], bounds.upper[k]));
  }
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    const double width = std::max(margin, 0.0) * (bounds.upper[k] - bounds.lower[k]) / 2;
    if (!std::isfinite(width)) continue;
    bounds.lower[k] += width;
    bounds.upper[k] -= width;
  }
  return bounds;
}

}  // namespace

void smooth_knots(const Arm& arm, const ToolPath& path, const GraphOptions& options, double margin,
                  BudgetMeter& budget, std::vector<Knot>& knots) {
  // Gauss-Seidel passes with relaxation 1/2. 24 passes remove the alternating steps of the grid;
  // oscillations over many knots remain, which take little time. The push away from the limits is
  // small relative to the steps of the grid.
  constexpr int passes = 24;
  constexpr double relaxation = 0.5, push = 0.02;
  constexpr double largest_move = 0.3;  // of a joint; a larger one leads to another branch
  std::vector<double> spans;
  std::vector<Pose> poses;
  std::vector<Bounds> bounds;
  std::vector<double> clearances;  // to be kept
  for (const Knot& knot : knots) {
    clearances.push_back(std::min(margin, options.clearance_margin(knot.q)));
    spans.push_back(span_to(path, knot.s));
    poses.push_back(pose_at(path, knot.s));
    bounds.push_back(inner(bounds_of(arm), margin, knot.q));
  }
  for (int pass = 0; pass < passes; ++pass) {
    for (std::size_t r = options.start ? 1 : 0; r < knots.size(); ++r) {
      if (budget.ended()) return;
      const Configuration& q = knots[r].q;
      const Configuration& before = knots[r == 0 ? 0 : r - 1].q;
      const Configuration& after = knots[std::min(r + 1, knots.size() - 1)].q;
      const bool end = r == 0 || r + 1 == knots.size();
      const double t = end ? 0.5 : (spans[r] - spans[r - 1]) / (spans[r + 1] - spans[r - 1]);
      Configuration wanted = q + relaxation * (before + t * (after - before) - q);
      for (Eigen::Index k = 0; k < q.size(); ++k) {
        wanted[k] += push * push_from_limits(q[k], bounds[r].lower[k], bounds[r].upper[k]);
      }
      const auto found = solved_near(arm, poses[r], options.task, bounds[r], wanted);
      if (found && (*found - q).lpNorm<Eigen::Infinity>() < largest_move &&
          options.clearance_margin(*found) >= clearances[r]) {
        knots[r].q = *found;
      }
    }
    budget.report((pass + 1.0) / passes);
  }
}

KnotSpline::KnotSpline(const std::vector<Knot>& knots, const ToolPath& path)
    : path_(path), spans_{0}, first_(knots.front().q) {
  for (const double span : path.spans) spans_.push_back(spans_.back() + span);
  std::vector<double> spans;
  std::vector<Configuration> q;
  const auto end_part = [&] {
    if (spans.size() > 1) parts_.push_back(joint_spline(q, spans));
    spans = {spans.back()};
    q = {q.back()};
  };
  for (const Knot& knot : knots) {
    const double span = span_at(knot.s);
    if (!spans.empty() && !(span > spans.back())) continue;
    spans.push_back(span);
    q.push_back(knot.q);
    if (corner_at(path, knot.s)) end_part();
  }
  end_part();
}

/// span_to() without the sum over all segments.
double KnotSpline::span_at(double s) const {
  const std::size_t i = segment_at(path_, s);
  return spans_[i] + (s - static_cast<double>(i)) * path_.spans[i];
}

Configuration KnotSpline::at(double s) const {
  if (parts_.empty()) return first_;
  const double span = span_at(s);
  const auto begins_after = [](double x, const JointPath& part) { return x < part.s.front(); };
  const auto part = std::upper_bound(parts_.begin() + 1, parts_.end(), span, begins_after) - 1;
  const auto next = std::upper_bound(part->s.begin() + 1, part->s.end() - 1, span);
  const auto k = static_cast<std::size_t>(next - part->s.begin()) - 1;
  const double t = (span - part->s[k]) / (part->s[k + 1] - part->s[k]);
  return path_point(*part, k, std::clamp(t, 0.0, 1.0)).q;
}

}  // namespace beeline::internal
