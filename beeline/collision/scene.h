#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <beeline/error.h>
#include <beeline/pose/se3.h>

namespace beeline {

/// The points within `radius` of the origin.
struct Sphere {
  double radius = 0;  ///< m
};

/// The points within `radius` of a segment of the z axis whose middle is the origin.
struct Capsule {
  double radius = 0;  ///< m
  double length = 0;  ///< length of the segment, m; the capsule is longer by two radii
};

/// A box whose edges are parallel to the axes and whose centre is the origin.
struct Box {
  Vector3 size = Vector3::Zero();  ///< lengths of the edges, m
};

/// A cylinder about the z axis whose centre is the origin.
struct Cylinder {
  double radius = 0;  ///< m
  double length = 0;  ///< m
};

/// The points with z <= 0: a floor or a wall.
struct HalfSpace {};

/// The convex hull of points: every point that is a weighted mean of them.
struct ConvexHull {
  std::vector<Vector3> vertices;  ///< m; points inside the hull are allowed
};

/// A convex set of points that is fixed to a link or to the world.
struct Shape {
  using Body = std::variant<Sphere, Capsule, Box, Cylinder, HalfSpace, ConvexHull>;
  Body body = Sphere();          ///< body of one kind
  Pose pose = Pose::Identity();  ///< pose of the body in the frame of its link, or in the world
  double padding = 0;  ///< distance by which the body is grown in all directions, m, 0 or more
  /// Path of the mesh if the body is the convex hull of one, for reports; empty if it is not. A
  /// mesh that is not convex is smaller than its hull.
  std::string hull_of = {};
};

/// Returns "sphere", "capsule", "box", "cylinder", "half_space" or "convex_hull".
std::string kind_name(const Shape& shape);

/// The names of all kinds, in the order of Shape::Body.
std::vector<std::string> shape_kind_names();

/// The largest radius, size and coordinate of a shape, m. Larger ones are likely in another unit.
constexpr double max_shape_size = 1e6;

/// Throws Error for a radius, length, size or padding that is negative, above max_shape_size or not
/// finite, for a hull without vertices, for `hull_of` of another body, and for a pose that is not a
/// rigid motion. A radius, a length and a size of 0 are allowed: a plate without thickness, or a
/// point.
void check_shape(const Shape& shape);

/// Points that grow to spheres of one radius, such as the points that a depth camera measures.
struct PointCloud {
  std::vector<Vector3> points;  ///< in the world, m
  double radius = 0;            ///< radius of the spheres around the points, m
};

/// The largest number of points in a cloud.
constexpr std::size_t max_cloud_points = 1'000'000;

/// Throws Error for a cloud without points or with more than max_cloud_points, for a radius that is
/// negative, above max_shape_size or not finite, and for a point that is beyond max_shape_size or
/// not finite, with its index.
void check_cloud(const PointCloud& cloud);

/// Throws Error for a clearance that is not above 0 or is above max_shape_size, m.
void check_clearance(double clearance);

/// The names of two bodies: links or obstacles.
using NamedPair = std::array<std::string, 2>;

/// A body that stands still in the world.
struct Obstacle {
  std::string name = {};           ///< unique in a scene
  std::vector<Shape> shapes = {};  ///< shapes of the body, posed in the world
  /// Distance that the arm must keep from it, m, above 0; default: the one of all obstacles.
  std::optional<double> clearance = std::nullopt;
  /// Points that belong to the body, too. A body without shapes needs them.
  std::optional<PointCloud> cloud = std::nullopt;
};

/// The obstacles around an arm.
struct Scene {
  std::vector<Obstacle> obstacles = {};       ///< obstacles, with unique names
  std::vector<NamedPair> allowed_pairs = {};  ///< pairs of bodies that may touch
  /// Pairs that may touch, too, of the allowed collision matrix of a scene of MoveIt. Names that
  /// neither the arm nor the scene has are ignored: the matrix describes all links of a robot.
  std::vector<NamedPair> exempted_pairs = {};
  /// Values, rad or m, at which the joints of the scene's URDF file are held, by name, for reports.
  /// The poses of the shapes include them. JSON files have no joints.
  std::map<std::string, double> held = {};
  /// Links of the scene's URDF file with `<visual>` and without `<collision>`: they are no
  /// obstacles. For reports.
  std::vector<std::string> links_without_shapes = {};
};

/// The shapes of one body of an arm.
struct LinkShapes {
  std::string name;           ///< name of the link; unique in an arm
  std::size_t link = 0;       ///< index of the link that carries it: 0 is the base, n the last
  std::vector<Shape> shapes;  ///< shapes of the body, posed in the link's frame (link_poses())
  /// Whether joint `link`, which moves the link, is at this body. The two bodies at a joint may
  /// touch each other; a body that is fixed to a link elsewhere must keep its clearance from the
  /// neighbouring links.
  bool at_proximal_joint = true;
  bool at_distal_joint = true;  ///< likewise of the next joint, `link` + 1
  /// Values, rad or m, of the joints beside the chain that carry the body and can be held at other
  /// ones, by name, for reasons. The poses of the shapes include them.
  std::map<std::string, double> held = {};
};

}  // namespace beeline
