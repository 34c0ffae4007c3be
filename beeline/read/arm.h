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
  malformed,           ///< `element`, of `joint` if it has one, cannot be read: see ElementFault
  xacro_tag,           ///< `element`, in `joint` if it has one, which xacro should have replaced
  unknown_link,        ///< `joint` connects by `element`, `parent` or `child`, the unknown `link`;
                       ///< `others` are the known links, none if there are more than 10,000
  two_parents,         ///< `link` has two parents: `joint` and the joint in `others`
  cycle,               ///< `joint` closes a cycle at `link`
  repeated_name,       ///< the name of `joint` or `link` is given twice
  unconnected_link,    ///< no joint connects `link`
  unknown_type,        ///< the type `value` of `joint` is not one of URDF
  zero_axis,           ///< the axis of `joint`, `numbers`, has no direction
  limits_reversed,     ///< the lower limit of `joint` exceeds the upper one: `numbers`
  velocity_limit,      ///< the velocity limit of `joint`, `numbers`, is below Limits::min_rate
  unknown_leader,      ///< `joint` mimics the joint `value`, which is not in the file; `others` are
                       ///< the known joints, none if there are more than 10,000
  leader_cycle,        ///< `joint`, which mimics the joint `value`, follows leaders that mimic each
                       ///< other
  further_faults       ///< there are `count` more
};
std::string name(ReadWarningKind kind);

/// Why an element of an XML file, or a name or number in it, cannot be read.
enum class ElementFault {
  none,
  missing_attribute,  ///< it needs `attribute`
  missing_end,        ///< `joint` has no `element`, which is `parent` or `child`
  empty_name,         ///< `attribute`, a name, is empty
  long_name,          ///< the name `value` of `attribute` is longer than 1000 bytes
  control_character,  ///< the name `value` of `attribute` has control characters
  not_utf8,           ///< the name `value` of `attribute` is not UTF-8
  not_three_numbers,  ///< `attribute` has `count` numbers
  missing_number,     ///< a number of `attribute` is missing
  not_a_number,       ///< `value`, of `attribute`, is not a number
  out_of_range,       ///< the number `value` of `attribute` exceeds the range of numbers
  not_finite,         ///< the number `value` of `attribute` is not finite
  not_a_limit,        ///< the limit `value` of `attribute` is NaN or a word
  not_four_numbers,   ///< `attribute`, a quaternion, has `count` numbers
  not_unit_length,    ///< the quaternion `value` of `attribute` does not have length 1
  two_orientations    ///< it has `attribute` and rpy
};
std::string name(ElementFault fault);

/// A warning of a reader: data, from which sentence() makes the text. Names, elements and values of
/// a file are UTF-8: a byte that is not is written `\xfc`.
struct ReadWarning {
  ReadWarningKind kind = ReadWarningKind::malformed;
  std::string path = {};                            ///< of the file
  int line = 0;                                     ///< of a fault
  std::string joint = {}, link = {};                ///< names
  std::vector<std::string> others = {};             ///< names
  std::string element = {};                         ///< its tag, such as <xacro:include>
  ElementFault element_fault = ElementFault::none;  ///< of a malformed element
  std::string attribute = {}, value = {};           ///< of a malformed element
  std::vector<double> numbers = {};                 ///< of the joint
  std::size_t count = 0;
};

/// Whether the warning is of a fault; the others are selections.
bool is_fault(const ReadWarning& warning);

/// How a sentence writes an option: `tip="hand"`, as in Python, or `--tip hand`.
enum class OptionStyle { keyword, command };

/// Returns one sentence without a full stop, such as `the tip is tool0; other tips: finger; --tip
/// selects another`. It says which option makes another choice.
std::string sentence(const ReadWarning& warning, OptionStyle style = OptionStyle::keyword);

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
