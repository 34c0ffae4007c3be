#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include <beeline/io/text/internal/urdf_file.h>

namespace beeline::internal {

/// A joint on the way from a base to a tip.
struct ChainJoint {
  std::size_t index = 0;  ///< in `UrdfFile::joints`
  bool reversed = false;  ///< passed from the child link to the parent link

  bool operator==(const ChainJoint&) const = default;
};

/// The tree of links, given as indices into `file.links`. Every link except a root has one parent
/// joint. A joint that would break the tree is left out and recorded as a fault: its parent or its
/// child is not a link of the file, its child has a parent joint already, or it closes a cycle. A
/// link whose only parent joint is left out is an orphan: a root that is no base unless it is
/// named.
class UrdfTree {
 public:
  /// `file` must outlive this object. Throws FileError for a file without links.
  explicit UrdfTree(const UrdfFile& file);

  const UrdfFile& file() const { return file_; }

  /// The faults of the file and of its tree.
  const std::vector<UrdfFault>& faults() const { return faults_; }

  /// Returns the link called `name` or, if that is empty, the root. Throws FileError for an unknown
  /// name, and for several roots.
  std::size_t base(const std::string& name) const;

  /// The selected tip and the kind of the warning about this choice; none if there was no choice.
  struct Tip {
    std::size_t link = 0;
    std::optional<ReadWarningKind> choice = {};
    std::vector<std::string> others = {};
  };

  /// Returns the link called `name` or, if that is empty, an end of the tree that a joint moves.
  /// Throws FileError for an unknown name, and for several ends without a choice.
  Tip tip(const std::string& name, std::size_t base) const;

  /// Returns the joints from the base to the tip, in this order. Throws FileError if they are not
  /// connected.
  std::vector<ChainJoint> chain(std::size_t base, std::size_t tip) const;

  /// Returns the first fault that is more than ignored text; null if there is none.
  const UrdfFault* first_fault() const;

  /// Returns the first fault of a joint or a link of a chain of this tree; null if there is none.
  const UrdfFault* first_fault_on(const std::vector<ChainJoint>& chain) const;

  /// Returns the ends of the chain down the tree that has these joints: indices into `file.joints`,
  /// in any order. Fixed joints on other branches are ignored. Throws FileError for a joint that
  /// was left out. Throws Error, a clause without a subject, when there is no such chain: joints
  /// with one degree of freedom on two branches, or, mimic joints aside, one between the ends that
  /// is not among them.
  ChainEnds ends_of(const std::vector<std::size_t>& joints) const;

 private:
  using Indices = std::vector<std::size_t>;

  /// An end of the tree, and the link that leads it: links of one body are connected by fixed
  /// joints.
  struct End {
    std::size_t link, body;
  };

  enum class Way { down, any };
  static constexpr std::size_t no_joint = static_cast<std::size_t>(-1);
  static constexpr std::size_t no_cycle = static_cast<std::size_t>(-1);
  static constexpr std::size_t no_link = static_cast<std::size_t>(-1);

  void add_joint(std::size_t j);
  void leave_out(std::size_t j, ReadWarning fault);
  void break_cycles();
  void find_moving_faults();
  bool misspelt(const std::string& name) const;
  bool parts_tree(const UrdfFault& fault) const;
  const UrdfFault* cause_of_gap(std::size_t base, std::size_t tip) const;
  Indices links_below(Indices from) const;
  std::vector<End> moved_ends(std::size_t base, Way way) const;
  std::string before_gripper(const std::vector<End>& ends, std::size_t base) const;
  std::size_t palm_above(std::size_t link, const std::vector<bool>& fingers,
                         std::unordered_map<std::size_t, std::size_t>& known) const;
  std::vector<std::size_t> joint_depths() const;
  std::string below_fixed(std::size_t last, const std::vector<bool>& wanted,
                          const std::vector<std::size_t>& depths) const;
  std::size_t link_called(const std::string& name, const char* what) const;
  std::size_t parent_of(std::size_t link) const;
  std::size_t root_of(std::size_t link) const;
  const std::string& name_of(std::size_t link) const { return file_.links[link].name; }
  std::vector<std::string> names_of(const Indices& links) const;
  [[noreturn]] void refuse(const std::string& message, int line = 0) const;
  [[noreturn]] void refuse_first_fault_or(const std::string& message) const;

  const UrdfFile& file_;
  std::vector<UrdfFault> faults_;
  std::unordered_map<std::string, std::size_t> index_;  // of a link, by name
  Indices parent_joint_;
  std::vector<Indices> child_joints_;
  Indices roots_;                                         // orphans included
  std::unordered_map<std::size_t, std::size_t> orphans_;  // the fault of each, by link
  std::vector<bool> left_out_;                            // joints
  std::vector<std::size_t> cycle_of_;  // the link that closes a link's cycle, or none
};

}  // namespace beeline::internal
