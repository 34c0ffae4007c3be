#include <algorithm>
#include <cmath>
#include <set>
#include <unordered_map>

#include <beeline/collision/internal/collision_bodies.h>
#include <beeline/collision/internal/pairs_apart.h>
#include <beeline/collision/internal/separation.h>

namespace beeline {
namespace {

using internal::CollisionBodies;

/// The names of all bodies: links are 0, 1, ..., obstacles follow.
class Names {
 public:
  void add(const std::string& name) {
    if (name.empty()) throw Error("a link or an obstacle has no name");
    if (!index_of_.emplace(name, names_.size()).second) {
      throw Error("two links or obstacles have the name \"" + name + "\"");
    }
    names_.push_back(name);
  }

  bool has(const std::string& name) const { return index_of_.contains(name); }

  std::size_t index_of(const std::string& name) const {
    const auto found = index_of_.find(name);
    if (found == index_of_.end()) throw unknown_name("link or obstacle", name, names_);
    return found->second;
  }

 private:
  std::vector<std::string> names_;
  std::unordered_map<std::string, std::size_t> index_of_;
};

/// The error of a named body's shape.
Error in_body(const std::string& name, const Error& error) {
  return error.behind("\"" + name + "\": ");
}

void add_links(CollisionBodies& bodies) {
  for (std::size_t i = 0; i < bodies.links.size(); ++i) {
    const LinkShapes& link = bodies.links[i];
    if (link.link > bodies.arm.joints().size()) {
      throw Error("\"" + link.name + "\" is on link " + std::to_string(link.link) + "; " +
                  bodies.arm.name() + " has links 0 to " +
                  std::to_string(bodies.arm.joints().size()));
    }
    const Pose& frame = bodies.motion.link_frame(link.link);
    for (const Shape& shape : link.shapes) {
      try {
        check_shape(shape);
        if (std::holds_alternative<HalfSpace>(shape.body)) {
          throw Error("a half_space is an obstacle; a link cannot carry it");
        }
      } catch (const Error& error) {
        throw in_body(link.name, error);
      }
      const internal::ConvexBody body =
          moved(frame.linear(), frame.translation(), internal::convex_body(shape));
      bodies.link_bodies.push_back({{body, link.link}, i});
      if (bodies.motion.slides(link.link)) continue;
      const Configuration any = Configuration::Zero(bodies.arm.dof());
      bodies.link_bodies.back().reach = bodies.motion.reach(body, link.link, any, any);
    }
  }
}

/// Adds the spheres around the points of an obstacle's cloud.
void add_cloud(CollisionBodies& bodies, std::size_t obstacle, double clearance) {
  const PointCloud& cloud = *bodies.scene.obstacles[obstacle].cloud;
  internal::ConvexBody sphere;
  sphere.radius = sphere.bound = cloud.radius;
  for (std::size_t k = 0; k < cloud.points.size(); ++k) {
    sphere.origin = sphere.centre = cloud.points[k] - bodies.motion.origin();
    bodies.obstacle_bodies.push_back({sphere, obstacle, clearance, static_cast<std::uint32_t>(k)});
  }
}

void add_obstacles(CollisionBodies& bodies) {
  std::vector<CollisionBodies::ObstacleBody> half_spaces;
  for (std::size_t i = 0; i < bodies.scene.obstacles.size(); ++i) {
    const Obstacle& obstacle = bodies.scene.obstacles[i];
    const double clearance = obstacle.clearance.value_or(bodies.options.clearance);
    try {
      check_clearance(clearance);
      if (obstacle.shapes.empty() && !obstacle.cloud) throw Error("an obstacle has no shape");
      for (const Shape& shape : obstacle.shapes) check_shape(shape);
      if (obstacle.cloud) check_cloud(*obstacle.cloud);
    } catch (const Error& error) {
      throw in_body(obstacle.name, error);
    }
    for (const Shape& shape : obstacle.shapes) {
      const CollisionBodies::ObstacleBody body{
          moved(Rotation::Identity(), -bodies.motion.origin(), internal::convex_body(shape)), i,
          clearance};
      const bool finite = std::isfinite(body.body.bound);
      (finite ? bodies.obstacle_bodies : half_spaces).push_back(body);
    }
    if (obstacle.cloud) add_cloud(bodies, i, clearance);
  }
  bodies.finite_obstacles = bodies.obstacle_bodies.size();
  std::vector<internal::ConvexBody> finite;
  std::vector<double> clearances;
  for (const auto& body : bodies.obstacle_bodies) {
    finite.push_back(body.body);
    clearances.push_back(body.clearance);
  }
  bodies.tree = internal::BoxTree(finite, clearances);
  bodies.obstacle_bodies.insert(bodies.obstacle_bodies.end(), half_spaces.begin(),
                                half_spaces.end());
}

/// Pairs of two links, as indices of LinkShapes, the smaller one first.
using LinkPairs = std::set<std::array<std::size_t, 2>>;

/// Sets the pairs that may touch; returns the pairs of two links.
LinkPairs set_allowed(CollisionBodies& bodies, const std::vector<NamedPair>& pairs) {
  Names names;
  for (const LinkShapes& link : bodies.links) names.add(link.name);
  for (const Obstacle& obstacle : bodies.scene.obstacles) names.add(obstacle.name);
  const std::size_t links = bodies.links.size(), obstacles = bodies.scene.obstacles.size();
  bodies.obstacle_allowed.assign(links * obstacles, false);
  LinkPairs of_links;
  const auto allow = [&](const NamedPair& pair) {
    std::size_t first = names.index_of(pair[0]), second = names.index_of(pair[1]);
    if (first > second) std::swap(first, second);
    if (second < links) {
      of_links.insert({first, second});
    } else if (first < links) {
      bodies.obstacle_allowed[first * obstacles + (second - links)] = true;
    }
  };
  for (const NamedPair& pair : bodies.scene.allowed_pairs) allow(pair);
  for (const NamedPair& pair : pairs) allow(pair);
  for (const NamedPair& pair : bodies.scene.exempted_pairs) {
    if (names.has(pair[0]) && names.has(pair[1])) allow(pair);
  }
  return of_links;
}

/// Whether two bodies are at the same joint, which moves the later one.
bool share_joint(const LinkShapes& later, const LinkShapes& earlier) {
  return later.link == earlier.link + 1 && later.at_proximal_joint && earlier.at_distal_joint;
}

void add_self_pairs(CollisionBodies& bodies, const LinkPairs& allowed) {
  const auto is_allowed = [&](std::size_t a, std::size_t b) {
    return allowed.contains({std::min(a, b), std::max(a, b)});
  };
  for (std::uint32_t a = 0; a < bodies.link_bodies.size(); ++a) {
    for (std::uint32_t b = 0; b < bodies.link_bodies.size(); ++b) {
      const auto& later = bodies.link_bodies[a];
      const auto& earlier = bodies.link_bodies[b];
      if (later.carried.frame <= earlier.carried.frame) continue;
      if (share_joint(bodies.links[later.link_shapes], bodies.links[earlier.link_shapes])) continue;
      if (!is_allowed(later.link_shapes, earlier.link_shapes)) bodies.self_pairs.push_back({a, b});
    }
  }
}

/// `known`, if given, has the first of the links and the same clearance.
std::unique_ptr<CollisionBodies> bodies_of(const Arm& arm, const std::vector<LinkShapes>& links,
                                           const Scene& scene, const CollisionOptions& options,
                                           const CollisionBodies* known) {
  check_clearance(options.clearance);
  auto bodies = std::make_unique<CollisionBodies>(arm, links, scene, options);
  add_links(*bodies);
  add_obstacles(*bodies);
  const auto allowed = set_allowed(*bodies, options.allowed_pairs);
  if (options.self_collision) add_self_pairs(*bodies, allowed);
  internal::BudgetMeter budget(options.budget);
  internal::find_pairs_apart(*bodies, budget, known);
  bodies->set_groups();
  return bodies;
}

}  // namespace

CollisionModel::CollisionModel(const Arm& arm, const std::vector<LinkShapes>& links,
                               const Scene& scene, const CollisionOptions& options)
    : CollisionModel(bodies_of(arm, links, scene, options, nullptr)) {}

CollisionModel::CollisionModel(std::unique_ptr<const CollisionBodies> bodies)
    : bodies_(std::move(bodies)) {}

// Distances of links do not depend on the mount, so the pairs are the same.
CollisionModel with_mount(const CollisionModel& model, const Pose& world_T_mount) {
  const CollisionBodies& from = model.bodies();
  return CollisionModel(
      bodies_of(with_mount(from.arm, world_T_mount), from.links, from.scene, from.options, &from));
}

CollisionModel internal::with_carried(const CollisionModel& model,
                                      const std::vector<LinkShapes>& parts, const Scene& scene,
                                      const CollisionOptions& options) {
  const CollisionBodies& known = model.bodies();
  std::vector<LinkShapes> links = known.links;
  links.insert(links.end(), parts.begin(), parts.end());
  return CollisionModel(bodies_of(known.arm, links, scene, options, &known));
}

CollisionModel::CollisionModel(CollisionModel&&) noexcept = default;
CollisionModel& CollisionModel::operator=(CollisionModel&&) noexcept = default;
CollisionModel::~CollisionModel() = default;

std::vector<NamedPair> CollisionModel::neighbour_pairs() const {
  std::vector<NamedPair> pairs;
  for (const LinkShapes& earlier : bodies_->links) {
    for (const LinkShapes& later : bodies_->links) {
      if (earlier.shapes.empty() || later.shapes.empty()) continue;
      if (share_joint(later, earlier)) pairs.push_back({earlier.name, later.name});
    }
  }
  return pairs;
}

std::size_t CollisionModel::apart_count() const { return bodies_->apart_pairs.size(); }

const Arm& CollisionModel::arm() const { return bodies_->arm; }

const std::vector<LinkShapes>& CollisionModel::links() const { return bodies_->links; }

const Scene& CollisionModel::scene() const { return bodies_->scene; }

double CollisionModel::clearance() const { return bodies_->options.clearance; }

std::size_t CollisionModel::pair_count() const { return bodies_->pair_count; }

}  // namespace beeline
