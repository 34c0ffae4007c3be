#include <beeline/draw/arm_figure.h>
#include <beeline/draw/internal/annotation.h>
#include <beeline/draw/internal/arm_scene.h>
#include <beeline/draw/internal/trail.h>
#include <beeline/error.h>

namespace beeline {
using namespace internal;
namespace {

Figure views_of(Scene scene, const Arm& arm, const std::string& caption,
                const ArmFigureOptions& options) {
  Figure figure;
  figure.title = options.title.empty() ? arm.name() : options.title;
  Panel main{.scene = std::move(scene), .caption = caption};
  if (arm.planar()) {
    figure.columns = {{std::move(main)}};
    return figure;
  }
  main.view = oblique_view(options.azimuth, options.elevation);
  figure.columns = {{main}};
  if (!options.small_views) return figure;
  Panel above{.scene = main.scene, .zoom = 0.5, .pen = 0.6, .labels = false};
  Panel beside = above;
  above.view = top_view();
  beside.view = front_view();
  figure.columns.push_back({std::move(above), std::move(beside)});
  figure.width = 560;
  return figure;
}

void add_numbered(Scene& scene, const std::vector<Pose>& waypoints) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < waypoints.size(); ++i) names.push_back(std::to_string(i + 1));
  add_poses(scene, waypoints, names);
}

}  // namespace

Figure arm_figure(const Arm& arm, const ConfigurationRef& q, const ArmFigureOptions& options) {
  Scene scene;
  add_arm(scene, arm, q, {.frames = options.frames, .tool = !options.jacobian});
  if (options.jacobian) {
    add_jacobian_arrows(scene, arm, q, jacobian_arrow_scale(arm, q), arm.planar());
  }
  const std::string caption =
      options.caption.empty() ? "tool at " + tool_text(arm, q) : options.caption;
  return views_of(std::move(scene), arm, caption, options);
}

Figure motion_figure(const Arm& arm, const std::vector<Configuration>& motion,
                     const std::vector<Pose>& waypoints, const ArmFigureOptions& options) {
  if (motion.empty()) throw Error("a motion without samples cannot be drawn");
  const std::vector<Vector3> tool = tool_positions(arm, motion);
  Scene scene;
  for (const std::size_t i : evenly_along(tool, options.ghosts)) {
    add_arm(scene, arm, motion[i], {.faded = true});
  }
  add_arm(scene, arm, motion.back(),
          {.frames = options.frames, .tool = waypoints.empty() && !options.jacobian});
  add_trail(scene, tool, options.max_dots);
  add_numbered(scene, waypoints);
  if (options.jacobian) {
    add_jacobian_arrows(scene, arm, motion.back(), jacobian_arrow_scale(arm, motion.back()));
  }
  const std::string caption =
      options.caption.empty()
          ? "tool from " + tool_text(arm, motion.front()) + " to " + tool_text(arm, motion.back())
          : options.caption;
  return views_of(std::move(scene), arm, caption, options);
}

}  // namespace beeline
