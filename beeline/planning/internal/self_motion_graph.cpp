#include <algorithm>
#include <cmath>

#include <beeline/inverse/numerical/representative.h>
#include <beeline/math/revolution.h>
#include <beeline/planning/internal/self_motion_graph.h>
#include <beeline/planning/internal/self_motion_sweep.h>

namespace beeline::internal {
namespace {

using Node = RedundantConfiguration;
using Place = SelfMotionLayer::Place;

constexpr std::size_t nowhere = SelfMotionLayer::nowhere;
constexpr double sweep_share = 0.8;  // of the progress; smooth_knots() has the remainder
// Largest change of one joint over an edge, radians or metres.
constexpr double largest_change = 1.2;

/// Returns which coordinates the graph treats as angles without limits: coordinates without limits
/// and, without a start, coordinates with a range of two revolutions or more, in which almost any
/// motion fits after a shift.
std::vector<bool> cyclic_coordinates(const Arm& arm, bool any_range) {
  std::vector<bool> cyclic;
  for (int k = 0; k < arm.dof(); ++k) {
    const double range = arm.limits(k).upper - arm.limits(k).lower;
    cyclic.push_back(arm.periodic(k) &&
                     (std::isinf(range) || (any_range && range >= 2 * revolution)));
  }
  return cyclic;
}

/// Dynamic programming over the layers.
class BestPath {
 public:
  /// `allowance`: of each layer, what its configurations may lack of the margin.
  BestPath(const std::vector<SelfMotionLayer>& layers, const std::vector<double>& allowance,
           const SelfMotion& motion, const KnotCosts& costs)
      : layers_(layers), allowance_(allowance), motion_(motion), costs_(costs) {
    constexpr double fraction = 0.8, enough = 0.25;
    required_ = fraction * std::min(largest_margin(), enough);
  }

  double required_margin() const { return required_; }

  /// Calls f(k, q) for the nodes of the next layer to which edges lead from node i of layer r.
  template <class Visit>
  void for_each_edge(std::size_t r, std::size_t i, const Node& q, const Visit& f) const {
    const Place place = layers_[r].continuation[i];
    if (place.curve == nowhere) return;
    const SelfMotionCurve& curve = layers_[r + 1].curves[place.curve];
    const std::size_t first = layers_[r + 1].first[place.curve], count = curve.nodes.size();
    std::size_t visited = 0;
    Node step;
    const auto visit = [&](std::size_t k) {
      if (!motion_.difference_within(largest_change, curve.nodes[k], q, step)) return false;
      if (visited++ >= count) return false;
      const bool blocked = layers_[r + 1].clearance_margin[first + k] < 0;
      if (!blocked) f(first + k, step);
      // The continuation itself may be blocked where a motion to the side is not.
      return !blocked || k == place.node;
    };
    const auto next = [&](std::size_t k) {
      return k + 1 < count ? k + 1 : curve.closed ? 0 : count;
    };
    for (std::size_t k = place.node; k < count && visit(k); k = next(k)) {
    }
    const auto before = [&](std::size_t k) {
      return k > 0 ? k - 1 : curve.closed ? count - 1 : count;
    };
    for (std::size_t k = before(place.node); k < count && visit(k); k = before(k)) {
    }
  }

  template <class Visit>
  void for_each_node(std::size_t r, const Visit& f) const {
    std::size_t i = 0;
    for (const SelfMotionCurve& curve : layers_[r].curves) {
      for (const Node& q : curve.nodes) f(i++, q);
    }
  }

  /// The margin of node i of layer r with the allowance; negative if the node is blocked.
  double allowed_margin(std::size_t r, std::size_t i) const {
    const double clearance = layers_[r].clearance_margin[i];
    if (clearance < 0) return clearance;
    return std::min(layers_[r].margin[i], clearance) + allowance_[r];
  }

  /// The largest smallest margin m* of a path to the last layer that one reaches.
  double largest_margin() {
    std::vector<double> now(layers_.front().size());
    for (std::size_t i = 0; i < now.size(); ++i) now[i] = allowed_margin(0, i);
    double best = *std::max_element(now.begin(), now.end());
    for (std::size_t r = 0; r + 1 < layers_.size(); ++r) {
      std::vector<double> next(layers_[r + 1].size(), -1);
      for_each_node(r, [&](std::size_t i, const Node& q) {
        if (now[i] < 0) return;
        for_each_edge(r, i, q, [&](std::size_t k, const Node&) {
          next[k] = std::max(next[k], std::min(now[i], allowed_margin(r + 1, k)));
        });
      });
      const double here = *std::max_element(next.begin(), next.end());
      if (here < 0) break;
      best = here;
      reached_ = r + 1;
      now = std::move(next);
    }
    return best;
  }

  /// Whether node i of layer r has the required margin.
  bool allowed(std::size_t r, std::size_t i) const { return allowed_margin(r, i) >= required_; }

  /// The nodes of the best path, as far as one leads.
  std::vector<Node> nodes() const {
    std::vector<std::vector<double>> cost(reached_ + 1);
    std::vector<std::vector<std::size_t>> from(reached_ + 1);
    cost[0].assign(layers_[0].size(), Limits::none);
    from[0].assign(layers_[0].size(), nowhere);
    for_each_node(0, [&](std::size_t i, const Node& q) {
      if (allowed(0, i)) cost[0][i] = costs_.node(q, layers_[0].clearance_margin[i]);
    });
    for (std::size_t r = 0; r < reached_; ++r) {
      cost[r + 1].assign(layers_[r + 1].size(), Limits::none);
      from[r + 1].assign(layers_[r + 1].size(), nowhere);
      for_each_node(r, [&](std::size_t i, const Node& q) {
        if (!(cost[r][i] < Limits::none)) return;
        for_each_edge(r, i, q, [&](std::size_t k, const Node& step) {
          if (!allowed(r + 1, k)) return;
          const double here = cost[r][i] + costs_.edge(step);
          if (!(here < cost[r + 1][k])) return;
          cost[r + 1][k] = here;
          from[r + 1][k] = i;
        });
      });
      for_each_node(r + 1, [&](std::size_t k, const Node& q) {
        if (!(cost[r + 1][k] < Limits::none)) return;
        cost[r + 1][k] += costs_.node(q, layers_[r + 1].clearance_margin[k]);
      });
    }
    const auto& ends = cost[reached_];
    auto i = static_cast<std::size_t>(std::min_element(ends.begin(), ends.end()) - ends.begin());
    std::vector<Node> nodes;
    for (std::size_t r = reached_ + 1; r-- > 0; i = from[r][i]) nodes.push_back(layers_[r].node(i));
    std::reverse(nodes.begin(), nodes.end());
    return nodes;
  }

 private:
  const std::vector<SelfMotionLayer>& layers_;
  const std::vector<double>& allowance_;
  const SelfMotion& motion_;
  const KnotCosts& costs_;
  std::size_t reached_ = 0;
  double required_ = 0;
};

/// Shifts the cyclic coordinates with limits by multiples of 2 pi into their limits, with the
/// largest margin; those without limits to a first value in [-pi, pi]. Returns whether all fit.
bool shift_into_limits(const Arm& arm, const std::vector<bool>& cyclic, std::vector<Knot>& knots) {
  for (int k = 0; k < arm.dof(); ++k) {
    if (!cyclic[static_cast<std::size_t>(k)]) continue;
    double low = knots.front().q[k], high = low;
    for (const Knot& knot : knots) {
      low = std::min(low, knot.q[k]);
      high = std::max(high, knot.q[k]);
    }
    const Limits& limits = arm.limits(k);
    const bool limited = std::isfinite(limits.upper - limits.lower);
    const double away =
        limited ? (limits.upper + limits.lower - low - high) / 2 : -knots.front().q[k];
    const double shift = std::round(away / revolution) * revolution;
    for (Knot& knot : knots) knot.q[k] += shift;
    if (low + shift < limits.lower || high + shift > limits.upper) return false;
  }
  return true;
}

/// The nodes of a path as knots, with the tool at the path's poses to rounding; cyclic coordinates
/// are continuous.
std::vector<Knot> knots_through(const std::vector<Node>& nodes, const SelfMotionSweep& sweep,
                                const Arm& arm, const ToolPath& path, const GraphOptions& options) {
  std::vector<Knot> knots;
  for (std::size_t r = 0; r < nodes.size(); ++r) {
    const double s = sweep.layers()[r].s;
    Configuration q = nodes[r];
    if (r == 0 && options.start) q = *options.start;
    if (r > 0) q = knots[r - 1].q + sweep.motion().difference(nodes[r], Node(knots[r - 1].q));
    const bool given = r == 0 && options.start;
    const auto exact =
        given ? std::nullopt
              : solved_near(arm, pose_at(path, s), options.task, sweep.motion().bounds(), q);
    knots.push_back({s, exact.value_or(q)});
  }
  return knots;
}

/// Returns the allowed deficit of the margin in each layer, which is positive near a given start.
std::vector<double> allowances(const Arm& arm, const std::vector<SelfMotionLayer>& layers,
                               const ToolPath& path, bool given_start) {
  constexpr double largest = 0.25, distance = 0.3;
  std::vector<double> ends{0};  // weighted lengths up to the ends of segments
  for (const Segment& segment : path.segments) {
    ends.push_back(ends.back() + weighted_length(arm, segment));
  }
  std::vector<double> allowance;
  for (const SelfMotionLayer& layer : layers) {
    const std::size_t i = segment_at(path, layer.s);
    const double length = std::lerp(ends[i], ends[i + 1], layer.s - static_cast<double>(i));
    const double left = 1 - length / distance;
    allowance.push_back(given_start ? largest * std::max(0.0, left) : 0);
  }
  return allowance;
}

/// search_self_motion_graph() with these coordinates as angles without limits; nothing if the
/// motion does not fit into the limits.
std::optional<KnotSequence> search(const Arm& arm, const ToolPath& path,
                                   const GraphOptions& options, const std::vector<bool>& cyclic,
                                   BudgetMeter& budget) {
  BudgetMeter sweeping(budget.part(0, sweep_share));
  SelfMotionSweep sweep(arm, path, options, cyclic, sweeping);
  KnotSequence result;
  result.complete = sweep.run();
  const std::vector<SelfMotionLayer>& layers = sweep.layers();
  if (layers.empty()) return result;
  const KnotCosts costs(arm);
  const std::vector<double> allowance = allowances(arm, layers, path, options.start.has_value());
  const BestPath best(layers, allowance, sweep.motion(), costs);
  if (options.spare_clearance && best.required_margin() < 0) return result;  // all are blocked
  result.knots = knots_through(best.nodes(), sweep, arm, path, options);
  result.complete = result.complete && result.knots.size() == layers.size();
  if (!options.start && !shift_into_limits(arm, cyclic, result.knots)) return {};
  BudgetMeter smoothing(budget.part(sweep_share, 1));
  smooth_knots(arm, path, options, best.required_margin(), smoothing, result.knots);
  return result;
}

}  // namespace

KnotSequence search_self_motion_graph(const Arm& arm, const ToolPath& path,
                                      const GraphOptions& options) {
  BudgetMeter budget(options.budget);
  if (!options.start) {
    const auto found = search(arm, path, options, cyclic_coordinates(arm, true), budget);
    if (found) return *found;
  }
  return search(arm, path, options, cyclic_coordinates(arm, false), budget)
      .value_or(KnotSequence{});
}

bool has_self_motion_path(const Arm& arm, const ToolPath& path, const GraphOptions& options) {
  BudgetMeter budget(options.budget);
  return SelfMotionSweep(arm, path, options, cyclic_coordinates(arm, !options.start), budget).run();
}

}  // namespace beeline::internal
