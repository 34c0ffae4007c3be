#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <ostream>
#include <random>
#include <utility>

#include <beeline/internal/random_fraction.h>
#include <beeline/planning/free_path.h>
#include <beeline/planning/internal/free_edges.h>
#include <beeline/planning/internal/joint_tree.h>
#include <beeline/planning/internal/shortened_path.h>
#include <beeline/planning/internal/unblocked_motion.h>

namespace beeline {

using namespace internal;

namespace {

constexpr double most_nodes = 64;     // of an edge, which are then farther apart
constexpr double node_spacing = 0.5;  // along an edge of a tree, as the norm of the difference
// Trees grow first to the goals whose distance is at most this multiple of the nearest one's, and
// examine at most so many edges. So many they also examine to replace a straight joint motion.
constexpr double near_goals = 1.5;
constexpr int near_goal_edges = 1000;
// Trees that do not meet within so many edges begin again, with twice as many: few searches take
// long, and others with other random configurations then end soon.
constexpr std::size_t edges_until_restart = 4000;
constexpr double least_advance = 0.01;  // of a tree; less is a dead end
// A tree stops before the place where an edge is blocked, because every motion from there is as
// near to a body.
constexpr double usable = 0.9;
// A path longer than this multiple of the distance to the nearest goal often goes around the wrong
// side: so many further pairs of trees search for a shorter one.
constexpr double long_detour = 2.5;
constexpr int further_searches = 4;
// Units of work for the proof of a straight motion to a goal that is nearly as near to a body as
// the clearance permits.
constexpr std::int64_t close_proof_work = 40'000;

/// The configurations within the position limits. Joints without limits are within half a
/// revolution of the start and the goals.
class JointSpace {
 public:
  JointSpace(const Arm& arm, const Configuration& start, std::span<const Configuration> goals)
      : lower_(start), upper_(start) {
    for (const Configuration& goal : goals) {
      lower_ = lower_.cwiseMin(goal);
      upper_ = upper_.cwiseMax(goal);
    }
    for (int i = 0; i < arm.dof(); ++i) {
      const Limits& limits = arm.limits(i);
      lower_[i] = std::isfinite(limits.lower) ? limits.lower : lower_[i] - std::numbers::pi;
      upper_[i] = std::isfinite(limits.upper) ? limits.upper : upper_[i] + std::numbers::pi;
    }
  }

  Configuration random(std::mt19937_64& engine) const {
    Configuration q(lower_.size());
    for (Eigen::Index i = 0; i < q.size(); ++i) {
      q[i] = lower_[i] + random_fraction(engine) * (upper_[i] - lower_[i]);
    }
    return q;
  }

 private:
  Configuration lower_, upper_;
};

/// RRT-Connect.
class TreeSearch {
 public:
  TreeSearch(const CollisionModel& model, std::uint64_t random_seed, FreeEdges& edges,
             JointSpace space)
      : edges_(edges),
        space_(std::move(space)),
        engine_(random_seed),
        trees_{JointTree(model.arm().dof()), JointTree(model.arm().dof())} {}

  void add_start(const Configuration& q) { trees_[0].add(q); }
  void add_goal(const Configuration& q) { goals_ = trees_[1].add(q) + 1; }

  /// The indices of the nodes from the place where the trees meet, in one configuration, to their
  /// roots.
  struct TreePath {
    std::vector<std::size_t> to_start, to_goal;

    bool found() const { return !to_start.empty(); }
    /// Of the goals, in the order in which they were added.
    std::size_t goal() const { return to_goal.back(); }
  };

  /// Grows the trees until they meet; returns no path if they do not. None of its edges is proved.
  TreePath connect() {
    for (; !edges_.ended(); grows_ = 1 - grows_) {
      if (edges_.count() >= restart_at_) restart();
      const std::size_t a = grows_, b = 1 - a;
      const std::size_t grown = advance(trees_[a], space_.random(engine_)).first;
      if (grown == none) continue;
      const Configuration q = trees_[a].node(grown);
      const auto [met, reached] = advance(trees_[b], q);
      if (!reached) continue;
      return {trees_[0].path_to_root(a == 0 ? grown : met),
              trees_[1].path_to_root(a == 0 ? met : grown)};
    }
    return {};
  }

  std::vector<Configuration> waypoints(const TreePath& path) const {
    std::vector<Configuration> waypoints;
    for (std::size_t k = path.to_start.size(); k > 0; --k) {
      waypoints.push_back(trees_[0].node(path.to_start[k - 1]));
    }
    for (std::size_t k = 1; k < path.to_goal.size(); ++k) {
      waypoints.push_back(trees_[1].node(path.to_goal[k]));
    }
    return waypoints;
  }

  /// Removes from each tree the first edge of a path that is not proved, with all nodes behind it.
  /// Returns whether there is one.
  bool cut(const TreePath& path) {
    const auto cut_tree = [&](JointTree& tree, const std::vector<std::size_t>& nodes) {
      for (std::size_t k = nodes.size() - 1; k > 0; --k) {
        if (edges_.are_free({tree.node(nodes[k]), tree.node(nodes[k - 1])})) continue;
        tree.remove(nodes[k - 1]);
        return true;
      }
      return false;
    };
    const bool is_cut = cut_tree(trees_[0], path.to_start);
    return cut_tree(trees_[1], path.to_goal) || is_cut;
  }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  void restart() {
    trees_[0].keep_roots(1);
    trees_[1].keep_roots(goals_);
    restart_at_ += 2 * (restart_at_ - edges_before_);
    edges_before_ = edges_.count();
  }

  /// Grows a tree from its nearest node towards q as far as no sample is blocked. Returns the last
  /// node, none if it is stuck, and whether it is q.
  std::pair<std::size_t, bool> advance(JointTree& tree, const Configuration& q) {
    std::size_t last = tree.nearest(q);
    const Configuration from = tree.node(last);
    const Configuration change = q - from;
    const double length = change.norm();
    if (length == 0) return {last, true};
    const double free = edges_.sampled_fraction(from, q);
    const bool reached = free == 1;
    const double end = reached ? 1 : usable * free;
    if (!reached && end * length < least_advance) {
      tree.add_dead_end(last);
      return {none, false};
    }
    const auto parts =
        static_cast<int>(std::ceil(std::min(end * length / node_spacing, most_nodes)));
    for (int i = 1; i <= parts; ++i) {
      last = tree.add(reached && i == parts ? q : from + end * i / parts * change, last);
    }
    return {last, reached};
  }

  FreeEdges& edges_;
  JointSpace space_;
  std::mt19937_64 engine_;
  JointTree trees_[2];
  std::size_t goals_ = 0;
  std::size_t grows_ = 0;  ///< which tree
  std::size_t edges_before_ = 0, restart_at_ = edges_until_restart;
};

/// Why a configuration cannot be an end of a path; no reason if it can.
Reason refusal(const CollisionModel& model, const Configuration& q) {
  const std::vector<Reason> outside = limit_violations(model.arm(), q);
  if (!outside.empty()) return outside.front();
  // The proof that the arm may rest there takes less time than the deepest of all pairs.
  if (FreeEdges(model, 1, unlimited()).is_free(q, q)) return {};
  return blocked_by(model, q);
}

MotionStatus status_of_refusal(const Reason& reason) {
  if (reason.code == ReasonCode::joint_outside_limits) return MotionStatus::outside_limits;
  return status_of_blocked(reason);
}

/// The goals that are free, the nearest to the start first; or, if there are none, why the first is
/// not.
struct FreeGoals {
  std::vector<std::size_t> indices;
  Reason refusal;
};

FreeGoals free_goals_of(const CollisionModel& model, const Configuration& start,
                        std::span<const Configuration> goals, BudgetMeter& budget) {
  FreeGoals found;
  for (std::size_t i = 0; i < goals.size() && !budget.ended(0); ++i) {
    Reason reason = refusal(model, goals[i]);
    if (!reason) {
      found.indices.push_back(i);
    } else if (!found.refusal) {
      found.refusal = std::move(reason);
    }
  }
  std::stable_sort(found.indices.begin(), found.indices.end(), [&](std::size_t a, std::size_t b) {
    return (goals[a] - start).norm() < (goals[b] - start).norm();
  });
  return found;
}

FreePath refused(const Reason& why, ReasonCode which, std::size_t goals) {
  FreePath path;
  path.status = status_of_refusal(why);
  path.reason = {which, {}, {why}};
  if (which == ReasonCode::goal_not_free) path.reason.set(ReasonField::count, goals);
  return path;
}

/// Searches for the shortest path that straight joint motions and trees find to one of some goals.
class PathSearch {
 public:
  PathSearch(const CollisionModel& model, const Configuration& start,
             std::span<const Configuration> goals, const FreePathOptions& options,
             BudgetMeter& budget)
      : model_(model), start_(start), goals_(goals), options_(options), budget_(budget) {}

  /// Searches a path to one of these goals, which are in the order of their distance; the path is
  /// without waypoints if there is none.
  FreePath run(const std::vector<std::size_t>& free_goals) {
    try_straight(free_goals);
    if (free_goals.empty() || (found() && path_.goal == free_goals.front())) return path_;
    search(free_goals);
    const double detour = long_detour * distance(free_goals.front());
    std::mt19937_64 seeds(options_.random_seed);
    for (int i = 0; i < further_searches && found() && length() > detour; ++i) {
      grow_trees(closer_than(length(), free_goals), near_goal_edges, seeds());
    }
    return path_;
  }

 private:
  bool found() const { return !path_.waypoints.empty(); }
  double length() const { return found() ? path_.length : std::numeric_limits<double>::infinity(); }
  double distance(std::size_t goal) const { return (goals_[goal] - start_).norm(); }

  std::vector<std::size_t> closer_than(double limit, std::vector<std::size_t> goals) const {
    std::erase_if(goals, [&](std::size_t i) { return distance(i) >= limit; });
    return goals;
  }

  /// Grows trees to the near goals first.
  void search(const std::vector<std::size_t>& free_goals) {
    const std::vector<std::size_t> closer = closer_than(length(), free_goals);
    const auto near = closer_than(near_goals * distance(free_goals.front()), closer);
    const std::uint64_t seed = options_.random_seed;
    if (near.size() < closer.size() && grow_trees(near, near_goal_edges, seed)) return;
    grow_trees(closer, found() ? near_goal_edges : options_.max_edges, seed);
  }

  FreeEdges edges(int most) const {
    const int left = options_.max_edges - static_cast<int>(path_.edges - shortcuts_);
    return FreeEdges(model_, std::clamp(left, 0, most), budget_);
  }

  /// The straight joint motion to the nearest goal with one that is free.
  void try_straight(const std::vector<std::size_t>& goals) {
    FreeEdges straight = edges(options_.max_edges);
    for (const std::size_t i : goals) {
      if (!straight.seems_free(start_, goals_[i])) continue;
      const bool nearest = i == goals.front();
      if (!straight.is_free(start_, goals_[i]) &&
          !(nearest && straight.is_free_closely(start_, goals_[i], close_proof_work))) {
        continue;
      }
      path_.waypoints = {start_, goals_[i]};
      path_.length = distance(i);
      path_.goal = i;
      break;
    }
    path_.edges += straight.count();
  }

  /// Replaces the path if two trees find a shorter one. Returns whether they do.
  bool grow_trees(const std::vector<std::size_t>& goals, int most_edges,
                  std::uint64_t random_seed) {
    if (goals.empty()) return false;
    FreeEdges examined = edges(most_edges);
    TreeSearch trees(model_, random_seed, examined, JointSpace(model_.arm(), start_, goals_));
    trees.add_start(start_);
    for (const std::size_t i : goals) trees.add_goal(goals_[i]);
    const auto [waypoints, goal] = proved_path(trees, examined);
    path_.edges += examined.count();
    if (waypoints.empty()) return false;
    const double found_length = chord_length(waypoints).back();
    if (found_length >= length()) return false;
    path_.waypoints = waypoints;
    path_.length = found_length;
    path_.goal = goals[goal];
    return true;
  }

  /// Returns a shortened path of the trees, of which each edge is proved, and the index of the root
  /// where it ends; no path if there is none.
  std::pair<std::vector<Configuration>, std::size_t> proved_path(TreeSearch& trees,
                                                                 FreeEdges& edges) {
    while (true) {
      const TreeSearch::TreePath path = trees.connect();
      if (!path.found()) return {};
      // Most edges without a blocked sample are free: those that remain are proved, at the end.
      std::vector<Configuration> waypoints = shortened(trees.waypoints(path), EdgeTest::samples);
      if (edges.are_free(waypoints)) return {waypoints, path.goal()};
      edges.sample_more_densely();
      if (trees.cut(path)) continue;
      waypoints = shortened(trees.waypoints(path), EdgeTest::proof);
      if (!edges.are_free(waypoints)) waypoints = trees.waypoints(path);  // proved by cut()
      return {waypoints, path.goal()};
    }
  }

  /// Shortens a path by edges that the search does not count.
  std::vector<Configuration> shortened(std::vector<Configuration> waypoints, EdgeTest test) {
    FreeEdges shortcuts(model_, std::numeric_limits<int>::max(), budget_);
    shorten(shortcuts, test, options_.random_seed, options_.shortcuts, waypoints);
    shortcuts_ += shortcuts.count();
    path_.edges += shortcuts.count();
    return waypoints;
  }

  const CollisionModel& model_;
  const Configuration& start_;
  std::span<const Configuration> goals_;
  const FreePathOptions& options_;
  BudgetMeter& budget_;
  FreePath path_;
  std::size_t shortcuts_ = 0;  ///< of path_.edges, which max_edges does not bound
};

}  // namespace

std::ostream& operator<<(std::ostream& out, const FreePath& path) {
  out << path.status;
  if (!path) return out << ": " << path.reason;
  return out << ", " << path.waypoints.size() << " waypoints, length " << number(path.length);
}

FreePath find_free_path(const CollisionModel& model, const Configuration& start,
                        std::span<const Configuration> goals, const FreePathOptions& options) {
  if (goals.empty()) throw Error("a path needs a goal; none is given");
  if (options.max_edges < 1) {
    throw Error("", "max_edges",
                " is " + std::to_string(options.max_edges) + "; it must be 1 or more");
  }
  constexpr int most_shortcuts = 1'000'000;
  if (options.shortcuts < 0 || options.shortcuts > most_shortcuts) {
    throw Error("", "shortcuts",
                " is " + std::to_string(options.shortcuts) + "; it must be from 0 to " +
                    std::to_string(most_shortcuts));
  }
  if (const Reason reason = refusal(model, start)) {
    return refused(reason, ReasonCode::start_not_free, 0);
  }
  BudgetMeter budget(options.budget);
  const FreeGoals free_goals = free_goals_of(model, start, goals, budget);
  if (free_goals.indices.empty() && budget.complete()) {
    return refused(free_goals.refusal, ReasonCode::goal_not_free, goals.size());
  }
  FreePath path = PathSearch(model, start, goals, options, budget).run(free_goals.indices);
  if (!path.waypoints.empty()) {
    path.status = MotionStatus::reached;
    return path;
  }
  if (!budget.complete()) {
    set_ended(ReasonCode::ended_before_free_path, budget.ending(), path);
    path.reason.set(ReasonField::count, path.edges);
  } else {
    path.reason = {ReasonCode::no_free_path, {{ReasonField::count, path.edges}}};
  }
  return path;
}

}  // namespace beeline
