#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include <beeline/io/text/internal/urdf_file.h>
#include <beeline/io/text/internal/urdf_tree.h>
#include <beeline/io/text/urdf.h>

namespace beeline::internal {

/// The joints of a file beside a chain, held at constant values: those given or, without one, of
/// the first named state that has a value within the limits, or else 0 or the limit next to 0.
/// Mimic joints follow. Without a chain all joints are held.
class HeldJoints {
 public:
  /// `file`, `hold`, values by name, and `states` must outlive this object. Throws Error, whose
  /// argument is "hold", for a name that is not a joint of one degree of freedom beside the chain,
  /// for a mimic joint, and for a value outside the limits.
  HeldJoints(const UrdfFile& file, const std::vector<ChainJoint>& chain,
             const std::map<std::string, double>& hold, std::span<const Srdf::State> states = {});

  /// Returns the pose of the child link in the parent link.
  Pose pose(std::size_t joint) const;

  /// Adds the value of a joint that carries the shape of a link, unless it is fixed. Throws
  /// FileError for a type that URDF does not have, and for a joint that moves with the chain.
  void add_held(std::size_t joint, const std::string& link,
                std::map<std::string, double>& held) const;

  /// Adds the joint that gives the joint its value, itself or the one that it follows, with that
  /// one's value; none for a joint that cannot be held.
  void add_leader(std::size_t joint, std::map<std::string, double>& leaders) const;

  /// Returns the name of the named state from which the joint's value comes; empty: of none.
  std::string state_of(std::size_t joint) const;

 private:
  /// The joint that a joint follows at last, and the joint's value for a value of that one. A joint
  /// that is no mimic joint follows itself.
  struct Leader {
    std::size_t index = 0;
    double multiplier = 1, offset = 0;
  };

  void resolve_leaders();
  void check_hold() const;
  Error unknown_hold(const std::string& name) const;
  double value(std::size_t joint) const;
  /// The named state that gives the value of a joint of one degree of freedom; null: none.
  const Srdf::State* state_for(const UrdfFile::Joint& joint) const;

  const UrdfFile& file_;
  const std::map<std::string, double>& hold_;
  const std::span<const Srdf::State> states_;
  std::vector<bool> on_chain_;
  bool has_chain_ = false;
  std::unordered_map<std::string, std::size_t> joints_;
  std::vector<std::optional<Leader>> leaders_;  ///< of each joint
  std::unordered_set<std::size_t> driving_;     ///< the leaders of the joints on the chain
};

}  // namespace beeline::internal
