#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include <beeline/collision/internal/pairs_apart.h>
#include <beeline/model/internal/chain.h>

namespace beeline::internal {
namespace {

/// A box of configurations.
struct Box {
  Eigen::VectorXd middle, half_width;
};

/// The values of the coordinates that are searched.
struct Ranges {
  Eigen::VectorXd lower, upper;
  std::vector<bool> is_unbounded;  ///< no range: bodies that the coordinate moves are not searched
};

/// The limits, widened, or one revolution. Sets the range of coordinates in `bodies`.
Ranges searched_ranges(CollisionBodies& bodies) {
  const Eigen::Index n = bodies.arm.dof();
  constexpr double margin = 2 * CollisionBodies::apart_margin;
  Ranges ranges{Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n), std::vector<bool>(n)};
  bodies.apart_lower = Configuration::Constant(n, -Limits::none);
  bodies.apart_upper = Configuration::Constant(n, Limits::none);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Limits& limits = bodies.arm.limits(k);
    const bool bounded = std::isfinite(limits.lower) && std::isfinite(limits.upper);
    const bool revolution = !bounded || limits.upper - limits.lower >= 2 * std::numbers::pi;
    if (revolution && bodies.arm.periodic(k)) {
      ranges.upper[k] = std::numbers::pi + margin;
      ranges.lower[k] = -ranges.upper[k];
    } else if (bounded) {
      ranges.lower[k] = limits.lower - margin;
      ranges.upper[k] = limits.upper + margin;
      bodies.apart_lower[k] = limits.lower - CollisionBodies::apart_margin;
      bodies.apart_upper[k] = limits.upper + CollisionBodies::apart_margin;
    } else {
      ranges.is_unbounded[k] = true;
    }
  }
  return ranges;
}

/// The search for one pair.
class PairSearch {
 public:
  PairSearch(const CollisionBodies& bodies, const CollisionBodies::SelfPair& pair,
             const Ranges& ranges)
      : clearance_(bodies.options.clearance),
        ranges_(ranges),
        motion_(bodies.motion),
        first_(bodies.link_bodies[pair.first].carried),
        second_(bodies.link_bodies[pair.second].carried),
        reach_(motion_.reach(first_.body, first_.frame, ranges.lower, ranges.upper)),
        rate_(Eigen::VectorXd::Zero(ranges.lower.size())) {
    const Chain& chain = chain_of(bodies.arm);
    for (std::size_t l = second_.frame + 1; l <= first_.frame; ++l) {
      const Chain::Link& link = chain.links[l - 1];
      rate_[link.coordinate] += std::abs(link.theta_per_q) * reach_.of[l] + std::abs(link.d_per_q);
    }
  }

  /// Whether the bodies are proved to keep their clearance.
  bool proves(BudgetMeter& budget) {
    constexpr std::size_t most_boxes = 2000;
    Box whole{(ranges_.lower + ranges_.upper) / 2, Eigen::VectorXd::Zero(rate_.size())};
    for (Eigen::Index k = 0; k < rate_.size(); ++k) {
      if (rate_[k] == 0) continue;
      if (ranges_.is_unbounded[k]) return false;
      whole.half_width[k] = (ranges_.upper[k] - ranges_.lower[k]) / 2;
    }
    std::vector<Box> boxes{whole};
    for (std::size_t i = 0; !boxes.empty(); ++i) {
      if (i == most_boxes || budget.ended()) return false;
      Box box = std::move(boxes.back());
      boxes.pop_back();
      Eigen::Index widest = 0;
      rate_.cwiseProduct(box.half_width).maxCoeff(&widest);
      const Finding finding = test(box, widest);
      if (finding == Finding::meet) return false;
      if (finding == Finding::apart) continue;
      box.half_width[widest] /= 2;
      box.middle[widest] -= box.half_width[widest];
      boxes.push_back(box);
      box.middle[widest] += 2 * box.half_width[widest];
      boxes.push_back(std::move(box));
    }
    return true;
  }

 private:
  enum class Finding { apart, meet, unknown };

  /// The tube is along the widest coordinate, where its bound is of second order.
  Finding test(const Box& box, Eigen::Index widest) {
    Eigen::VectorXd slack = box.half_width, half_motion = Eigen::VectorXd::Zero(slack.size());
    std::swap(half_motion[widest], slack[widest]);
    motion_.set({box.middle, half_motion, slack});
    const ConvexBody first = in_world(motion_, first_), second = in_world(motion_, second_);
    const double rounding = motion_.rounding(first_.frame, magnitude(first_.body)) +
                            motion_.rounding(second_.frame, magnitude(second_.body));
    const Vector3 between = second.centre - first.centre;
    const double apart = between.norm() - first.bound - second.bound -
                         motion_.displacement(reach_, first_.frame, second_.frame) - rounding;
    if (apart >= clearance_) return Finding::apart;
    const Separation parts = separation(first, second, between);
    if (parts.upper + rounding < clearance_) return Finding::meet;
    const Vector3& n = parts.points.direction;
    const double remainder = motion_.remainder(reach_, first_.frame, second_.frame);
    const double gap = lowest_along(motion_, second_, n) -
                       highest_along(motion_, first_, second_.frame, n, remainder) - rounding;
    return gap >= clearance_ ? Finding::apart : Finding::unknown;
  }

  const double clearance_;
  const Ranges& ranges_;
  ChainMotion motion_;
  const CarriedBody &first_, &second_;
  JointReach reach_;
  Eigen::VectorXd rate_;  ///< bound of the bodies' relative motion for each unit of a coordinate, m
};

/// The pairs of a model with fewer links.
class KnownPairs {
 public:
  explicit KnownPairs(const CollisionBodies* known) {
    if (known == nullptr) return;
    links_ = known->link_bodies.size();
    for (const CollisionBodies::SelfPair& pair : known->apart_pairs) {
      apart_.insert({pair.first, pair.second});
    }
  }

  bool has(const CollisionBodies::SelfPair& pair) const {
    return pair.first < links_ && pair.second < links_;
  }

  bool is_apart(const CollisionBodies::SelfPair& pair) const {
    return apart_.contains({pair.first, pair.second});
  }

 private:
  std::size_t links_ = 0;
  std::set<std::array<std::uint32_t, 2>> apart_;
};

}  // namespace

void find_pairs_apart(CollisionBodies& bodies, BudgetMeter& budget, const CollisionBodies* known) {
  const KnownPairs known_pairs(known);
  const Ranges ranges = searched_ranges(bodies);
  // Pairs with few joints between them need the fewest boxes.
  std::vector<CollisionBodies::SelfPair> pairs = std::move(bodies.self_pairs);
  const auto joints_between = [&](const CollisionBodies::SelfPair& pair) {
    return bodies.link_bodies[pair.first].carried.frame -
           bodies.link_bodies[pair.second].carried.frame;
  };
  std::stable_sort(pairs.begin(), pairs.end(), [&](const auto& a, const auto& b) {
    return joints_between(a) < joints_between(b);
  });
  bodies.self_pairs.clear();
  for (const CollisionBodies::SelfPair& pair : pairs) {
    const bool apart = known_pairs.has(pair)
                           ? known_pairs.is_apart(pair)
                           : budget.complete() && PairSearch(bodies, pair, ranges).proves(budget);
    (apart ? bodies.apart_pairs : bodies.self_pairs).push_back(pair);
  }
}

}  // namespace beeline::internal
