#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <beeline/error.h>
#include <beeline/model/arm.h>

namespace beeline {

/// Selects a chain of a tree of links. It runs from the base up to a common ancestor and down to
/// the tip.
struct ChainEnds {
  std::string base = {};  ///< name of a link; empty: the root
  std::string tip = {};   ///< name of a link; empty: the one that read_urdf() selects
};

/// What a reader selected, or left out because of a fault beside the chain.
enum class ReadWarningKind {
  tip_among_frames,    ///< the chain ends at `link`; `others` are frames fixed to the same body
  tip_among_branches,  ///< the chain ends at `link`; `others` are ends of other branches
  before_gripper,      ///< the chain ends at `link`, above `joint`, which moves a gripper's finger;
                       ///< `others` is the end below it
  below_free_joint,    ///< the chain begins at `link`, below `joint`, which is floating or planar
  malformed,           ///< an element, of `joint` if it has one, whose attributes cannot be read
  xacro_tag,           ///< an element that xacro should have replaced
  unknown_link,        ///< `joint` connects `link`, which the file does not have
  two_parents,         ///< `joint` is the second one above `link`
  cycle,               ///< `joint` closes a cycle at `link`
  repeated_name,       ///< the name of `joint` or `link` is given twice
  unconnected_link,    ///< no joint connects `link`
  further_faults       ///< there are `count` more
};
std::string name(ReadWarningKind kind);

/// A warning of a reader: data, from which sentence() makes the text.
struct ReadWarning {
  ReadWarningKind kind = ReadWarningKind::malformed;
  std::string path = {};                 ///< of the file
  int line = 0;                          ///< of a fault
  std::string joint = {}, link = {};     ///< names
  std::string element = {};              ///< of a xacro_tag, such as <xacro:include>
  std::vector<std::string> others = {};  ///< names of links
  std::string fault = {};                ///< the clause that an error would have; of faults only
  std::size_t count = 0;
};

/// Whether the warning is of a fault; the others are selections.
bool is_fault(const ReadWarning& warning);

/// Returns one sentence without a full stop, such as `the tip is tool0; other tips: finger`.
std::string sentence(const ReadWarning& warning);

/// Returns the arm that `text` names: a built-in arm (`panda`, in any case), a joint string with
/// link lengths
/// (`RRR:3.5,3.5,2`), or a file, whose format is given by its ending (`.urdf`, `.json`). `ends` is
/// for URDF files only. Appends to `warnings`, unless null, what was selected among several or left
/// out.
/// Throws Error for a text that is none of these (it suggests the most similar built-in name), and
/// FileError for a file that cannot be read.
Arm read_arm(const std::string& text, const ChainEnds& ends = {},
             std::vector<ReadWarning>* warnings = nullptr);

/// The same from the text of a file; the ending of `path` gives its format, and messages name it.
Arm arm_from_text(std::string_view text, const std::string& path, const ChainEnds& ends = {},
                  std::vector<ReadWarning>* warnings = nullptr);

}  // namespace beeline
