#include <algorithm>
#include <cmath>

#include <beeline/collision/internal/nearest_pair.h>
#include <beeline/draw/arm_figure.h>
#include <beeline/draw/internal/animation_frames.h>
#include <beeline/draw/internal/annotation.h>
#include <beeline/draw/internal/arm_drawing.h>
#include <beeline/draw/internal/scene_drawing.h>
#include <beeline/draw/internal/text.h>
#include <beeline/draw/internal/trail.h>
#include <beeline/error.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/kinematics/manipulability.h>

namespace beeline {
using namespace internal;
namespace {

Figure views_of(Drawing drawing, const Arm& arm, const std::string& caption,
                const ArmFigureOptions& options) {
  Figure figure;
  figure.title = options.title.empty() ? arm.name() : options.title;
  Panel main{.drawing = std::move(drawing), .caption = caption};
  if (arm.planar()) {
    figure.columns = {{std::move(main)}};
    return figure;
  }
  main.view = oblique_view(options.azimuth, options.elevation);
  figure.columns = {{main}};
  if (!options.small_views) return figure;
  Panel above{.drawing = main.drawing, .zoom = 0.5, .pen = 0.6, .labels = false};
  Panel beside = above;
  above.view = top_view();
  beside.view = front_view();
  figure.columns.push_back({std::move(above), std::move(beside)});
  figure.width = 560;
  return figure;
}

/// Returns the depth of the lowest joint or of the tool below the plane of the base, metres; 0 for
/// an arm that does not stand on it.
double depth_below_base(const Arm& arm, const Trajectory& trajectory) {
  if (!stands_upright(arm)) return 0;
  const double floor = arm.base().translation().z();
  double lowest = floor;
  for (const Vector3& p : tool_trail(arm, trajectory).points) lowest = std::min(lowest, p.z());
  constexpr int steps = 500;
  const double begin = trajectory.times.front(), duration = trajectory.times.back() - begin;
  for (int k = 0; k <= steps; ++k) {
    const Configuration q = sample(trajectory, begin + duration * k / steps).position;
    for (const SkeletonJoint& joint : skeleton(arm, q).joints) {
      lowest = std::min(lowest, joint.centre.z());
    }
  }
  const double depth = floor - lowest;
  return depth > 1e-6 * (1 + std::abs(floor)) ? depth : 0;
}

std::string motion_caption(const Arm& arm, const Trajectory& trajectory) {
  std::string caption = "tool from " + tool_text(arm, trajectory.positions.front()) + " to " +
                        tool_text(arm, trajectory.positions.back());
  const double depth = depth_below_base(arm, trajectory);
  if (depth > 0) {
    const int decimals = std::clamp(static_cast<int>(std::floor(3 - std::log10(depth))), 0, 9);
    caption += "\nup to " + fixed(depth, decimals) + " m below the plane of the base";
  }
  return caption;
}

constexpr int max_ghosts = 1000;
constexpr std::size_t max_dots = 100'000;

/// Returns the trajectory with its columns in the arm's order.
Trajectory checked(const Arm& arm, const Trajectory& trajectory, const ArmFigureOptions& options) {
  if (options.ghosts < 0 || options.ghosts > max_ghosts) {
    throw Error("ghosts " + std::to_string(options.ghosts) + " is outside 0 to " +
                std::to_string(max_ghosts));
  }
  if (options.dots > max_dots) {
    throw Error("dots " + std::to_string(options.dots) + " is above " + std::to_string(max_dots));
  }
  if (trajectory.times.empty()) throw Error("a motion without samples cannot be drawn");
  return matched_to(arm, trajectory);
}

/// Returns the inverse condition number of the task's Jacobian, or a tenth of it if a joint or the
/// tool is below the base: along z, or along y for a planar arm.
double visibility(const Arm& arm, const Configuration& q) {
  const Eigen::MatrixXd j = task_jacobian(arm, q, default_task(arm), unit_of_length(arm));
  const double inverse_condition = 1 / manipulability_measures(j).condition;
  const Skeleton bones = skeleton(arm, q);
  const int up = arm.planar() ? 1 : 2;
  double lowest = bones.tool[up];
  for (const SkeletonJoint& joint : bones.joints) lowest = std::min(lowest, joint.centre[up]);
  return lowest < bones.base[up] - 1e-9 ? 0.1 * inverse_condition : inverse_condition;
}

/// Returns element i of the van der Corput sequence in a base, in [0, 1).
double van_der_corput(int i, int base) {
  double value = 0, digit = 1;
  for (; i > 0; i /= base) value += (digit /= base) * (i % base);
  return value;
}

/// The arm at q, among the obstacles of `model` unless it is null.
Figure configuration_figure(const Arm& arm, const CollisionModel* model, const ConfigurationRef& q,
                            const ArmFigureOptions& options) {
  Drawing drawing;
  add_arm(drawing, arm, q,
          {.frames = options.frames, .tool = !options.jacobian, .thin = model != nullptr});
  std::string caption = "tool at " + tool_text(arm, q);
  if (model != nullptr) {
    add_obstacles(drawing, *model);
    add_link_shapes(drawing, *model, q);
    if (has_pairs(*model, q)) {
      const BodyDistance nearest = beeline::nearest_pair(*model, q);
      add_nearest_pair(drawing, nearest);
      caption += "\n" + nearest_text(nearest);
    }
  }
  if (options.jacobian) {
    add_jacobian_arrows(drawing, arm, q, jacobian_arrow_scale(arm, q), arm.planar());
  }
  if (!options.caption.empty()) caption = options.caption;
  return views_of(std::move(drawing), arm, caption, options);
}

/// Adds the obstacles, the shapes of the links at the end and at the closest approach, and the
/// nearest pair there. Returns its description.
std::string add_scene_of_motion(Drawing& drawing, const ModelsOverTime& models,
                                const Trajectory& trajectory) {
  const CollisionModel& last = models.at(trajectory.times.back());
  add_obstacles(drawing, last);
  add_link_shapes(drawing, last, trajectory.positions.back());
  const std::optional<TimedPair> nearest = nearest_sample(models, trajectory);
  if (!nearest) return "";
  if (nearest->time != trajectory.times.back()) {
    const Configuration q = sample(trajectory, nearest->time).position;
    const CollisionModel& model = models.at(nearest->time);
    add_arm(drawing, model.arm(), q, {.faded = true, .thin = true});
    add_link_shapes(drawing, model, q, true);
  }
  add_nearest_pair(drawing, nearest->pair);
  return "\n" + nearest_text(nearest->pair) + ", at " + number(nearest->time) + " s";
}

Figure still_motion(const Arm& arm, const ModelsOverTime& models, const Trajectory& given,
                    const std::vector<Pose>& waypoints, const ArmFigureOptions& options) {
  const Trajectory trajectory = checked(arm, given, options);
  const Configuration& end = trajectory.positions.back();
  const bool thin = static_cast<bool>(models);
  Drawing drawing;
  for (const double t : times_evenly_along(tool_trail(arm, trajectory), options.ghosts)) {
    add_arm(drawing, arm, sample(trajectory, t).position, {.faded = true, .thin = thin});
  }
  add_arm(drawing, arm, end,
          {.frames = options.frames, .tool = waypoints.empty() && !options.jacobian, .thin = thin});
  std::string caption = motion_caption(arm, trajectory);
  if (models) caption += add_scene_of_motion(drawing, models, trajectory);
  add_trail(drawing, arm, trajectory, {.dots = options.dots});
  add_poses(drawing, waypoints);
  if (options.jacobian) add_jacobian_arrows(drawing, arm, end, jacobian_arrow_scale(arm, end));
  if (!options.caption.empty()) caption = options.caption;
  return views_of(std::move(drawing), arm, caption, options);
}

Animation moving_arm(const Arm& arm, const ModelsOverTime& models, const Trajectory& given,
                     const std::vector<Pose>& waypoints, const ArmFigureOptions& options) {
  const Trajectory trajectory = checked(arm, given, options);
  const bool thin = static_cast<bool>(models);
  Drawing drawing;
  if (options.ghosts > 0)
    add_arm(drawing, arm, trajectory.positions.front(), {.faded = true, .thin = thin});
  const std::set<std::string> still = models.still_obstacles();
  if (models) add_obstacles(drawing, models.at(trajectory.times.front()), still, true);
  add_trail(drawing, arm, trajectory, {.dots = options.dots, .growing = true});
  add_poses(drawing, waypoints);
  double arrow_scale = 0;
  const auto draw = [&](Drawing& frame, double time, const Configuration& q) {
    add_arm(frame, arm, q, {.frames = options.frames, .tool = !options.jacobian, .thin = thin});
    if (models) {
      const CollisionModel& model = models.at(time);
      add_obstacles(frame, model, still);
      add_link_shapes(frame, model, q);
      if (has_pairs(model, q)) add_nearest_pair(frame, beeline::nearest_pair(model, q), false);
    }
    if (!options.jacobian) return;
    if (arrow_scale == 0) arrow_scale = jacobian_arrow_scale(arm, q);
    add_jacobian_arrows(frame, arm, q, arrow_scale);
  };
  Animation animation = motion_frames(trajectory, draw);
  const std::string caption =
      options.caption.empty() ? motion_caption(arm, trajectory) : options.caption;
  animation.figure = views_of(std::move(drawing), arm, caption, options);
  return animation;
}

}  // namespace

Configuration display_configuration(const Arm& arm) {
  constexpr double singular = 0.02;  // inverse condition number of a singular configuration
  constexpr double widest = 1.3;     // max distance from the middle, radians or units of length
  constexpr int candidates = 200, bases[] = {2, 3, 5, 7, 11, 13, 17};
  const Configuration middle = middle_configuration(arm);
  Configuration best = middle;
  double largest = visibility(arm, middle);
  if (largest >= singular) return middle;
  for (int i = 1; i <= candidates; ++i) {  // Halton's points
    Configuration q = middle;
    for (int k = 0; k < arm.dof(); ++k) {
      const Limits& limits = arm.limits(static_cast<std::size_t>(k));
      const bool slides = kind(arm.joint_of(k)) == JointKind::prismatic;
      const double most = slides ? widest * unit_of_length(arm) : widest;
      const double half = std::min(most, 0.7 * (limits.upper / 2 - limits.lower / 2));
      q[k] += half * (2 * van_der_corput(i + k / 7, bases[k % 7]) - 1);
      q[k] = std::clamp(q[k], limits.lower, limits.upper);
    }
    const double found = visibility(arm, q);
    if (found <= 1.0001 * largest) continue;  // rounding must not decide the choice
    largest = found;
    best = q;
  }
  return best;
}

Figure arm_figure(const Arm& arm, const ConfigurationRef& q, const ArmFigureOptions& options) {
  return configuration_figure(arm, nullptr, q, options);
}

Figure arm_figure(const CollisionModel& model, const ConfigurationRef& q,
                  const ArmFigureOptions& options) {
  return configuration_figure(model.arm(), &model, q, options);
}

Figure motion_figure(const Arm& arm, const Trajectory& trajectory,
                     const std::vector<Pose>& waypoints, const ArmFigureOptions& options) {
  return still_motion(arm, {}, trajectory, waypoints, options);
}

Figure motion_figure(const CollisionModel& model, const Trajectory& trajectory,
                     const std::vector<Pose>& waypoints, const ArmFigureOptions& options) {
  return still_motion(model.arm(), model, trajectory, waypoints, options);
}

Figure motion_figure(std::span<const ProgramScene> scenes, const Trajectory& trajectory,
                     const std::vector<Pose>& waypoints, const ArmFigureOptions& options) {
  const ModelsOverTime models(scenes);
  return still_motion(scenes.front().model.arm(), models, trajectory, waypoints, options);
}

Animation motion_animation(const Arm& arm, const Trajectory& trajectory,
                           const std::vector<Pose>& waypoints, const ArmFigureOptions& options) {
  return moving_arm(arm, {}, trajectory, waypoints, options);
}

Animation motion_animation(const CollisionModel& model, const Trajectory& trajectory,
                           const std::vector<Pose>& waypoints, const ArmFigureOptions& options) {
  return moving_arm(model.arm(), model, trajectory, waypoints, options);
}

Animation motion_animation(std::span<const ProgramScene> scenes, const Trajectory& trajectory,
                           const std::vector<Pose>& waypoints, const ArmFigureOptions& options) {
  const ModelsOverTime models(scenes);
  return moving_arm(scenes.front().model.arm(), models, trajectory, waypoints, options);
}

}  // namespace beeline
