// Distances of random pairs of every two kinds of shapes: coal's figure beside the two bounds that
// nearest_pair() proves. Prints a table in Markdown. Usage: bench_distances [PAIRS]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <beeline/collision/collision_model.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>

#include "coal_scene.h"
#include "random.h"

namespace beeline::bench {
namespace {

/// A shape of a kind, 2 cm to 1 m large, about the origin.
Shape random_shape(std::size_t kind, Engine& engine) {
  const auto size = [&] { return uniform(engine, 0.02, 0.5); };
  Shape shape;
  switch (kind) {
    case 0:
      shape.body = Sphere{size()};
      break;
    case 1:
      shape.body = Capsule{size() / 2, size()};
      break;
    case 2:
      shape.body = Box{{size(), size(), size()}};
      break;
    case 3:
      shape.body = Cylinder{size() / 2, size()};
      break;
    case 4:
      shape.body = HalfSpace();
      break;
    default: {
      ConvexHull hull;
      const Vector3 axes(size(), size(), size());
      const int vertices = std::uniform_int_distribution<int>(8, 100)(engine);
      for (int i = 0; i < vertices; ++i) {
        hull.vertices.emplace_back(axes.cwiseProduct(direction(engine)));
      }
      shape.body = hull;
    }
  }
  shape.pose.linear() = so3_exp(Vector3(direction(engine) * uniform(engine, 0, 3)));
  return shape;
}

/// The bounds that are proved: the first shape is on a link, the second is an obstacle.
BodyDistance bounds(const Arm& arm, const Pose& link, const Shape& first, const Shape& second) {
  Shape carried = first;
  carried.pose = link.inverse() * first.pose;
  const CollisionModel model(arm, {{"first", 1, {carried}}}, {.obstacles = {{"second", {second}}}},
                             {.self_collision = false});
  return nearest_pair(model, Configuration::Zero(arm.dof()));
}

/// By how much a figure is beyond a bound, for the pairs for which it is.
struct Excess {
  std::vector<double> values;

  void add(double value) {
    if (value > 0) values.push_back(value);
  }
  void print() {
    if (values.empty()) {
      std::printf(" 0 | | |");
      return;
    }
    std::sort(values.begin(), values.end());
    std::printf(" %zu | %.1e | %.1e |", values.size(), values[values.size() / 2], values.back());
  }
};

void compare(std::size_t first_kind, std::size_t second_kind, int pairs, Engine& engine) {
  const Arm arm = built_in("rp");
  const Pose link = link_poses(arm, Configuration::Zero(arm.dof()))[1];
  Excess above, below, depth;
  std::vector<double> widths;
  int overlaps = 0;
  std::string names;
  for (int i = 0; i < pairs; ++i) {
    const Shape first = random_shape(first_kind, engine);
    Shape second = random_shape(second_kind, engine);
    names = kind_name(first) + ", " + kind_name(second);
    // The second is moved so that about the wanted distance remains; one in four overlaps.
    const bool is_flat = kind_name(second) == "half_space";
    const Vector3 n = is_flat ? Vector3(-second.pose.linear().col(2)) : direction(engine);
    second.pose.translation() = 3 * n;
    const BodyDistance far = bounds(arm, link, first, second);
    const double wanted =
        i % 4 == 0 ? -uniform(engine, 0, 0.1) : std::pow(10, uniform(engine, -6, 0));
    second.pose.translation() -= (far.lower - wanted) * far.normal;
    const BodyDistance proved = bounds(arm, link, first, second);
    const double found = coal_distance(first, second);
    if (!std::isfinite(found)) throw Error("coal's distance is not finite");
    if (proved.lower > 0) {
      above.add(found - proved.upper);
      below.add(proved.lower - found);
      widths.push_back(proved.upper - proved.lower);
    } else {
      ++overlaps;
      depth.add(proved.lower - found);
    }
  }
  std::sort(widths.begin(), widths.end());
  std::printf("| %s | %zu | %.1e, %.1e |", names.c_str(), widths.size(), widths[widths.size() / 2],
              widths.back());
  above.print();
  below.print();
  std::printf(" %d |", overlaps);
  depth.print();
  std::printf("\n");
}

}  // namespace
}  // namespace beeline::bench

int main(int argc, char** argv) {
  using namespace beeline::bench;
  if (!has_coal()) {
    std::printf("Left out: coal, whose wheel is not installed.\n");
    return 0;
  }
  const int pairs = argc > 1 ? std::max(8, std::atoi(argv[1])) : 2000;
  Engine engine(1);
  std::printf(
      "Metres, seed 1. Apart: more than proved (coal - upper bound), less than proved (lower "
      "bound - coal). Overlap: a translation proved to separate is shorter than coal's "
      "depth.\n\n"
      "| kinds | apart | width of the bounds: median, worst | coal more | median | worst | "
      "coal less | median | worst | overlap | coal deeper | median | worst |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const std::size_t first : {0U, 1U, 2U, 3U, 5U}) {
    for (const std::size_t second : {0U, 1U, 2U, 3U, 4U, 5U}) {
      if (second >= first || second == 4) compare(first, second, pairs, engine);
    }
  }
  return 0;
}
