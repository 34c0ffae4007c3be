#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <beeline/collision/internal/collision_bodies.h>
#include <beeline/collision/internal/nearest_pair.h>
#include <beeline/draw/internal/scene_drawing.h>
#include <beeline/draw/internal/text.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/kinematics/forward.h>

namespace beeline::internal {
namespace {

constexpr Colour clear_pair{0.00, 0.55, 0.58}, close_pair{0.83, 0.13, 0.15};
constexpr Colour obstacle_line{0.44, 0.35, 0.20}, link_line{0.33, 0.43, 0.56};
constexpr double obstacle_opacity = 0.55, link_opacity = 0.4;

Colour with_opacity(Colour colour, double alpha) {
  colour.alpha = alpha;
  return colour;
}

/// The region around the base of the arm that a page contains: a cube.
struct Region {
  Vector3 centre;
  double half;

  explicit Region(const Arm& arm)
      : centre(arm.base().translation()), half(1.2 * unit_of_length(arm)) {}
  Vector3 clamped(const Vector3& p) const {
    return p.cwiseMax(centre - Vector3::Constant(half)).cwiseMin(centre + Vector3::Constant(half));
  }
};

using Faces = std::vector<std::vector<std::size_t>>;

/// A box from `low` to `high` in the frame of `pose`.
Solid box_solid(const Pose& pose, const Vector3& low, const Vector3& high) {
  Solid solid;
  for (int corner = 0; corner < 8; ++corner) {
    solid.points.emplace_back(pose * Vector3((corner & 1) != 0 ? high.x() : low.x(),
                                             (corner & 2) != 0 ? high.y() : low.y(),
                                             (corner & 4) != 0 ? high.z() : low.z()));
  }
  solid.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                 {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return solid;
}

/// Makes the solid of a shape's body, without its padding.
struct SolidOf {
  const Pose& pose;
  const Region& region;

  Solid operator()(const Sphere& sphere) const {
    return {.points = {pose.translation()}, .radius = sphere.radius};
  }
  Solid operator()(const Capsule& capsule) const {
    const Vector3 end(0, 0, capsule.length / 2);
    return {.points = {pose * Vector3(-end), pose * end}, .radius = capsule.radius};
  }
  Solid operator()(const Box& box) const { return box_solid(pose, -box.size / 2, box.size / 2); }
  Solid operator()(const Cylinder& cylinder) const {
    constexpr std::size_t corners = 36;
    Solid solid;
    solid.faces.resize(2);
    for (std::size_t i = 0; i < corners; ++i) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(i) / corners;
      const double x = cylinder.radius * std::cos(angle), y = cylinder.radius * std::sin(angle);
      solid.points.emplace_back(pose * Vector3(x, y, -cylinder.length / 2));
      solid.points.emplace_back(pose * Vector3(x, y, cylinder.length / 2));
      solid.faces[0].push_back(2 * (corners - 1 - i));
      solid.faces[1].push_back(2 * i + 1);
    }
    return solid;
  }
  /// A slab around the point of the surface that is nearest to the arm's base.
  Solid operator()(const HalfSpace&) const {
    Vector3 middle = pose.inverse() * region.centre;
    middle.z() = 0;
    const Vector3 half(0.6 * region.half, 0.6 * region.half, 0);
    return box_solid(pose, middle - half - Vector3(0, 0, 0.02 * region.half), middle + half);
  }
  Solid operator()(const ConvexHull& hull) const {
    Solid solid;
    for (const Vector3& vertex : hull.vertices) solid.points.emplace_back(pose * vertex);
    return solid;
  }
};

/// Returns the solid of a shape whose frame is at `frame`, in the world.
Solid solid_of(const Shape& shape, const Pose& frame, const Region& region) {
  const Pose pose = frame * shape.pose;
  Solid solid = std::visit(SolidOf{pose, region}, shape.body);
  solid.radius += shape.padding;
  return solid;
}

/// Returns the spheres of a point cloud: of a large one every second, third or further point.
std::vector<Solid> solids_of(const std::optional<PointCloud>& cloud) {
  constexpr std::size_t most = 2000;
  std::vector<Solid> solids;
  if (!cloud) return solids;
  const std::size_t step = (cloud->points.size() + most - 1) / most;
  for (std::size_t i = 0; i < cloud->points.size(); i += step) {
    solids.push_back({.points = {cloud->points[i]}, .radius = cloud->radius});
  }
  return solids;
}

/// Returns corners of boxes that contain the solid.
std::vector<Vector3> corners_around(const Solid& solid) {
  if (!(solid.radius > 0)) return solid.points;
  std::vector<Vector3> corners;
  for (const Vector3& p : solid.points) {
    for (int corner = 0; corner < 8; ++corner) {
      const auto sign = [corner](int bit) { return (corner & bit) != 0 ? 1.0 : -1.0; };
      const Vector3 signs(sign(1), sign(2), sign(4));
      corners.emplace_back(p + solid.radius * signs);
    }
  }
  return corners;
}

/// Returns the points of an obstacle that the page contains; none if it is outside the region.
std::vector<Vector3> framed_points(const Solid& solid, const Region& region) {
  std::vector<Vector3> points = corners_around(solid);
  Vector3 low = points.front(), high = low;
  for (const Vector3& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Vector3 away = (region.centre.cwiseMax(low).cwiseMin(high) - region.centre).cwiseAbs();
  if (away.maxCoeff() > region.half) return {};
  for (Vector3& p : points) p = region.clamped(p);
  return points;
}

Vector3 mean_of(const std::vector<Vector3>& points) {
  Vector3 sum = Vector3::Zero();
  for (const Vector3& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

/// A distance with three significant digits.
std::string distance_text(double distance) {
  const double size = std::abs(distance);
  const int decimals =
      size > 0 ? std::clamp(2 - static_cast<int>(std::floor(std::log10(size))), 0, 9) : 0;
  return fixed(distance, decimals) + " m";
}

bool keeps_clearance(const BodyDistance& pair) { return pair.upper >= pair.clearance; }

/// The distance of a pair, or the depth by which it overlaps, below 0.
double shown_distance(const BodyDistance& pair) { return pair.lower > 0 ? pair.upper : pair.lower; }

/// Whether an obstacle of two scenes of a program, which moves as a whole, is where it was.
bool same_place(const Obstacle& a, const Obstacle& b) {
  if (a.shapes.empty() || b.shapes.empty()) return a.shapes.empty() == b.shapes.empty();
  return a.shapes.front().pose.matrix() == b.shapes.front().pose.matrix();
}

}  // namespace

void add_obstacles(Drawing& drawing, const CollisionModel& model,
                   const std::set<std::string>& names, bool among) {
  constexpr std::size_t max_labels = 12;
  const Region region(model.arm());
  const std::vector<Obstacle>& obstacles = model.bodies().scene.obstacles;
  std::vector<Label> labels;
  for (const Obstacle& obstacle : obstacles) {
    if (names.contains(obstacle.name) != among) continue;
    std::vector<Vector3> framed;
    std::vector<Solid> solids = solids_of(obstacle.cloud);
    for (const Shape& shape : obstacle.shapes) {
      solids.push_back(solid_of(shape, Pose::Identity(), region));
    }
    for (Solid& solid : solids) {
      solid.fill = with_opacity(sand, obstacle_opacity);
      solid.line = obstacle_line;
      solid.framed = framed_points(solid, region);
      framed.insert(framed.end(), solid.framed.begin(), solid.framed.end());
      drawing.add(Layer::body, std::move(solid));
    }
    if (framed.empty()) continue;
    labels.push_back({mean_of(framed), obstacle.name, obstacle_line, 8});
  }
  if (labels.size() > max_labels) return;
  for (Label& label : labels) drawing.add(Layer::note, std::move(label));
}

void add_link_shapes(Drawing& drawing, const CollisionModel& model, const ConfigurationRef& q,
                     bool is_faded) {
  const Region region(model.arm());
  const std::vector<Pose> links = link_poses(model.arm(), q);
  const auto colour = [&](const Colour& full) { return is_faded ? faded(full) : full; };
  for (const LinkShapes& body : model.bodies().links) {
    for (const Shape& shape : body.shapes) {
      Solid solid = solid_of(shape, links[body.link], region);
      solid.fill = with_opacity(colour(steel), link_opacity);
      solid.line = colour(link_line);
      solid.framed = corners_around(solid);
      solid.shell = true;
      drawing.add(is_faded ? Layer::ghost : Layer::body, std::move(solid));
    }
  }
}

void add_nearest_pair(Drawing& drawing, const BodyDistance& pair, bool label) {
  const Colour colour = keeps_clearance(pair) ? clear_pair : close_pair;
  Polyline line{{pair.on_first, pair.on_second}, colour, 1.8, {}, 0.8, paper_white};
  drawing.add(Layer::mark, std::move(line));
  drawing.add(Layer::mark, Dots{{pair.on_first, pair.on_second}, colour, 4.5});
  if (!label) return;
  drawing.add(Layer::note, Label{(pair.on_first + pair.on_second) / 2,
                                 distance_text(shown_distance(pair)), colour, 9});
}

std::string nearest_text(const BodyDistance& pair) {
  const std::string names = names_text(pair);
  if (pair.lower <= 0) return names + " overlap by " + distance_text(-pair.lower);
  const std::string text = "nearest: " + names + ", " + distance_text(pair.upper) + " apart";
  if (keeps_clearance(pair)) return text;
  return text + "; " + distance_text(pair.clearance) + " are required";
}

ModelsOverTime::ModelsOverTime(std::span<const ProgramScene> scenes) {
  if (scenes.empty()) throw Error("a motion of a program has at least one scene; none is given");
  for (const ProgramScene& scene : scenes) from_.emplace_back(scene.begin, &scene.model);
}

std::set<std::string> ModelsOverTime::still_obstacles() const {
  std::set<std::string> still;
  if (from_.empty()) return still;
  const std::vector<Obstacle>& first = from_.front().second->bodies().scene.obstacles;
  for (const Obstacle& obstacle : first) {
    const bool stands = std::all_of(from_.begin(), from_.end(), [&](const auto& scene) {
      const std::vector<Obstacle>& others = scene.second->bodies().scene.obstacles;
      return std::any_of(others.begin(), others.end(), [&](const Obstacle& other) {
        return other.name == obstacle.name && same_place(other, obstacle);
      });
    });
    if (stands) still.insert(obstacle.name);
  }
  return still;
}

const CollisionModel& ModelsOverTime::at(double time) const {
  const CollisionModel* model = from_.front().second;
  for (const auto& [begin, next] : from_) {
    if (begin <= time) model = next;
  }
  return *model;
}

std::optional<TimedPair> nearest_sample(const ModelsOverTime& models,
                                        const Trajectory& trajectory) {
  constexpr int steps = 200;
  const double begin = trajectory.times.front(), end = trajectory.times.back();
  std::optional<TimedPair> nearest;
  for (int i = 0; i <= steps; ++i) {
    const double time = i == steps ? end : begin + (end - begin) * i / steps;
    const Configuration q = sample(trajectory, time).position;
    const CollisionModel& model = models.at(time);
    if (!has_pairs(model, q)) continue;
    BodyDistance pair = beeline::nearest_pair(model, q);
    const auto excess = [](const BodyDistance& of) { return shown_distance(of) - of.clearance; };
    if (nearest && excess(pair) >= excess(nearest->pair)) continue;
    nearest = TimedPair{time, std::move(pair)};
  }
  return nearest;
}

}  // namespace beeline::internal
