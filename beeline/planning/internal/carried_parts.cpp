#include <algorithm>
#include <limits>

#include <beeline/collision/internal/collision_bodies.h>
#include <beeline/kinematics/forward.h>
#include <beeline/planning/internal/carried_parts.h>

namespace beeline::internal {
namespace {

std::size_t obstacle_named(const Scene& scene, const std::string& name) {
  const auto found = std::find_if(scene.obstacles.begin(), scene.obstacles.end(),
                                  [&](const Obstacle& obstacle) { return obstacle.name == name; });
  return static_cast<std::size_t>(found - scene.obstacles.begin());
}

/// Bounds the rounding errors of the points of shapes, posed in the last link, that are moved from
/// the world to the link or back, m: of the link's pose, and of its product with theirs.
double rounding_of(const CollisionBodies& bodies, const std::vector<Shape>& shapes,
                   const ConfigurationRef& q) {
  double distance = 0;
  for (const Shape& shape : shapes) distance = std::max(distance, magnitude(convex_body(shape)));
  ChainMotion motion = bodies.motion;
  const Configuration at = q, none = Configuration::Zero(bodies.arm.dof());
  motion.set({at, none, none});
  const double coordinates = motion.origin().norm() + distance;
  constexpr double product = 64 * std::numeric_limits<double>::epsilon();
  return 4 * motion.rounding(bodies.arm.joints().size(), distance) + product * coordinates;
}

}  // namespace

bool has_change(const Program& program, std::size_t moves) {
  return std::any_of(
      program.attachments.begin(), program.attachments.end(),
      [moves](const Attachment& one) { return one.after == moves || one.until == moves; });
}

CarriedParts::CarriedParts(const CollisionModel& model, const Program& program)
    : model_(model),
      program_(program),
      scene_(model.bodies().scene),
      carried_by_(scene_.obstacles.size()) {
  for (const Attachment& attachment : program.attachments) {
    obstacles_.push_back(obstacle_named(scene_, attachment.part));
  }
}

void CarriedParts::change(std::size_t moves, const ConfigurationRef& q) {
  changed_.clear();
  // A part may be attached anew where it is detached.
  for (std::size_t i = 0; i < program_.attachments.size(); ++i) {
    if (program_.attachments[i].until == moves) detach(i, q);
  }
  for (std::size_t i = 0; i < program_.attachments.size(); ++i) {
    if (program_.attachments[i].after == moves) attach(i, q);
  }
}

void CarriedParts::attach(std::size_t attachment, const ConfigurationRef& q) {
  const std::size_t k = obstacles_[attachment];
  const Pose link_T_world = link_poses(model_.arm(), q).back().inverse();
  std::vector<Shape>& shapes = scene_.obstacles[k].shapes;
  for (Shape& shape : shapes) shape.pose = link_T_world * shape.pose;
  const double rounding = rounding_of(model_.bodies(), shapes, q);
  for (Shape& shape : shapes) shape.padding += rounding;
  carried_by_[k] = attachment;
  changed_.push_back(attachment);
}

void CarriedParts::detach(std::size_t attachment, const ConfigurationRef& q) {
  const std::size_t k = obstacles_[attachment];
  const Pose world_T_link = link_poses(model_.arm(), q).back();
  std::vector<Shape>& shapes = scene_.obstacles[k].shapes;
  const double rounding = rounding_of(model_.bodies(), shapes, q);
  for (Shape& shape : shapes) {
    shape.pose = world_T_link * shape.pose;
    shape.padding += rounding;
  }
  carried_by_[k].reset();
  changed_.push_back(attachment);
}

Pose CarriedParts::pose_in_tool(std::size_t attachment) const {
  const Obstacle& part = scene_.obstacles[obstacles_[attachment]];
  return model_.arm().tool().inverse() * part.shapes.front().pose;
}

CollisionModel CarriedParts::model() const {
  const CollisionBodies& bodies = model_.bodies();
  std::vector<LinkShapes> parts;
  Scene scene{.obstacles = {},
              .allowed_pairs = scene_.allowed_pairs,
              .exempted_pairs = scene_.exempted_pairs};
  CollisionOptions options = bodies.options;
  // Without pairs of links, a part that is carried still meets them.
  options.self_collision = true;
  const std::vector<LinkShapes>& links = bodies.links;
  for (std::size_t a = 0; a < links.size() && !bodies.options.self_collision; ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      options.allowed_pairs.push_back({links[a].name, links[b].name});
    }
  }
  for (std::size_t k = 0; k < scene_.obstacles.size(); ++k) {
    const Obstacle& obstacle = scene_.obstacles[k];
    if (!carried_by_[k]) {
      scene.obstacles.push_back(obstacle);
      continue;
    }
    parts.push_back({.name = obstacle.name,
                     .link = bodies.arm.joints().size(),
                     .shapes = obstacle.shapes,
                     .at_proximal_joint = false,
                     .at_distal_joint = false});
    for (const std::string& name : program_.attachments[*carried_by_[k]].touch) {
      options.allowed_pairs.push_back({obstacle.name, name});
    }
  }
  return with_carried(model_, parts, scene, options);
}

}  // namespace beeline::internal
