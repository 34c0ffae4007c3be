#include <algorithm>
#include <cmath>
#include <limits>

#include <beeline/control/internal/pair_bounds.h>
#include <beeline/model/internal/chain.h>

namespace beeline::internal {
namespace {

constexpr double unknown_excess = -std::numeric_limits<double>::infinity();
constexpr double outwards = 1 + 1e-12;
constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Coordinates by which the range of a reach exceeds the motion, rad or m. A sliding arm computes
/// its reaches again when it leaves the range.
constexpr double reach_margin = 0.2;

}  // namespace

BodyMotions::BodyMotions(const CollisionBodies& bodies)
    : bodies_(&bodies),
      lower_(Eigen::VectorXd::Zero(bodies.arm.dof())),
      upper_(lower_),
      steps_angle_(bodies.motion.size()),
      steps_slide_(bodies.motion.size()) {
  for (const auto& link : bodies.link_bodies) {
    reaches_.push_back(link.reach);
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
  for (std::size_t l = 1; l < steps_angle_.size(); ++l) {
    const Chain::Link& link = chain.links[l - 1];
    const double step = std::abs(motion[link.coordinate]);
    steps_angle_[l] = std::abs(link.theta_per_q) * step;
    steps_slide_[l] = std::abs(link.d_per_q) * step;
  }
}

double BodyMotions::of(std::uint32_t body, std::size_t from) const {
  const std::vector<double>& reach = reaches_[body].of;
  double sum = 0;
  for (std::size_t l = from + 1; l < reach.size(); ++l) {
    sum += steps_angle_[l] * reach[l] + steps_slide_[l];
  }
  return outwards * sum;
}

PairBounds::PairBounds(const CollisionBodies& bodies) : bodies_(&bodies), motions_(bodies) {
  const auto count = static_cast<std::uint32_t>(bodies.link_bodies.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto& link = bodies.link_bodies[i];
    Range range{pairs_.size(), pairs_.size()};
    for (std::uint32_t k = 0; k < bodies.obstacle_bodies.size(); ++k) {
      const auto& obstacle = bodies.obstacle_bodies[k];
      if (!CollisionBodies::meets_obstacles(link) || bodies.allowed(link, obstacle.obstacle)) {
        continue;
      }
      pairs_.push_back({i, k, true, false, obstacle.clearance});
    }
    range.end = pairs_.size();
    of_body_.push_back(range);
  }
  first_self_pair_ = pairs_.size();
  for (const auto& pair : bodies.self_pairs) {
    pairs_.push_back({pair.first, pair.second, false, false, bodies.options.clearance});
  }
  for (const auto& pair : bodies.apart_pairs) {
    pairs_.push_back({pair.first, pair.second, false, true, bodies.options.clearance});
  }
  excess_.resize(pairs_.size());
  at_ = moved_ = Eigen::VectorXd::Zero(bodies.arm.dof());
  reset();
}

void PairBounds::reset() {
  std::fill(excess_.begin(), excess_.end(), unknown_excess);
  has_moved_ = false;
  motions_.reset();
}

/// Lowers a bound by a displacement, with the rounding of the difference.
void PairBounds::lower(std::size_t i, double displacement) {
  excess_[i] -= displacement + epsilon * std::abs(excess_[i]);
}

void PairBounds::move_to(const ConfigurationRef& q) {
  if (!has_moved_) at_ = q;
  has_moved_ = true;
  moved_ = q - at_;
  motions_.set(at_, moved_);
  at_ = q;
  for (std::uint32_t i = 0; i < of_body_.size(); ++i) {
    const Range& range = of_body_[i];
    if (range.begin == range.end) continue;
    const double distance = motions_.of(i, 0);
    for (std::size_t k = range.begin; k < range.end; ++k) lower(k, distance);
  }
  for (std::size_t k = first_self_pair_; k < pairs_.size(); ++k) {
    const BodyPair& pair = pairs_[k];
    lower(k, motions_.of(pair.first, bodies_->link_bodies[pair.second].carried.frame));
  }
}

double PairBounds::least_excess(const Range& range) const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = range.begin; k < range.end; ++k) least = std::min(least, excess_[k]);
  return least;
}

}  // namespace beeline::internal
