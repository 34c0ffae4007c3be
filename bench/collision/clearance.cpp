// Times the certified check of a Panda's motions among obstacles: a line of 1 m with self-collision
// by the number of obstacles, the clearance, the margin and the vertices of hulls, and edges of
// 1 rad, beside the same edges sampled by the same distances. Prints tables in Markdown;
// microseconds of CPU on one core, medians; the model's preparation apart. Fails if a proof
// allocates memory that a proof before it has left. Usage: bench_clearance [EDGES]
#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include <beeline/certificate/clearance.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/planning/move_along.h>

#include "../inverse/timing.h"
#include "random.h"

#include <tests/allocations.h>

namespace beeline::bench {
namespace {

/// A capsule from the origin of a frame to a point.
Shape capsule_to(const Vector3& end, double radius) {
  Shape shape{Capsule{radius, end.norm()}};
  shape.pose.translation() = end / 2;
  shape.pose.linear() =
      Eigen::Quaterniond::FromTwoVectors(Vector3::UnitZ(), end).toRotationMatrix();
  return shape;
}

/// Points on the surface of a capsule of the same size, as a hull.
Shape hull_of(const Shape& capsule, int vertices, Engine& engine) {
  const auto& body = std::get<Capsule>(capsule.body);
  ConvexHull hull;
  for (int i = 0; i < vertices; ++i) {
    const Vector3 n = direction(engine);
    hull.vertices.emplace_back(body.radius * n +
                               Vector3(0, 0, (n.z() < 0 ? -0.5 : 0.5) * body.length));
  }
  return {hull, capsule.pose};
}

/// A Panda with one capsule, or one hull, on each link and a box as its hand.
struct Robot {
  Arm arm = built_in("panda");
  std::vector<LinkShapes> links = {};

  explicit Robot(int vertices = 0) {
    Engine engine(1);
    const std::vector<Pose> poses = link_poses(arm, Configuration::Zero(7));
    for (std::size_t i = 0; i <= 6; ++i) {
      Vector3 end = poses[i].inverse() * poses[i + 1].translation();
      if (end.norm() < 0.02) end = Vector3(0, i % 2 == 0 ? 0.08 : -0.08, 0);
      Shape shape = capsule_to(end, 0.055);
      if (vertices > 0) shape = hull_of(shape, vertices, engine);
      links.push_back({"link" + std::to_string(i), i, {shape}});
    }
    links.push_back({"hand", 7, {{Box{{0.06, 0.2, 0.08}}, make_pose({0, 0, 0.16})}}});
  }

  /// The capsules of links that are two apart overlap at the joints between.
  CollisionModel among(const Scene& scene, double clearance) const {
    CollisionOptions options{.clearance = clearance};
    for (std::size_t i = 2; i < links.size(); ++i) {
      options.allowed_pairs.push_back({links[i].name, links[i - 2].name});
    }
    return {arm, links, scene, options};
  }
};

/// A line of 1 m, at most as quick as the limits allow.
Trajectory line_of_one_metre(const Arm& arm) {
  Pose from = make_pose({0.45, -0.5, 0.45}, so3_exp(Vector3(std::acos(-1.0), 0, 0)));
  Pose to = from;
  to.translation().y() = 0.5;
  const PathMotion motion = move_in_lines(arm, {from, to}, {.profile = Profile::quintic});
  if (motion.status != MotionStatus::reached) {
    throw Error("the line cannot be planned: " + sentence(motion.reason));
  }
  return motion.trajectory;
}

/// Boxes around the arm that keep `gap` from a motion.
Scene boxes(const Robot& robot, const Trajectory& motion, std::size_t count, double gap,
            Engine& engine) {
  const double spread = std::max(1.0, std::cbrt(static_cast<double>(count) / 1000.0));
  Scene scene;
  while (scene.obstacles.size() < count) {
    Shape shape{
        Box{{uniform(engine, 0.02, 0.1), uniform(engine, 0.02, 0.1), uniform(engine, 0.02, 0.1)}}};
    shape.pose = make_pose({uniform(engine, -spread, spread), uniform(engine, -spread, spread),
                            uniform(engine, 0, spread)},
                           so3_exp(direction(engine) * uniform(engine, 0, 3)));
    const Obstacle obstacle{"box" + std::to_string(scene.obstacles.size()), {shape}};
    const CollisionModel model(
        robot.arm, robot.links, {.obstacles = {obstacle}},
        {.clearance = gap, .self_collision = false, .budget = {.max_work = 0}});
    if (prove_clearance(model, motion)) scene.obstacles.push_back(obstacle);
  }
  return scene;
}

/// Median CPU time of a call, microseconds.
template <class Call>
double median_time(const Call& call) {
  constexpr int passes = 25;
  std::vector<double> times;
  const double before = cpu_microseconds();
  call();
  const double once = cpu_microseconds() - before;
  const int repetitions = std::max(1, static_cast<int>(2000 / std::max(once, 1.0)));
  for (int pass = 0; pass < passes; ++pass) {
    const double start = cpu_microseconds();
    for (int i = 0; i < repetitions; ++i) call();
    times.push_back((cpu_microseconds() - start) / repetitions);
  }
  std::nth_element(times.begin(), times.begin() + passes / 2, times.end());
  return times[passes / 2];
}

void print_proof(const CollisionModel& model, const Trajectory& motion) {
  const ClearanceProof proof = prove_clearance(model, motion);
  const double time = median_time([&] { prove_clearance(model, motion); });
  std::printf(" %s | %zu | %.1f |\n", name(proof.status).c_str(), proof.parts, time);
}

/// Returns the scene with 100 boxes, and prints the table by the number of obstacles.
Scene by_obstacles(const Robot& robot, const Trajectory& line) {
  std::printf("| obstacles | model, ms | answer | parts | µs |\n|---|---|---|---|---|\n");
  Scene hundred;
  for (const std::size_t count : {1U, 10U, 100U, 1000U, 10000U}) {
    Engine engine(count);
    const Scene scene = boxes(robot, line, count, 0.02, engine);
    if (count == 100) hundred = scene;
    const double start = cpu_microseconds();
    const CollisionModel model = robot.among(scene, 5e-3);
    std::printf("| %zu | %.1f |", count, 1e-3 * (cpu_microseconds() - start));
    print_proof(model, line);
  }
  return hundred;
}

void by_clearance(const Robot& robot, const Trajectory& line, const Scene& scene) {
  std::printf("\n| clearance, mm, 100 boxes at 20 | answer | parts | µs |\n|---|---|---|---|\n");
  for (const double clearance : {0.01, 0.1, 1.0, 5.0, 15.0}) {
    std::printf("| %g |", clearance);
    print_proof(robot.among(scene, 1e-3 * clearance), line);
  }
}

/// Whether a proof allocates memory that the thread's proofs before could have left.
bool allocates_again(const Robot& robot, const Trajectory& line, const Scene& scene) {
  const CollisionModel model = robot.among(scene, 5e-3);
  const double least = prove_clearance(model, line, {.closest = true}).pair.upper;
  const auto counted = [&](const CollisionModel& among) {
    const long before = allocations;
    const ClearanceProof proof = prove_clearance(among, line);
    return std::pair(allocations - before, proof.parts);
  };
  const auto [few, few_parts] = counted(model);
  const auto [more, more_parts] = counted(robot.among(scene, 5e-3 + 0.999 * (least - 5e-3)));
  std::printf("\nAllocations: %ld for %zu parts, %ld for %zu parts.\n", few, few_parts, more,
              more_parts);
  return few + more > 0;
}

/// A plate below the hand, which the line passes at the clearance and a margin.
void by_margin(const Robot& robot, const Trajectory& line) {
  std::printf(
      "\n| margin above a clearance of 5 mm, mm | answer | parts | µs |\n|---|---|---|---|\n");
  constexpr double clearance = 5e-3;
  const auto plate = [&](double height) {
    return Scene{
        .obstacles = {{"plate", {{Box{{0.8, 2, 0.1}}, make_pose({0.75, 0, height - 0.05})}}}}};
  };
  const auto keeps = [&](double height, double distance) {
    return bool(prove_clearance(
        CollisionModel(robot.arm, {robot.links.back()}, plate(height), {.clearance = distance}),
        line, {.resolution = 1e-6}));
  };
  double low = 0, high = 0.45;  // the height that leaves the clearance
  for (int i = 0; i < 40; ++i) (keeps((low + high) / 2, clearance) ? low : high) = (low + high) / 2;
  for (const double margin : {50.0, 5.0, 1.0, 0.2, 0.05, -0.05, -1.0}) {
    const CollisionModel model = robot.among(plate(low - 1e-3 * margin), clearance);
    std::printf("| %g |", margin);
    print_proof(model, line);
  }
}

void by_vertices(const Trajectory& line) {
  std::printf(
      "\n| vertices of a link's hull, 100 boxes | answer | parts | µs |\n|---|---|---|---|\n");
  for (const int vertices : {0, 8, 20, 50, 100, 200, 500}) {
    const Robot robot(vertices);
    Engine engine(7);
    const CollisionModel model = robot.among(boxes(robot, line, 100, 0.02, engine), 5e-3);
    std::printf("| %s |", vertices == 0 ? "capsules" : std::to_string(vertices).c_str());
    print_proof(model, line);
  }
}

/// Edges of 1 rad between random configurations, each a motion of two samples.
void edges(const Robot& robot, int count) {
  std::printf(
      "\n| obstacles | clear | collide | not decided | µs an edge | edges a second | "
      "sampled each 0.05 rad, µs | missed by samples |\n|---|---|---|---|---|---|---|---|\n");
  for (const std::size_t obstacles : {10U, 100U, 1000U}) {
    Engine engine(obstacles);
    Trajectory home = at_rest(robot.arm, middle_configuration(robot.arm));
    const CollisionModel model = robot.among(boxes(robot, home, obstacles, 0.05, engine), 1e-3);
    std::vector<Trajectory> motions;
    while (static_cast<int>(motions.size()) < count) {
      const Configuration from = random_configuration(robot.arm, engine);
      const Configuration step = (random_configuration(robot.arm, engine) - from).normalized();
      if (!pairs_too_close(model, from).empty()) continue;
      if (!limit_violations(robot.arm, from + step).empty()) continue;
      motions.push_back({robot.arm.joint_names(), {0, 1}, {from, from + step}, {}, {}});
    }
    int answers[3] = {}, missed = 0;
    std::size_t next = 0;
    const double proved =
        median_time([&] { prove_clearance(model, motions[next++ % motions.size()]); });
    const auto is_free = [&](const Trajectory& motion) {
      for (int i = 0; i <= 20; ++i) {
        const Configuration q =
            motion.positions[0] + i / 20.0 * (motion.positions[1] - motion.positions[0]);
        if (nearest_pair(model, q).lower < 1e-3) return false;
      }
      return true;
    };
    const double sampled = median_time([&] { is_free(motions[next++ % motions.size()]); });
    for (const Trajectory& motion : motions) {
      const ClearanceProof proof = prove_clearance(model, motion);
      ++answers[static_cast<int>(proof.status)];
      if (proof.status == ClearanceStatus::collides && is_free(motion)) ++missed;
    }
    std::printf("| %zu | %d | %d | %d | %.1f | %.0f | %.1f | %d |\n", obstacles, answers[0],
                answers[1], answers[2], proved, 1e6 / proved, sampled, missed);
  }
}

}  // namespace
}  // namespace beeline::bench

int main(int argc, char** argv) {
  using namespace beeline::bench;
  const int count = argc > 1 ? std::max(1, std::atoi(argv[1])) : 1000;
  stay_on_one_core();
  const Robot robot;
  const beeline::Trajectory line = line_of_one_metre(robot.arm);
  std::printf("The line has %zu samples.\n\n", line.size());
  const beeline::Scene hundred = by_obstacles(robot, line);
  by_clearance(robot, line, hundred);
  by_margin(robot, line);
  by_vertices(line);
  edges(robot, count);
  return BEELINE_COUNTS_ALLOCATIONS && allocates_again(robot, line, hundred) ? 1 : 0;
}
