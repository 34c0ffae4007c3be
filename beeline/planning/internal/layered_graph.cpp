#include <algorithm>
#include <cmath>

#include <beeline/certificate/path_deviation.h>
#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/inverse/numerical/representative.h>
#include <beeline/path/joint_spline.h>
#include <beeline/planning/internal/layered_graph.h>
#include <beeline/planning/internal/null_space.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline {
namespace {

constexpr double longest_edge = 1.2;  // radians or metres of one joint between neighbours
constexpr int max_repairs = 60;       // edges that turn out not to lead on
constexpr int smoothings = 12;
constexpr double limit_weight = 0.003;  // of nearness to limits, against the square of seconds

/// One place on the path and the solutions there.
struct Rung {
  double place = 0;
  Pose pose;
  std::vector<Configuration> solutions;
  std::vector<double> cost;  ///< of the best chain from the first rung
  std::vector<int> before;   ///< its solution on the rung before; -1: none
};

/// About how far the tool moves on a segment, turns too.
double size_of(const Segment& segment) {
  constexpr int chords = 8;
  double size = 0;
  Pose before = pose_at(segment, 0);
  for (int i = 1; i <= chords; ++i) {
    const Pose now = pose_at(segment, static_cast<double>(i) / chords);
    const Twist way = pose_difference(now, before);
    size += way.head<3>().norm() + metres_per_radian * way.tail<3>().norm();
    before = now;
  }
  return size;
}

/// None where what matters stands still.
std::vector<Rung> rungs(const ToolPath& path, const Task& task, double spacing) {
  std::vector<Rung> all{{0, pose_at(path, 0), {}, {}, {}}};
  for (std::size_t w = 0; w < path.segments.size(); ++w) {
    if (stands_still(path.segments[w], task)) continue;
    const double wanted = std::ceil(size_of(path.segments[w]) / spacing);
    const int parts = static_cast<int>(std::clamp(wanted, 4.0, 400.0));
    for (int i = 1; i <= parts; ++i) {
      const double s = static_cast<double>(i) / parts;
      all.push_back({static_cast<double>(w) + s, pose_at(path.segments[w], s), {}, {}, {}});
    }
  }
  return all;
}

/// The graph's costs, in seconds squared.
struct Costs {
  Eigen::VectorXd pace;  ///< seconds a radian or metre
  internal::Bounds bounds;

  explicit Costs(const Arm& arm) : pace(arm.dof()), bounds(internal::bounds_of(arm)) {
    for (int k = 0; k < arm.dof(); ++k) {
      pace[k] = 1 / held_velocity(arm.limits(k));
    }
  }
  double near_limits(const Configuration& q) const {
    double sum = 0;
    for (Eigen::Index k = 0; k < q.size(); ++k) {
      sum += limit_weight /
             (std::max(0.0, limit_margin(q[k], bounds.lower[k], bounds.upper[k])) + 0.02);
    }
    return sum;
  }
  double step(const Configuration& a, const Configuration& b) const {
    return (b - a).cwiseProduct(pace).squaredNorm();
  }
};

struct Edge {
  std::size_t rung;
  int from, to;
  bool operator==(const Edge&) const = default;
};

/// Fills in costs from the rung `first` on; returns how many rungs can be reached.
std::size_t relax(std::vector<Rung>& all, const Costs& costs, const std::vector<Edge>& closed,
                  std::size_t first) {
  for (std::size_t r = first; r < all.size(); ++r) {
    Rung& rung = all[r];
    rung.cost.assign(rung.solutions.size(), Limits::none);
    rung.before.assign(rung.solutions.size(), -1);
    bool reached = false;
    for (std::size_t j = 0; j < rung.solutions.size(); ++j) {
      const Configuration& q = rung.solutions[j];
      if (r == 0) {
        rung.cost[j] = costs.near_limits(q);
        reached = true;
        continue;
      }
      const Rung& last = all[r - 1];
      for (std::size_t i = 0; i < last.solutions.size(); ++i) {
        if (!(last.cost[i] < rung.cost[j])) continue;
        const Configuration& p = last.solutions[i];
        if ((q - p).lpNorm<Eigen::Infinity>() > longest_edge) continue;
        const double cost = last.cost[i] + costs.step(p, q);
        if (cost >= rung.cost[j]) continue;
        const Edge edge{r, static_cast<int>(i), static_cast<int>(j)};
        if (std::find(closed.begin(), closed.end(), edge) != closed.end()) continue;
        rung.cost[j] = cost;
        rung.before[j] = static_cast<int>(i);
      }
      if (rung.before[j] < 0) continue;
      rung.cost[j] += costs.near_limits(q);
      reached = true;
    }
    if (!reached) return r;
  }
  return all.size();
}

/// The best chain to the rung before `end`: its solutions' numbers.
std::vector<int> chain_to(const std::vector<Rung>& all, std::size_t end) {
  std::vector<int> chain(end);
  const auto& costs = all[end - 1].cost;
  chain[end - 1] = static_cast<int>(std::min_element(costs.begin(), costs.end()) - costs.begin());
  for (std::size_t r = end - 1; r > 0; --r) {
    chain[r - 1] = all[r].before[chain[r]];
  }
  return chain;
}

/// Whether half-way between two solutions there is one near their middle.
bool leads_on(const Arm& arm, const ToolPath& path, const Task& task,
              const internal::Bounds& bounds, const Knot& a, const Knot& b) {
  const Configuration middle = (a.q + b.q) / 2;
  const double begin = std::max(a.place, static_cast<double>(segment_at(path, b.place)));
  const internal::NumericalResult found =
      internal::levenberg_marquardt(arm, pose_at(path, (begin + b.place) / 2), task, bounds, middle,
                                    {.tolerance = 1e-9, .iterations = 20});
  const double way = (b.q - a.q).lpNorm<Eigen::Infinity>();
  return found.converged && (found.q - middle).lpNorm<Eigen::Infinity>() < 0.3 * way + 0.02;
}

/// Draws the chain taut: each knot towards its neighbours' middle and away from limits, as far as
/// the tool's pose leaves it free.
void smooth(const Arm& arm, const ToolPath& path, const Task& task, const Costs& costs,
            const std::vector<Rung>& all, bool first_is_fixed, std::vector<Knot>& knots) {
  constexpr double pull = 0.5, push = 0.02;
  std::vector<double> ways;
  for (const Knot& knot : knots) ways.push_back(span_to(path, knot.place));
  for (int pass = 0; pass < smoothings; ++pass) {
    for (std::size_t r = first_is_fixed ? 1 : 0; r < knots.size(); ++r) {
      const Configuration& q = knots[r].q;
      const Configuration& before = knots[r == 0 ? 0 : r - 1].q;
      const Configuration& after = knots[std::min(r + 1, knots.size() - 1)].q;
      const bool end = r == 0 || r + 1 == knots.size();
      const double share = end ? 0.5 : (ways[r] - ways[r - 1]) / (ways[r + 1] - ways[r - 1]);
      Configuration wanted = q + pull * (before + share * (after - before) - q);
      for (Eigen::Index k = 0; k < q.size(); ++k) {
        wanted[k] += push * push_from_limits(q[k], costs.bounds.lower[k], costs.bounds.upper[k]);
      }
      const internal::NumericalResult found = internal::levenberg_marquardt(
          arm, all[r].pose, task, costs.bounds, wanted, {.tolerance = 1e-9, .iterations = 20});
      if (found.converged && (found.q - q).lpNorm<Eigen::Infinity>() < 0.3) knots[r].q = found.q;
    }
  }
}

}  // namespace

KnotSequence search_layered_graph(const Arm& arm, const ToolPath& path,
                                  const LayeredGraphOptions& options) {
  std::vector<Rung> all = rungs(path, options.task, options.spacing);
  const std::size_t wanted = all.size();
  const Costs costs(arm);
  InverseSolver solver(arm, {.task = options.task,
                             .all = true,
                             .every_turn = false,
                             .grid = options.grid,
                             .tolerance = 1e-9,
                             .restarts = 4 * options.grid});
  const Configuration middle = middle_configuration(arm);
  Eigen::MatrixXd columns(arm.dof(), 16 * options.grid);
  Configuration own = options.start.value_or(Configuration());  // the start, led on: off the grid
  for (std::size_t r = 0; r < all.size(); ++r) {
    if (r == 0 && options.start) {
      all[r].solutions = {*options.start};
    } else {
      const int count = solver.solve(all[r].pose, middle, columns);
      for (int i = 0; i < count; ++i) all[r].solutions.emplace_back(columns.col(i));
    }
    if (r > 0 && own.size() > 0) {
      const internal::NumericalResult on = internal::levenberg_marquardt(
          arm, all[r].pose, options.task, costs.bounds, own, {.tolerance = 1e-9, .iterations = 20});
      own = on.converged ? on.q : Configuration();
      if (on.converged) all[r].solutions.push_back(own);
    }
    if (all[r].solutions.empty()) {
      all.resize(r);
      break;
    }
  }
  if (all.empty()) return {};

  std::vector<Edge> closed;
  KnotSequence result;
  std::size_t first = 0;
  for (int repair = 0; repair <= max_repairs; ++repair) {
    const std::size_t end = relax(all, costs, closed, first);
    if (end == 0) return result;
    const std::vector<int> chain = chain_to(all, end);
    std::vector<Knot> knots;
    std::size_t r = 0;
    for (; r < end; ++r) {
      const Knot next{all[r].place, all[r].solutions[chain[r]]};
      if (r > 0 && !leads_on(arm, path, options.task, costs.bounds, knots.back(), next)) {
        closed.push_back({r, chain[r - 1], chain[r]});
        break;
      }
      knots.push_back(next);
    }
    if (knots.size() > result.knots.size()) result.knots = knots;
    result.through = knots.size() == wanted;
    if (r == end) break;  // as far as there are solutions
    first = r;
  }
  if (result.knots.size() > 1) {
    smooth(arm, path, options.task, costs, all, options.start.has_value(), result.knots);
  }
  return result;
}

KnotSpline::KnotSpline(const std::vector<Knot>& knots, const ToolPath& path)
    : path_(path), first_(knots.front().q) {
  std::vector<double> ways;
  std::vector<Configuration> q;
  const auto end_part = [&] {
    if (ways.size() > 1) parts_.push_back(joint_spline(q, ways));
    ways = {ways.back()};
    q = {q.back()};
  };
  for (const Knot& knot : knots) {
    const double way = span_to(path, knot.place);
    if (!ways.empty() && !(way > ways.back())) continue;
    ways.push_back(way);
    q.push_back(knot.q);
    if (corner_at(path, knot.place)) end_part();
  }
  end_part();
}

Configuration KnotSpline::at(double place) const {
  if (parts_.empty()) return first_;
  const double way = span_to(path_, place);
  const auto begins_after = [](double w, const JointPath& part) { return w < part.s.front(); };
  auto part = std::upper_bound(parts_.begin() + 1, parts_.end(), way, begins_after) - 1;
  const auto next = std::upper_bound(part->s.begin() + 1, part->s.end() - 1, way);
  const auto k = static_cast<std::size_t>(next - part->s.begin()) - 1;
  const double share = (way - part->s[k]) / (part->s[k + 1] - part->s[k]);
  return path_point(*part, k, std::clamp(share, 0.0, 1.0)).q;
}

}  // namespace beeline
