#include "coal_scene.h"

#include <algorithm>
#include <limits>

#include <beeline/kinematics/forward.h>

#include <coal/collision.h>
#include <coal/distance.h>
#include <coal/shape/geometric_shapes.h>

namespace beeline::bench {
namespace {

using Geometry = std::shared_ptr<coal::ShapeBase>;

Geometry geometry_of(const Sphere& sphere) { return std::make_shared<coal::Sphere>(sphere.radius); }
Geometry geometry_of(const Capsule& capsule) {
  return std::make_shared<coal::Capsule>(capsule.radius, capsule.length);
}
Geometry geometry_of(const Box& box) {
  return std::make_shared<coal::Box>(box.size.x(), box.size.y(), box.size.z());
}
Geometry geometry_of(const Cylinder& cylinder) {
  return std::make_shared<coal::Cylinder>(cylinder.radius, cylinder.length);
}
Geometry geometry_of(const HalfSpace&) {
  return std::make_shared<coal::Halfspace>(coal::Vec3s(0, 0, 1), 0);
}
Geometry geometry_of(const ConvexHull& hull) {
  auto points = std::make_shared<std::vector<coal::Vec3s>>(hull.vertices);
  const auto count = static_cast<unsigned>(points->size());
  return Geometry(coal::ConvexBase::convexHull(points, count, true));
}

coal::Transform3s transform(const Pose& pose) { return {pose.linear(), pose.translation()}; }

/// A shape that a link carries, or an obstacle's.
struct Body {
  Body(const Shape& shape, std::string of, std::size_t carrier)
      : geometry(std::visit([](const auto& body) { return geometry_of(body); }, shape.body)),
        pose(shape.pose),
        name(std::move(of)),
        link(carrier) {
    if (shape.padding > 0) geometry->setSweptSphereRadius(shape.padding);
    geometry->computeLocalAABB();
    place(Pose::Identity());
  }

  void place(const Pose& carrier) {
    const Pose at = carrier * pose;
    placed = transform(at);
    if (geometry->getNodeType() == coal::GEOM_HALFSPACE) return;
    const coal::AABB& local = geometry->aabb_local;
    const Vector3 half = (local.max_ - local.min_) / 2;
    centre = at * Vector3((local.max_ + local.min_) / 2);
    extent = at.linear().cwiseAbs() * half;
  }

  /// A lower bound of the distance.
  double apart(const Body& other) const {
    return ((centre - other.centre).cwiseAbs() - extent - other.extent).cwiseMax(0).norm();
  }

  Geometry geometry;
  Pose pose;
  std::string name;
  std::size_t link;
  coal::Transform3s placed;
  Vector3 centre = Vector3::Zero();
  Vector3 extent = Vector3::Constant(1e9);  // of a half-space
};

double distance(const Body& first, const Body& second) {
  coal::DistanceRequest request;
  coal::DistanceResult result;
  return coal::distance(first.geometry.get(), first.placed, second.geometry.get(), second.placed,
                        request, result);
}

bool are_allowed(const Scene& scene, const std::string& a, const std::string& b) {
  return std::any_of(scene.allowed_pairs.begin(), scene.allowed_pairs.end(), [&](const auto& pair) {
    return pair == NamedPair{a, b} || pair == NamedPair{b, a};
  });
}

/// Whether two bodies of the arm are at one joint, or fixed to one link.
bool are_neighbours(const LinkShapes& a, const LinkShapes& b) {
  const LinkShapes& first = a.link <= b.link ? a : b;
  const LinkShapes& second = a.link <= b.link ? b : a;
  if (first.link == second.link) return true;
  return first.link + 1 == second.link && first.at_distal_joint && second.at_proximal_joint;
}

}  // namespace

struct CoalScene::Bodies {
  Arm arm;
  std::vector<Body> of_arm, of_scene;
  std::vector<std::pair<const Body*, const Body*>> pairs;

  void place(const Configuration& q) {
    const std::vector<Pose> links = link_poses(arm, q);
    for (Body& body : of_arm) body.place(links[body.link]);
  }
};

bool has_coal() { return true; }

CoalScene::CoalScene(const Arm& arm, const std::vector<LinkShapes>& links, const Scene& scene)
    : bodies_(new Bodies{arm, {}, {}, {}}) {
  std::vector<const LinkShapes*> of;
  for (const LinkShapes& link : links) {
    for (const Shape& shape : link.shapes) {
      bodies_->of_arm.emplace_back(shape, link.name, link.link);
      of.push_back(&link);
    }
  }
  for (const Obstacle& obstacle : scene.obstacles) {
    for (const Shape& shape : obstacle.shapes) {
      bodies_->of_scene.emplace_back(shape, obstacle.name, 0);
    }
  }
  for (std::size_t i = 0; i < of.size(); ++i) {
    const Body& first = bodies_->of_arm[i];
    for (std::size_t k = 0; k < i; ++k) {
      if (of[i] == of[k] || are_neighbours(*of[i], *of[k])) continue;
      const Body& second = bodies_->of_arm[k];
      if (!are_allowed(scene, first.name, second.name)) {
        bodies_->pairs.emplace_back(&first, &second);
      }
    }
    if (of[i]->link == 0) continue;
    for (const Body& second : bodies_->of_scene) {
      if (!are_allowed(scene, first.name, second.name)) {
        bodies_->pairs.emplace_back(&first, &second);
      }
    }
  }
}

CoalScene::~CoalScene() = default;

bool CoalScene::collides(const Configuration& q, double margin) {
  bodies_->place(q);
  coal::CollisionRequest request;
  request.security_margin = margin;
  for (const auto& [first, second] : bodies_->pairs) {
    if (first->apart(*second) > margin) continue;
    coal::CollisionResult result;
    if (coal::collide(first->geometry.get(), first->placed, second->geometry.get(), second->placed,
                      request, result) > 0) {
      return true;
    }
  }
  return false;
}

CoalDistance CoalScene::least_distance(const Configuration& q) {
  bodies_->place(q);
  CoalDistance least{std::numeric_limits<double>::infinity()};
  for (const auto& [first, second] : bodies_->pairs) {
    if (first->apart(*second) > std::max(least.value, 0.0)) continue;
    const double value = distance(*first, *second);
    if (value < least.value) least = {value, {first->name, second->name}};
  }
  return least;
}

double coal_distance(const Shape& first, const Shape& second) {
  return distance(Body(first, "", 0), Body(second, "", 0));
}

}  // namespace beeline::bench
