#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <beeline/certificate/verify.h>
#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/jacobian.h>
#include <beeline/planning/internal/knot_sequence.h>
#include <beeline/planning/internal/track_segment.h>
#include <beeline/pose/se3.h>

#include <tests/random.h>

/// Whether an arm can follow a line at all, found by brute force and by other means than the
/// planner's: the tiniest steps of Newton's method, no proof, no damping; limits looked at
/// afterwards.
namespace beeline::testing {

/// The best of an arm's branches on a line.
struct DenseAnswer {
  double reached = 0;  ///< fraction of the line reached
  int joint = -1;      ///< whose limit ends it; -1: none, it ends inside the limits
  bool lower = false;
  std::vector<Configuration> way = {};  ///< of seven joints: one configuration for each layer
  double margin = 0;                    ///< smallest distance to the limits, radians, if feasible
  bool feasible() const { return reached == 1; }
};

/// The next configuration of a motion: from q, with the tool near `to`. None when Newton's method
/// does not find it close by.
inline std::optional<Configuration> newton_step(const Arm& arm, const Configuration& q,
                                                const Pose& to) {
  constexpr double farthest = 0.03;  // radians
  Configuration next = q;
  for (int i = 0; i < 12; ++i) {
    const Twist error = pose_error(to, forward_kinematics(arm, next), Frame::base);
    if (error.norm() < 1e-10) return next;
    const Jacobian j = jacobian(arm, next);
    Eigen::Matrix<double, 6, 6> gram = j * j.transpose();
    gram.diagonal().array() += 1e-16;
    next += j.transpose() * gram.ldlt().solve(error);
    if (!next.allFinite() || (next - q).lpNorm<Eigen::Infinity>() > farthest) return {};
  }
  return {};
}

/// Where a branch of an arm of six turning joints leaves its limits, over all turns.
class TurnKeeper {
 public:
  TurnKeeper(const Limits& limits, double start) : limits_(limits) {
    constexpr double turn = 2 * std::numbers::pi;
    for (int n = -4; n <= 4; ++n) {
      const double q = start + n * turn;
      if (q < limits.lower - slack || q > limits.upper + slack) continue;
      turns_.push_back({n * turn, -1, false});
    }
  }
  void pass(double s, double q) {
    for (Turn& turn : turns_) {
      if (turn.left >= 0) continue;
      const double here = q + turn.shift;
      turn.margin = std::min({turn.margin, here - limits_.lower, limits_.upper - here});
      if (here >= limits_.lower - slack && here <= limits_.upper + slack) continue;
      turn.left = s;
      turn.lower = here < limits_.lower;
    }
  }
  /// The place where the last of the turns leaves the limits, 2 for never; and its margin.
  struct End {
    double place = -1;
    bool lower = false;
    double margin = 0;
  };
  End end() const {
    End end;
    for (const Turn& turn : turns_) {
      const double place = turn.left < 0 ? 2 : turn.left;
      if (place > end.place || (place == end.place && turn.margin > end.margin)) {
        end = {place, turn.lower, turn.margin};
      }
    }
    return end;
  }

 private:
  static constexpr double slack = 1e-9;
  struct Turn {
    double shift, left;
    bool lower;
    double margin = 100;
  };
  Limits limits_;
  std::vector<Turn> turns_;
};

/// One branch of a non-redundant arm, from q.
inline DenseAnswer dense_branch(const Arm& arm, const Pose& from, const Pose& to, Configuration q,
                                double step) {
  std::vector<TurnKeeper> keepers;
  for (int k = 0; k < arm.dof(); ++k) {
    keepers.emplace_back(arm.limits(k), q[k]);
  }
  double s = 0, length = step;
  Configuration before = q;
  double before_length = 0;
  while (s < 1 && length > 1e-9) {
    const double next_s = std::min(1.0, s + length);
    const Configuration ahead =
        before_length > 0 ? Configuration(q + (q - before) * ((next_s - s) / before_length)) : q;
    const Pose target = interpolate(from, to, next_s);
    std::optional<Configuration> next;
    if ((ahead - q).lpNorm<Eigen::Infinity>() < 0.03) next = newton_step(arm, ahead, target);
    if (next && ((*next - q).lpNorm<Eigen::Infinity>() > 0.04 ||
                 (before_length > 0 && (*next - ahead).lpNorm<Eigen::Infinity>() > 0.01))) {
      next.reset();
    }
    if (!next && before_length > 0 && length < 1e-7) {  // the step before may point elsewhere
      next = newton_step(arm, q, target);
    }
    if (!next) {
      length /= 2;
      continue;
    }
    before = q, before_length = next_s - s;
    q = *next, s = next_s;
    for (int k = 0; k < arm.dof(); ++k) keepers[k].pass(s, q[k]);
    length = std::min(step, 1.5 * length);
  }
  DenseAnswer answer{s};
  answer.margin = 100;
  for (int k = 0; k < arm.dof(); ++k) {
    const TurnKeeper::End end = keepers[k].end();
    answer.margin = std::min(answer.margin, end.margin);
    if (end.place <= answer.reached && end.place <= 1) {
      answer.reached = std::min(std::max(end.place, 0.0), 1 - 1e-12);
      answer.joint = k, answer.lower = end.lower;
    }
  }
  return answer;
}

/// Of all branches of a non-redundant arm, the one that reaches farthest.
inline DenseAnswer dense_branches(const Arm& arm, const Pose& from, const Pose& to,
                                  double step = 1e-3) {
  DenseAnswer best;
  const InverseResult starts = inverse_kinematics(arm, from, {.all = true, .ignore_limits = true});
  for (const Configuration& q : starts.solutions) {
    const DenseAnswer answer = dense_branch(arm, from, to, q, step);
    const bool farther = answer.reached > best.reached;
    if (farther || (answer.reached == best.reached && answer.margin > best.margin)) best = answer;
    if (best.feasible() && best.margin > 1e-3) break;
  }
  return best;
}

/// Seven joints: all solutions within limits on a grid of the redundant joint, for each of many
/// places; those that can be reached from the ones before by small turns.
inline DenseAnswer dense_layers(const Arm& arm, const Pose& from, const Pose& to, int layers = 160,
                                int grid = 96, double max_turn = 0.2) {
  const InverseOptions options{.all = true, .grid = grid, .tolerance = 1e-9, .max_restarts = 0};
  Eigen::MatrixXd columns(arm.dof(), 16 * grid);
  const Configuration middle = Configuration::Zero(arm.dof());
  std::vector<std::vector<Configuration>> all(static_cast<std::size_t>(layers) + 1);
  const auto solve = [&](int r) {
    auto& layer = all[r];
    const Pose pose = interpolate(from, to, static_cast<double>(r) / layers);
    const int count = inverse_kinematics(arm, pose, middle, columns, options);
    for (int j = 0; j < count; ++j) layer.emplace_back(columns.col(j));
    return count > 0;
  };
  DenseAnswer answer;
  std::vector<std::vector<int>> before(all.size());
  for (int r = 0; r <= layers; ++r) {
    if (!solve(r)) return answer;
    std::vector<Configuration> reached;
    const auto now = static_cast<std::size_t>(r);
    for (const Configuration& q : all[now]) {
      int from_which = r == 0 ? 0 : -1;
      double least = max_turn;
      for (std::size_t i = 0; r > 0 && i < all[now - 1].size(); ++i) {
        const double turn = (q - all[now - 1][i]).lpNorm<Eigen::Infinity>();
        if (turn < least) least = turn, from_which = static_cast<int>(i);
      }
      if (from_which < 0) continue;
      reached.push_back(q);
      before[now].push_back(from_which);
    }
    all[now] = reached;
    if (reached.empty()) return answer;
    answer.reached = static_cast<double>(r) / layers;
  }
  int which = 0;
  for (std::size_t r = all.size(); r-- > 0;) {
    answer.way.push_back(all[r][which]);
    which = before[r][which];
  }
  std::reverse(answer.way.begin(), answer.way.end());
  return answer;
}

/// A line of 0.1 to 0.8 m with a turn of up to 90 degrees from a pose within the limits.
inline Line random_certified_line(Random& random, const Arm& arm) {
  const Pose from = forward_kinematics(arm, random.configuration(arm));
  Pose to = from;
  to.translation() += random.direction() * random.uniform(0.1, 0.8);
  to.linear() =
      so3_exp(random.direction() * random.uniform(0, std::numbers::pi / 2)) * from.linear();
  return {from, to};
}

/// Whether the configurations of dense_layers(), at equal distances on the line, can be followed by
/// a motion that is proved to keep to the line.
inline bool can_follow(const Arm& arm, const Line& line, const std::vector<Configuration>& way) {
  std::vector<internal::Knot> knots;
  for (std::size_t r = 0; r < way.size(); ++r) {
    knots.push_back({static_cast<double>(r) / static_cast<double>(way.size() - 1), way[r]});
  }
  const internal::KnotSpline spline(knots, lines_through(std::vector{line.from, line.to}));
  return internal::track_segment(arm, line, Task::spatial(), internal::bounds_of(arm), way.front(),
                                 {.tolerance = {1e-4, 1e-4},
                                  .max_samples = 100'000,
                                  .guide = [&](double s) { return spline.at(s); }})
      .complete();
}

}  // namespace beeline::testing
