#pragma once

#include <optional>
#include <vector>

#include <beeline/collision/collision_model.h>
#include <beeline/planning/program.h>

namespace beeline::internal {

/// Whether a program attaches or detaches a part after this number of moves.
bool has_change(const Program& program, std::size_t moves);

/// The obstacles of a scene of which the tool carries some, in the order of a program.
class CarriedParts {
 public:
  /// Before the first attachment. Both arguments must outlive the object.
  CarriedParts(const CollisionModel& model, const Program& program);

  /// Attaches and detaches what the program says after this number of moves, at a configuration.
  void change(std::size_t moves, const ConfigurationRef& q);

  /// The attachments that the last change() began or ended.
  const std::vector<std::size_t>& changed() const { return changed_; }

  /// The pose of an attached part's first shape in the tool.
  Pose pose_in_tool(std::size_t attachment) const;

  /// The arm with the parts that it carries, among the other obstacles.
  CollisionModel model() const;

 private:
  void attach(std::size_t attachment, const ConfigurationRef& q);
  void detach(std::size_t attachment, const ConfigurationRef& q);

  const CollisionModel& model_;
  const Program& program_;
  Scene scene_;  ///< obstacles where they are or, if carried, in the last link
  std::vector<std::optional<std::size_t>> carried_by_;  ///< attachment of each obstacle
  std::vector<std::size_t> obstacles_;                  ///< of each attachment
  std::vector<std::size_t> changed_ = {};
};

}  // namespace beeline::internal
