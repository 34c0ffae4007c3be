#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <span>

#include <beeline/collision/internal/collision_bodies.h>
#include <beeline/collision/internal/nearest_pair.h>
#include <beeline/collision/internal/pair_reason.h>

namespace beeline {
namespace {

using internal::CarriedBody;
using internal::ChainMotion;
using internal::CollisionBodies;
using internal::ConvexBody;

/// A pair with the frames that carry its bodies.
struct FoundPair {
  BodyDistance distance;
  std::size_t first = 0, second = 0;
};

/// Returns the distance with its gradient, of n . (second - first) with respect to q: both points
/// move with their frames.
BodyDistance with_gradient(const CollisionBodies& bodies, const ConfigurationRef& q,
                           FoundPair pair) {
  const Eigen::Index n = bodies.arm.dof();
  const Configuration none = Configuration::Zero(n), at = q;
  Eigen::VectorXd& gradient = pair.distance.gradient;
  gradient.resize(n);
  ChainMotion motion = bodies.motion;
  for (Eigen::Index k = 0; k < n; ++k) {
    motion.set({at, Configuration::Unit(n, k), none});
    const auto velocity = [&](std::size_t i, const Vector3& point) {
      const ChainMotion::Frame& frame = motion.frame(i);
      return Vector3(frame.linear + frame.angular.cross(point - motion.origin()));
    };
    gradient[k] = pair.distance.normal.dot(velocity(pair.second, pair.distance.on_second) -
                                           velocity(pair.first, pair.distance.on_first));
  }
  return std::move(pair.distance);
}

/// The distances of an arm's bodies at one configuration.
class Distances {
 public:
  Distances(const CollisionBodies& bodies, const ConfigurationRef& q, internal::ApartPairs apart)
      : bodies_(bodies), motion_(bodies.motion) {
    const Configuration none = Configuration::Zero(bodies.arm.dof());
    motion_.set({q, none, none});
    for (const auto& link : bodies.link_bodies) placed_.push_back(in_world(motion_, link.carried));
    keeps_apart_ = apart == internal::ApartPairs::outside_limits && bodies.keeps_apart(q);
  }

  /// Calls `found` for each pair whose distance may exceed its clearance by less than `within`,
  /// which `found` may reduce.
  void visit(double& within, const std::function<void(const FoundPair&)>& found) const {
    for (const auto& pair : bodies_.self_pairs) visit_links(pair, within, found);
    if (!keeps_apart_) {
      for (const auto& pair : bodies_.apart_pairs) visit_links(pair, within, found);
    }
    for (std::size_t i = 0; i < placed_.size(); ++i) {
      if (CollisionBodies::meets_obstacles(bodies_.link_bodies[i])) {
        visit_obstacles(i, within, found);
      }
    }
  }

  /// The same for the pairs of link 0 with obstacles, except those that it stands on.
  void visit_base(double& within, const std::function<void(const FoundPair&)>& found) {
    const Vector3 up = bodies_.arm.base().linear().col(2);
    double lowest = std::numeric_limits<double>::infinity();
    std::vector<std::size_t> of_base;
    for (std::size_t i = 0; i < placed_.size(); ++i) {
      if (CollisionBodies::meets_obstacles(bodies_.link_bodies[i])) continue;
      lowest = std::min(lowest, -support(placed_[i], -up));
      of_base.push_back(i);
    }
    standing_ = [up, lowest](const ConvexBody& obstacle) {
      constexpr double rounding = 1e-9;  // of the directions of a mount and of its floor
      const Vector3 normal = obstacle.axes.col(2);
      const bool is_floor =
          obstacle.core == ConvexBody::Core::half_space && (normal - up).norm() <= rounding;
      return support(obstacle, is_floor ? normal : up) <= lowest + max_standing_overlap;
    };
    for (const std::size_t i : of_base) visit_obstacles(i, within, found);
    standing_ = nullptr;
  }

 private:
  using Found = std::function<void(const FoundPair&)>;

  struct PlacedPair {
    std::size_t first;         // index of the link's body
    const ConvexBody* second;  // in the world's axes
    std::size_t frame;         // of the second
    double clearance, rounding;
    const CollisionBodies::ObstacleBody* obstacle = nullptr;  // null: another link's body
    const CollisionBodies::LinkBody* link = nullptr;
  };

  void visit_obstacles(std::size_t i, const double& within, const Found& found) const {
    if (!bodies_.tree.empty()) visit_tree(i, 0, within, found);
    for (std::size_t k = bodies_.finite_obstacles; k < bodies_.obstacle_bodies.size(); ++k) {
      visit_obstacle(i, bodies_.obstacle_bodies[k], within, found);
    }
  }

  double rounding(const CollisionBodies::LinkBody& link) const {
    return motion_.rounding(link.carried.frame, magnitude(link.carried.body));
  }

  void visit_pair(const PlacedPair& pair, double within, const Found& found) const {
    const ConvexBody& first = placed_[pair.first];
    const Vector3 between = pair.second->centre - first.centre;
    const double rounding =
        pair.rounding + support_rounding(first) + support_rounding(*pair.second);
    const double apart = between.norm() - first.bound - pair.second->bound - rounding;
    if (apart > pair.clearance + within) return;
    const internal::Separation parts = separation(first, *pair.second, between);
    const auto& link = bodies_.link_bodies[pair.first];
    found({pair.obstacle != nullptr ? bodies_.distance(link, *pair.obstacle, parts, pair.rounding)
                                    : bodies_.distance(link, bodies_.name_of(*pair.link), parts,
                                                       pair.clearance, pair.rounding),
           link.carried.frame, pair.frame});
  }

  void visit_links(const CollisionBodies::SelfPair& pair, double within, const Found& found) const {
    const auto& first = bodies_.link_bodies[pair.first];
    const auto& second = bodies_.link_bodies[pair.second];
    visit_pair({.first = pair.first,
                .second = &placed_[pair.second],
                .frame = second.carried.frame,
                .clearance = bodies_.options.clearance,
                .rounding = rounding(first) + rounding(second),
                .link = &second},
               within, found);
  }

  void visit_obstacle(std::size_t i, const CollisionBodies::ObstacleBody& obstacle, double within,
                      const Found& found) const {
    const auto& link = bodies_.link_bodies[i];
    if (bodies_.allowed(link, obstacle.obstacle)) return;
    if (standing_ && standing_(obstacle.body)) return;
    visit_pair({.first = i,
                .second = &obstacle.body,
                .frame = 0,
                .clearance = obstacle.clearance,
                .rounding = rounding(link),
                .obstacle = &obstacle},
               within, found);
  }

  void visit_tree(std::size_t i, std::uint32_t index, const double& within,
                  const Found& found) const {
    const internal::BoxTree::Node& node = bodies_.tree.node(index);
    const ConvexBody& first = placed_[i];
    const Vector3 beside = (first.centre - node.box.centre).cwiseAbs() - node.box.half_extents;
    const double rounded = rounding(bodies_.link_bodies[i]) + support_rounding(first) +
                           bodies_.tree.boxes().rounding_of(index);
    const double apart = beside.cwiseMax(0).norm() - first.bound - rounded;
    if (apart > node.clearance + within) return;
    if (node.right == 0) {
      return visit_obstacle(i, bodies_.obstacle_bodies[node.body], within, found);
    }
    visit_tree(i, index + 1, within, found);
    visit_tree(i, node.right, within, found);
  }

  const CollisionBodies& bodies_;
  ChainMotion motion_;
  std::vector<ConvexBody> placed_;
  bool keeps_apart_ = true;
  /// Whether link 0 stands on an obstacle, if its pairs are visited.
  std::function<bool(const ConvexBody&)> standing_;
};

/// The pair that blocks the arm: the deepest that is proved to be too close or, if there is none,
/// the deepest that is not decided.
class BlockingPair {
 public:
  void add(const BodyDistance& pair) {
    if (pair.lower >= pair.clearance) return;
    const bool is_deeper =
        !deepest_ || (is_proved(pair) == is_proved(*deepest_)
                          ? pair.lower - pair.clearance < deepest_->lower - deepest_->clearance
                          : is_proved(pair));
    if (is_deeper) deepest_ = pair;
  }

  Reason reason(std::span<const LinkShapes> links) const {
    if (!deepest_) return {};
    return is_proved(*deepest_) ? internal::too_close_reason(*deepest_, links)
                                : internal::not_decided_reason(*deepest_);
  }

 private:
  static bool is_proved(const BodyDistance& pair) { return pair.upper < pair.clearance; }

  std::optional<BodyDistance> deepest_;
};

}  // namespace

std::string names_text(const BodyDistance& pair) {
  const std::string index = pair.point ? "[" + std::to_string(*pair.point) + "]" : "";
  return pair.names[0] + " and " + pair.names[1] + index;
}

BodyDistance nearest_pair(const CollisionModel& model, const ConfigurationRef& q) {
  return internal::nearest_pair(model, q, internal::ApartPairs::outside_limits);
}

bool internal::has_pairs(const CollisionModel& model, const ConfigurationRef& q) {
  return model.pair_count() > 0 || !model.bodies().keeps_apart(q);
}

BodyDistance internal::nearest_pair(const CollisionModel& model, const ConfigurationRef& q,
                                    ApartPairs apart) {
  check_configuration(model.arm(), q);
  FoundPair nearest;
  double within = std::numeric_limits<double>::infinity();
  Distances(model.bodies(), q, apart).visit(within, [&](const FoundPair& pair) {
    const double excess = pair.distance.lower - pair.distance.clearance;
    if (excess >= within) return;
    within = excess;
    nearest = pair;
  });
  if (!std::isfinite(within)) throw Error("no pair of bodies counts, so none is nearest");
  return with_gradient(model.bodies(), q, std::move(nearest));
}

std::vector<BodyDistance> pairs_too_close(const CollisionModel& model, const ConfigurationRef& q) {
  check_configuration(model.arm(), q);
  std::vector<BodyDistance> pairs;
  double within = 0;
  const Distances distances(model.bodies(), q, internal::ApartPairs::outside_limits);
  distances.visit(within, [&](const FoundPair& pair) {
    const bool is_close = pair.distance.lower < pair.distance.clearance;
    if (is_close) pairs.push_back(with_gradient(model.bodies(), q, pair));
  });
  std::sort(pairs.begin(), pairs.end(), [](const BodyDistance& a, const BodyDistance& b) {
    return a.lower - a.clearance < b.lower - b.clearance;
  });
  return pairs;
}

double spare_clearance(const CollisionModel& model, const ConfigurationRef& q, double most) {
  check_configuration(model.arm(), q);
  if (!(most >= 0)) throw Error::of("most", "must be 0 or more, not " + number(most));
  double least = most;
  const Distances distances(model.bodies(), q, internal::ApartPairs::outside_limits);
  distances.visit(least, [&](const FoundPair& pair) {
    least = std::min(least, pair.distance.lower - pair.distance.clearance);
  });
  return least;
}

Reason blocked_by(const CollisionModel& model, const ConfigurationRef& q) {
  check_configuration(model.arm(), q);
  BlockingPair blocking;
  double within = 0;
  const Distances distances(model.bodies(), q, internal::ApartPairs::outside_limits);
  distances.visit(within, [&](const FoundPair& found) { blocking.add(found.distance); });
  return blocking.reason(model.links());
}

Reason base_blocked_by(const CollisionModel& model) {
  const Configuration any = Configuration::Zero(model.arm().dof());
  BlockingPair blocking;
  double within = 0;
  Distances distances(model.bodies(), any, internal::ApartPairs::outside_limits);
  distances.visit_base(within, [&](const FoundPair& found) { blocking.add(found.distance); });
  return blocking.reason(model.links());
}

}  // namespace beeline
