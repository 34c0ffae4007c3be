#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <beeline/control/internal/pair_bounds.h>
#include <beeline/model/internal/chain.h>

namespace beeline::internal {
namespace {

constexpr double unknown_excess = -std::numeric_limits<double>::infinity();
constexpr double outwards = 1 + 1e-12;

/// Coordinates by which the range of a reach exceeds the motion, rad or m. A sliding arm computes
/// its reaches again when it leaves the range.
constexpr double reach_margin = 0.2;

/// Travelled distance, m, at which the levels of a group are lowered.
constexpr double farthest_travelled = 1;

}  // namespace

BodyMotions::BodyMotions(const CollisionBodies& bodies)
    : bodies_(&bodies), lower_(Eigen::VectorXd::Zero(bodies.arm.dof())), upper_(lower_) {
  for (const auto& link : bodies.link_bodies) {
    reaches_.push_back(link.reach);
    displacements_.emplace_back(link.carried.frame + 1);
    if (!link.reach.of.empty()) continue;
    slides_ = true;
    reaches_.back().of.resize(link.carried.frame + 1);
  }
  reset();
}

void BodyMotions::reset() {
  if (!slides_) return;
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(lower_.size());
  cover(zero, zero);
}

/// Computes the reaches for a motion from q.
void BodyMotions::cover(const ConfigurationRef& q, const Eigen::VectorXd& motion) {
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    lower_[k] = q[k] - std::abs(motion[k]) - reach_margin;
    upper_[k] = q[k] + std::abs(motion[k]) + reach_margin;
  }
  for (std::size_t i = 0; i < reaches_.size(); ++i) {
    const auto& link = bodies_->link_bodies[i];
    if (!link.reach.of.empty()) continue;
    std::fill(reaches_[i].of.begin(), reaches_[i].of.end(), 0.0);
    bodies_->motion.include_reach(link.carried.body, link.carried.frame, lower_, upper_,
                                  reaches_[i]);
  }
}

void BodyMotions::set(const ConfigurationRef& q, const Eigen::VectorXd& motion) {
  if (slides_) {
    bool inside = true;
    for (Eigen::Index k = 0; k < q.size(); ++k) {
      inside = inside && q[k] - std::abs(motion[k]) >= lower_[k] &&
               q[k] + std::abs(motion[k]) <= upper_[k];
    }
    if (!inside) cover(q, motion);
  }
  const Chain& chain = chain_of(bodies_->arm);
  for (std::size_t body = 0; body < reaches_.size(); ++body) {
    const std::vector<double>& reach = reaches_[body].of;
    double sum = 0;  // of the links from the body's frame towards the base
    for (std::size_t l = reach.size() - 1; l > 0; --l) {
      const Chain::Link& link = chain.links[l - 1];
      const double step = std::abs(motion[link.coordinate]);
      sum += step * (std::abs(link.theta_per_q) * reach[l] + std::abs(link.d_per_q));
      displacements_[body][l - 1] = outwards * sum;
    }
  }
}

PairBounds::PairBounds(const CollisionBodies& bodies) : motions_(bodies) {
  const auto count = static_cast<std::uint32_t>(bodies.link_bodies.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto& link = bodies.link_bodies[i];
    for (std::uint32_t k = 0; k < bodies.obstacle_bodies.size(); ++k) {
      const auto& obstacle = bodies.obstacle_bodies[k];
      if (!CollisionBodies::meets_obstacles(link) || bodies.allowed(link, obstacle.obstacle)) {
        continue;
      }
      add({i, k, true, 0, obstacle.clearance}, 0, false);
    }
  }
  const auto add_links = [&](const auto& pairs, bool is_apart) {
    std::vector<BodyPair> sorted;
    for (const auto& pair : pairs) {
      sorted.push_back({pair.first, pair.second, false, 0, bodies.options.clearance});
    }
    const auto from = [&](const BodyPair& pair) {
      return bodies.link_bodies[pair.second].carried.frame;
    };
    std::stable_sort(sorted.begin(), sorted.end(), [&](const BodyPair& a, const BodyPair& b) {
      return std::pair(a.first, from(a)) < std::pair(b.first, from(b));
    });
    for (const BodyPair& pair : sorted) add(pair, from(pair), is_apart);
  };
  add_links(bodies.self_pairs, false);
  add_links(bodies.apart_pairs, true);
  levels_.resize(pairs_.size());
  states_.resize(groups_.size());
  at_ = moved_ = Eigen::VectorXd::Zero(bodies.arm.dof());
  reset();
}

/// Adds a pair to the last group, or begins one.
void PairBounds::add(const BodyPair& pair, std::size_t from, bool is_apart) {
  const bool continues = !groups_.empty() && groups_.back().first == pair.first &&
                         groups_.back().from == from && groups_.back().is_apart == is_apart &&
                         pairs_.back().is_obstacle == pair.is_obstacle;
  if (!continues) groups_.push_back({pair.first, from, is_apart, pairs_.size(), pairs_.size()});
  pairs_.push_back(pair);
  pairs_.back().group = static_cast<std::uint32_t>(groups_.size() - 1);
  groups_.back().end = pairs_.size();
}

void PairBounds::reset() {
  std::fill(levels_.begin(), levels_.end(), unknown_excess);
  std::fill(states_.begin(), states_.end(), GroupState{});
  has_moved_ = false;
  motions_.reset();
}

void PairBounds::move_to(const ConfigurationRef& q) {
  if (!has_moved_) at_ = q;
  has_moved_ = true;
  moved_ = q - at_;
  motions_.set(at_, moved_);
  at_ = q;
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    double& travelled = states_[i].travelled;
    travelled += motions_.of(groups_[i].first, groups_[i].from);
    travelled += rounding * travelled;  // the rounding of the sum
    if (travelled > farthest_travelled) lower_levels(i);
  }
}

/// Begins to count from zero what the bodies of a group travel, before the sum loses digits.
void PairBounds::lower_levels(std::size_t group) {
  for (std::size_t k = groups_[group].begin; k < groups_[group].end; ++k) levels_[k] = excess(k);
  states_[group] = GroupState{};
}

void PairBounds::set_excess(std::size_t i, double excess) {
  GroupState& state = states_[pairs_[i].group];
  const double before = levels_[i];
  levels_[i] = excess + state.travelled - rounding * (std::abs(excess) + state.travelled);
  state.is_stale = state.is_stale || before == state.least || levels_[i] < state.least;
}

void PairBounds::find_least(std::size_t group) {
  const auto begin = levels_.begin();
  states_[group].least =
      *std::min_element(begin + static_cast<std::ptrdiff_t>(groups_[group].begin),
                        begin + static_cast<std::ptrdiff_t>(groups_[group].end));
  states_[group].is_stale = false;
}

}  // namespace beeline::internal
