#pragma once

#include <algorithm>
#include <map>

#include <beeline/certificate/clearance.h>
#include <beeline/io/text/scene.h>

#include "reason.h"
#include "record.h"
#include "trajectory_fields.h"

namespace beeline::python {

/// The kinds of shapes.
using ShapeBody = decltype(Shape::body);

template <>
struct Value<ShapeBody> {
  static std::string type() { return "Sphere | Capsule | Box | Cylinder | HalfSpace | ConvexHull"; }
  static nb::object to(const ShapeBody& value);
  static ShapeBody from(nb::handle value, const char* name);
  static bool same(const ShapeBody& a, const ShapeBody& b);
};

/// Rows of an array.
template <>
struct Value<std::vector<Vector3>> {
  static constexpr bool large = true;
  static std::string type() { return array_type; }
  static nb::object to(const std::vector<Vector3>& value);
  static std::vector<Vector3> from(nb::handle value, const char* name);
  static bool same(const std::vector<Vector3>& a, const std::vector<Vector3>& b) { return a == b; }
};

/// Joint values or poses by name.
template <class Named>
struct Value<std::map<std::string, Named>> {
  static constexpr bool large = true;
  static std::string type() { return "dict[str, " + Value<Named>::type() + "]"; }
  static std::string argument_type() {
    return "collections.abc.Mapping[str, " + python::argument_type<Named>() + "]";
  }
  static nb::object to(const std::map<std::string, Named>& value) {
    nb::dict named;
    for (const auto& [name, item] : value)
      named[Value<std::string>::to(name)] = Value<Named>::to(item);
    return named;
  }
  static std::map<std::string, Named> from(nb::handle value, const char* argument) {
    if (!nb::isinstance<nb::dict>(value)) raise_type(argument, "a dict", value);
    std::map<std::string, Named> named;
    for (const auto& [name, item] : nb::borrow<nb::dict>(value)) {
      named.insert_or_assign(Value<std::string>::from(name, argument),
                             Value<Named>::from(item, argument));
    }
    return named;
  }
  static bool same(const std::map<std::string, Named>& a, const std::map<std::string, Named>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
      return x.first == y.first && python::same(x.second, y.second);
    });
  }
};

/// Texts by name; as an argument folders, for which any path is accepted.
template <>
struct Value<std::map<std::string, std::string>> {
  static constexpr bool large = true;
  static std::string type() { return "dict[str, str]"; }
  static std::string argument_type() {
    return "collections.abc.Mapping[str, str | os.PathLike[str]]";
  }
  static nb::object to(const std::map<std::string, std::string>& value);
  static std::map<std::string, std::string> from(nb::handle value, const char* name);
  static bool same(const std::map<std::string, std::string>& a,
                   const std::map<std::string, std::string>& b) {
    return a == b;
  }
};

/// It has no members.
template <>
struct Value<HalfSpace> {
  static bool same(const HalfSpace&, const HalfSpace&) { return true; }
};

/// The shapes that check_shape() refuses are no objects.
template <class Body>
void check_body(const Body& body) {
  check_shape({.body = body});
}

template <>
struct Fields<Sphere> : Members<&Sphere::radius> {
  static constexpr std::size_t required = 1;

  static void check(const Sphere& sphere) { check_body(sphere); }
};

template <>
struct Fields<Capsule> : Members<&Capsule::radius, &Capsule::length> {
  static constexpr std::size_t required = 2;

  static void check(const Capsule& capsule) { check_body(capsule); }
};

template <>
struct Fields<Box> : Members<&Box::size> {
  static constexpr std::size_t required = 1;

  static void check(const Box& box) { check_body(box); }
};

template <>
struct Fields<Cylinder> : Members<&Cylinder::radius, &Cylinder::length> {
  static constexpr std::size_t required = 2;

  static void check(const Cylinder& cylinder) { check_body(cylinder); }
};

template <>
struct Fields<ConvexHull> : Members<&ConvexHull::vertices> {
  static constexpr std::size_t required = 1;

  static void check(const ConvexHull& hull) { check_body(hull); }
};

template <>
struct Fields<Shape> : Members<&Shape::body, &Shape::pose, &Shape::padding, &Shape::hull_of> {
  static constexpr std::size_t required = 1;

  static void check(const Shape& shape) { check_shape(shape); }
};

template <>
struct Fields<PointCloud> : Members<&PointCloud::points, &PointCloud::radius> {
  static constexpr std::size_t required = 2;

  static void check(const PointCloud& cloud) { check_cloud(cloud); }
};

template <>
struct Fields<Obstacle>
    : Members<&Obstacle::name, &Obstacle::shapes, &Obstacle::clearance, &Obstacle::cloud> {
  static constexpr std::size_t required = 2;
};

template <>
struct Fields<Scene> : Members<&Scene::obstacles, &Scene::allowed_pairs, &Scene::held,
                               &Scene::links_without_shapes, &Scene::exempted_pairs> {
  static constexpr bool constructible = true;
  static constexpr bool positional = true;
};

template <>
struct Fields<LinkShapes>
    : Members<&LinkShapes::name, &LinkShapes::link, &LinkShapes::shapes,
              &LinkShapes::at_proximal_joint, &LinkShapes::at_distal_joint, &LinkShapes::held> {
  static constexpr std::size_t required = 3;
};

template <>
struct Fields<ArmShapes>
    : Members<&ArmShapes::links, &ArmShapes::held, &ArmShapes::held_by_state,
              &ArmShapes::allowed_pairs, &ArmShapes::links_without_shapes,
              &ArmShapes::links_with_planes, &ArmShapes::base_links, &ArmShapes::standing> {};

template <>
struct Fields<BodyDistance>
    : Members<&BodyDistance::names, &BodyDistance::lower, &BodyDistance::upper,
              &BodyDistance::clearance, &BodyDistance::on_first, &BodyDistance::on_second,
              &BodyDistance::normal, &BodyDistance::gradient, &BodyDistance::point> {};

template <>
inline constexpr bool reports<CollisionOptions> = false;
template <>
struct Fields<CollisionOptions>
    : Members<&CollisionOptions::clearance, &CollisionOptions::self_collision,
              &CollisionOptions::allowed_pairs, &CollisionOptions::budget> {};

template <>
inline constexpr bool reports<ClearanceOptions> = false;
template <>
struct Fields<ClearanceOptions>
    : Members<&ClearanceOptions::resolution, &ClearanceOptions::closest,
              &ClearanceOptions::recover_clearance, &ClearanceOptions::budget> {};

template <>
struct Fields<ClearanceRecovery>
    : Members<&ClearanceRecovery::names, &ClearanceRecovery::depth, &ClearanceRecovery::distance,
              &ClearanceRecovery::pairs, &ClearanceRecovery::sample, &ClearanceRecovery::time> {};

template <>
struct Fields<ClearanceProof>
    : Members<&ClearanceProof::status, &ClearanceProof::reason, &ClearanceProof::least_distance,
              &ClearanceProof::pair, &ClearanceProof::time, &ClearanceProof::begin,
              &ClearanceProof::end, &ClearanceProof::parts, &ClearanceProof::pairs,
              &ClearanceProof::recovery> {};

template <>
struct Fields<ClearanceOverTime>
    : Members<&ClearanceOverTime::times, &ClearanceOverTime::proved,
              &ClearanceOverTime::sample_times, &ClearanceOverTime::sampled,
              &ClearanceOverTime::clearance, &ClearanceOverTime::ending> {};

/// Returns the model that an option has, which keeps its Python object. Throws TypeError for
/// anything else.
std::shared_ptr<const CollisionModel> shared_model(nb::handle value, const char* name);

/// Throws Error if an option does not suit the arm: blocked_by or spare_clearance is a model of
/// another one, or task is a mask of planar arms.
void check_options_of(const Arm& arm, const nb::dict& keywords);

/// A model that the caller keeps as long as it is used.
template <>
struct Value<const CollisionModel*> {
  static std::string type() { return "CollisionModel | None"; }
  static nb::object to(const CollisionModel*) { return nb::none(); }
  static const CollisionModel* from(nb::handle value, const char* name) {
    if (value.is_none()) return nullptr;
    if (!nb::isinstance<CollisionModel>(value)) raise_type(name, type(), value);
    return &nb::cast<const CollisionModel&>(value);
  }
};

}  // namespace beeline::python
