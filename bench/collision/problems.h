#pragma once

#include <optional>
#include <random>
#include <string>
#include <vector>

#include <beeline/collision/collision_model.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline::bench {

/// An arm with the shapes of its links.
struct ShapedArm {
  std::string file;  ///< path of its URDF file
  Arm arm;
  std::vector<LinkShapes> links;
};

/// Reads an arm and its shapes from a URDF file, whose meshes are below a folder above it. The
/// fingers of a Panda are held at 0.065 m, as the requests of MotionBenchMaker say.
ShapedArm read_shaped_arm(const std::string& path);

/// A scene with configurations in it.
struct Problem {
  std::string name;
  Scene scene;  ///< with the allowed pairs of the arm's links
  std::vector<Configuration> configurations;
  std::optional<Configuration> start = std::nullopt;  ///< from which they are to be reached
};

/// Reads the problems of MotionBenchMaker below a folder: `KIND/sceneNNNN.yaml`, whose boxes and
/// cylinders become obstacles, and `KIND/requestNNNN.yaml`, whose goal is the configuration.
std::vector<Problem> read_problems(const std::string& folder, const ShapedArm& arm);

/// Problems of random boxes around an arm, without configurations.
std::vector<Problem> random_problems(std::size_t count, std::size_t boxes, std::mt19937_64& engine);

/// A straight joint motion of two samples, 1 s.
struct Edge {
  Configuration from, to;

  Configuration at(double s) const { return from + s * (to - from); }
  Trajectory motion(const Arm& arm) const {
    return {arm.joint_names(), {0, 1}, {from, to}, {}, {}};
  }
};

/// Returns an edge of length 1 (rad) within the limits from a configuration in a random direction.
/// Throws Error if no direction is found.
Edge edge_from(const Arm& arm, const Configuration& from, std::mt19937_64& engine);

/// Edges of one problem: `count` of them from random configurations that keep the clearance, and
/// `count` from the problem's own configurations.
std::vector<Edge> edges_of(const CollisionModel& model, const Problem& problem, std::size_t count,
                           std::mt19937_64& engine);

}  // namespace beeline::bench
