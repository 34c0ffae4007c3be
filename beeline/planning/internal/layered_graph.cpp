#include <algorithm>
#include <cmath>

#include <beeline/certificate/internal/path_checks.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/inverse/numerical/representative.h>
#include <beeline/planning/internal/layered_graph.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {
namespace {

// Largest change of one joint over an edge, radians or metres. Joints usually change by a tenth of
// that between layers. The limit saves time: most edges between different branches exceed it, and
// the test at the midpoint refuses the others.
constexpr double longest_edge = 1.2;
// Max edges that the test at the midpoint may remove; each costs a relaxation of the layers after
// it. It bounds the time; the path found by then is used.
constexpr std::size_t max_removed_edges = 60;

/// A pose of the path and its solutions.
struct Layer {
  double s = 0;
  Pose pose = {};
  std::vector<Configuration> solutions = {};
  std::vector<double> clearance_margin = {};  ///< of each solution
  std::vector<double> cost = {};  ///< of the shortest path to each solution from the first layer
  std::vector<int> predecessor = {};  ///< of each solution, in the layer before; -1: none
};

struct Edge {
  std::size_t layer;  ///< in which it ends
  int from, to;       ///< solutions
  bool operator==(const Edge&) const = default;
};

/// Returns layers without solutions.
std::vector<Layer> empty_layers(const Arm& arm, const ToolPath& path, const Task& task,
                                double spacing) {
  std::vector<Layer> layers{{0, pose_at(path, 0)}};
  for (const double s : layer_parameters(arm, path, task, spacing)) {
    layers.push_back({s, pose_at(path, s)});
  }
  return layers;
}

/// Removes the solutions that are blocked, and fills in the clearance margins of the others.
void keep_unblocked(const GraphOptions& options, BudgetMeter& budget, Layer& layer) {
  std::vector<Configuration> kept;
  for (const Configuration& q : layer.solutions) {
    const std::optional<double> margin = options.clearance_margin(q, budget);
    if (!margin || *margin < 0) continue;
    kept.push_back(q);
    layer.clearance_margin.push_back(*margin);
  }
  layer.solutions = std::move(kept);
}

/// Fills in the solutions of the layers, and removes the first layer that has none and all after
/// it.
void solve(std::vector<Layer>& layers, const Arm& arm, const KnotCosts& costs,
           const GraphOptions& options, BudgetMeter& budget) {
  const InverseOptions all{.task = options.task,
                           .all = true,
                           .every_turn = false,
                           .grid = options.grid,
                           .tolerance = 1e-9,
                           .max_restarts = 4 * options.grid,
                           .budget = budget.part()};
  const Configuration middle = middle_configuration(arm);
  Eigen::MatrixXd columns(arm.dof(), 16 * options.grid);
  // The start is not on the grid: its continuation is added to the solutions of each layer.
  std::optional<Configuration> continuation = options.start;
  for (std::size_t r = 0; r < layers.size(); ++r) {
    std::vector<Configuration>& solutions = layers[r].solutions;
    if (r == 0 && options.start) {
      solutions = {*options.start};
    } else {
      const int count = inverse_kinematics(arm, layers[r].pose, middle, columns, all);
      for (int i = 0; i < count; ++i) solutions.emplace_back(columns.col(i));
    }
    if (r > 0 && continuation) {
      continuation = solved_near(arm, layers[r].pose, options.task, costs.bounds, *continuation);
      if (continuation) solutions.push_back(*continuation);
    }
    keep_unblocked(options, budget, layers[r]);
    if (solutions.empty() || budget.ended()) {
      layers.resize(r);
      break;
    }
    constexpr double share = 0.9;  // of the progress
    budget.report(share * static_cast<double>(r + 1) / static_cast<double>(layers.size()));
  }
}

/// Computes the shortest paths to the solutions of one layer; returns whether any can be reached.
bool relax(const Layer& before, Layer& layer, std::size_t r, const KnotCosts& costs,
           const std::vector<Edge>& removed, BudgetMeter& budget) {
  bool reached = false;
  for (std::size_t j = 0; j < layer.solutions.size(); ++j) {
    if (budget.ended()) return false;
    const Configuration& q = layer.solutions[j];
    for (std::size_t i = 0; i < before.solutions.size(); ++i) {
      if (!(before.cost[i] < layer.cost[j])) continue;
      const Configuration& p = before.solutions[i];
      if ((q - p).lpNorm<Eigen::Infinity>() > longest_edge) continue;
      const double cost = before.cost[i] + costs.edge(q - p);
      if (!(cost < layer.cost[j])) continue;
      const Edge edge{r, static_cast<int>(i), static_cast<int>(j)};
      if (std::find(removed.begin(), removed.end(), edge) != removed.end()) continue;
      layer.cost[j] = cost;
      layer.predecessor[j] = edge.from;
    }
    if (layer.predecessor[j] < 0) continue;
    layer.cost[j] += costs.node(q, layer.clearance_margin[j]);
    reached = true;
  }
  return reached;
}

/// Does the same for all layers from `first` on; returns the number of layers that can be reached.
std::size_t relax(std::vector<Layer>& layers, const KnotCosts& costs,
                  const std::vector<Edge>& removed, std::size_t first, BudgetMeter& budget) {
  for (std::size_t r = first; r < layers.size(); ++r) {
    Layer& layer = layers[r];
    layer.cost.assign(layer.solutions.size(), Limits::none);
    layer.predecessor.assign(layer.solutions.size(), -1);
    if (r > 0) {
      if (!relax(layers[r - 1], layer, r, costs, removed, budget)) return r;
      continue;
    }
    for (std::size_t j = 0; j < layer.solutions.size(); ++j) {
      layer.cost[j] = costs.node(layer.solutions[j], layer.clearance_margin[j]);
    }
  }
  return layers.size();
}

/// Returns the shortest path to the layer before `end`: the index of its solution in each layer.
std::vector<int> shortest_path(const std::vector<Layer>& layers, std::size_t end) {
  std::vector<int> chosen(end);
  const auto& costs = layers[end - 1].cost;
  chosen[end - 1] = static_cast<int>(std::min_element(costs.begin(), costs.end()) - costs.begin());
  for (std::size_t r = end - 1; r > 0; --r) {
    chosen[r - 1] = layers[r].predecessor[static_cast<std::size_t>(chosen[r])];
  }
  return chosen;
}

/// Whether a continuous motion is likely to join two knots: the path's pose half-way has a solution
/// near their midpoint, within 0.3 of the edge's length plus an offset for short edges, that is not
/// blocked.
bool is_continuous(const Arm& arm, const ToolPath& path, const GraphOptions& options,
                   const Bounds& bounds, const Knot& a, const Knot& b) {
  constexpr double fraction = 0.3, offset = 0.02;  // of the edge; radians or metres
  const Configuration middle = (a.q + b.q) / 2;
  const double begin = std::max(a.s, static_cast<double>(segment_at(path, b.s)));
  const Pose pose = pose_at(path, (begin + b.s) / 2);
  const auto q = solved_near(arm, pose, options.task, bounds, middle);
  const double length = (b.q - a.q).lpNorm<Eigen::Infinity>();
  return q && (*q - middle).lpNorm<Eigen::Infinity>() < fraction * length + offset &&
         options.clearance_margin(*q) >= 0;
}

}  // namespace

KnotSequence search_layered_graph(const Arm& arm, const ToolPath& path,
                                  const GraphOptions& options) {
  BudgetMeter budget(options.budget);
  const KnotCosts costs(arm);
  std::vector<Layer> layers = empty_layers(arm, path, options.task, options.spacing);
  const std::size_t wanted = layers.size();
  solve(layers, arm, costs, options, budget);
  if (layers.empty()) return {};
  std::vector<Edge> removed;
  KnotSequence result;
  std::size_t first = 0;
  while (removed.size() <= max_removed_edges) {
    const std::size_t end = relax(layers, costs, removed, first, budget);
    const std::vector<int> chosen = shortest_path(layers, end);
    std::vector<Knot> knots;
    std::size_t r = 0;
    const auto cancelled = [&] { return budget.ended(0) && budget.ending() == Ending::cancelled; };
    for (; r < end && !cancelled(); ++r) {
      const Knot next{layers[r].s, layers[r].solutions[static_cast<std::size_t>(chosen[r])]};
      if (r > 0 && !is_continuous(arm, path, options, costs.bounds, knots.back(), next)) {
        removed.push_back({r, chosen[r - 1], chosen[r]});
        break;
      }
      knots.push_back(next);
    }
    if (knots.size() > result.knots.size()) result.knots = knots;
    result.complete = knots.size() == wanted;
    if (r == end || budget.ended()) break;
    first = r;
  }
  if (result.knots.size() > 1) {
    smooth_knots(arm, path, options, 0, budget, result.knots);
  }
  return result;
}

}  // namespace beeline::internal
