#pragma once

#include <limits>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <beeline/collision/collision_model.h>
#include <beeline/draw/drawing.h>
#include <beeline/planning/program.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// Adds the obstacles of the model to the drawing, the first twelve of a call with their names. The
/// page contains what is within 1.2 times the arm's reach of its base; half-spaces are drawn as
/// slabs there. With `names`, those in it if `among`, else the others.
void add_obstacles(Drawing& drawing, const CollisionModel& model,
                   const std::set<std::string>& names = {}, bool among = false);

/// Adds the shapes of the arm's links at configuration q.
void add_link_shapes(Drawing& drawing, const CollisionModel& model, const ConfigurationRef& q,
                     bool is_faded = false);

/// Adds the line between the nearest points of two bodies, with their distance as a label unless
/// `label` is false: teal if the bodies keep their clearance, red otherwise.
void add_nearest_pair(Drawing& drawing, const BodyDistance& pair, bool label = true);

/// Describes a pair: "nearest: hand and wall, 0.0008 m apart; 0.001 m are required".
std::string nearest_text(const BodyDistance& pair);

/// A pair of bodies at one time of a motion.
struct TimedPair {
  double time = 0;
  BodyDistance pair;
};

/// The arm among obstacles at each time of a motion: none, one model, or the scenes of a program.
/// They must outlive the object.
class ModelsOverTime {
 public:
  ModelsOverTime() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): a model is the same at all times.
  ModelsOverTime(const CollisionModel& model)
      : from_{{-std::numeric_limits<double>::infinity(), &model}} {}
  /// Throws Error for no scenes.
  explicit ModelsOverTime(std::span<const ProgramScene> scenes);

  explicit operator bool() const { return !from_.empty(); }
  /// Whether there is more than one.
  bool change() const { return from_.size() > 1; }
  /// The names of the obstacles that stand in one place at all times.
  std::set<std::string> still_obstacles() const;
  /// The model of a time. Requires one.
  const CollisionModel& at(double time) const;

 private:
  std::vector<std::pair<double, const CollisionModel*>> from_ = {};
};

/// Returns the pair with the least distance beyond its clearance at 201 times of a motion; nothing
/// if no pair counts at any of them.
std::optional<TimedPair> nearest_sample(const ModelsOverTime& models, const Trajectory& trajectory);

}  // namespace beeline::internal
