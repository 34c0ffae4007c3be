#pragma once

#include <cstddef>
#include <map>
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

/// The kind of a warning: a choice of the reader, or a fault beside the chain.
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
  rate_limit,      ///< the limit `attribute` of `joint`, such as `velocity`, `numbers`, is below
                   ///< Limits::min_rate
  unknown_leader,  ///< `joint` mimics the joint `value`, which is not in the file; `others` are
                   ///< the known joints, none if there are more than 10,000
  leader_cycle,    ///< `joint`, which mimics the joint `value`, follows leaders that mimic each
                   ///< other
  constant_mimic,  ///< `joint` mimics, by leaders perhaps, the fixed joint `value`: it is
                   ///< constant at `numbers`
  nonlinear_coupling,  ///< `joint` follows the joint `value`, in MJCF, by a polynomial that is not
                       ///< linear
  range_ignored,       ///< the range of `joint`, in MJCF, `numbers`, has no lower limit below its
                       ///< upper one: as in MuJoCo, it has no limits
  constraint_ignored,  ///< `element`, an equality constraint of MJCF called `value`, is not read
  zero_multiplier,     ///< `joint` mimics the joint `value` with multiplier 0: it is constant at
                       ///< `numbers`
  unknown_element,     ///< `joint` or, if it is empty, the file contains `element`, which URDF does
                       ///< not define; so do `count` more joints
  unknown_attribute,   ///< `element` of `joint` has `attribute`, which URDF does not define; so do
                       ///< `count` more joints
  repeated_element,    ///< `joint` has `count` of `element`, of which the first one counts
  likely_degrees,      ///< an angle of `joint`, or of the base or the tool if it is empty,
                       ///< `numbers`, is more than a revolution in radians
  further_faults       ///< there are `count` more
};
std::string name(ReadWarningKind kind);

/// The reason why an element of an XML file, or a name or number in it, cannot be read.
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

/// A warning of a reader as data; sentence() returns its text. Names, elements and values of a file
/// are UTF-8; an invalid byte is written `\xfc`.
struct ReadWarning {
  ReadWarningKind kind = ReadWarningKind::malformed;
  std::string path = {};                            ///< path of the file
  int line = 0;                                     ///< line of the fault
  std::string joint = {}, link = {};                ///< names
  std::vector<std::string> others = {};             ///< names
  std::string element = {};                         ///< its tag, such as <xacro:include>
  ElementFault element_fault = ElementFault::none;  ///< fault of a malformed element
  std::string attribute = {}, value = {};           ///< attribute of an element, and its text
  std::vector<double> numbers = {};                 ///< axis, limits or value of the joint
  std::size_t count = 0;
  std::string program = {};  ///< program that made the text of which `line` is; empty: the file's
  bool lists_known = true;   ///< false: a warning before this one has listed the known names
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
/// (`RRR:3.5,3.5,2`), or a file, whose format is given by its ending: `.json`; `.urdf`, `.xml`,
/// `.mjcf` and `.xacro`, of which the root element says whether it is URDF or MJCF, see
/// read_urdf(). `ends` is for these only. Appends a warning to `warnings`, unless null, for each
/// choice among several and each fault. Throws Error for any other text (the message suggests the
/// most similar built-in name), and FileError for a file that cannot be read.
Arm read_arm(const std::string& text, const ChainEnds& ends = {},
             std::vector<ReadWarning>* warnings = nullptr);

/// The endings of arm files, without the dot.
std::vector<std::string> arm_file_endings();

/// Whether a path has the ending of files that describe a tree of links, of which ChainEnds selects
/// a chain: `.urdf`, `.xml`, `.mjcf` or `.xacro`, in any case of letters.
bool has_link_tree_ending(std::string_view path);

/// The same as read_arm() from the text of a file; the ending of `path` gives its format, and
/// messages name it.
Arm arm_from_text(std::string_view text, const std::string& path, const ChainEnds& ends = {},
                  std::vector<ReadWarning>* warnings = nullptr);

// A joint string describes an arm by its joints: `LETTERS[:ITEM,ITEM,...]`, one item per letter.
//   letters  R P H S C E U, as in composite_joint()
//   item     `length[@angle][pPITCH]`: metres along x to the next joint; a fixed rotation about z
//            before the joint, in degrees; metres of travel per revolution, for H only
// Default lengths are 1 m (0 for P, where the coordinate is the length), default pitches 1 m.
//   RRR:3.5,3.5,2   the arm of Dellaert, Serial Link Manipulators
//   PP:0,0@90       two prismatic joints at right angles
//   RHS:1,0.2p0.05,0   with a screw of 5 cm per revolution and a spherical wrist
// The joints are called joint1, joint2, ... by letter; composite joints append their axes
// (joint3_z).

/// Whether `text` has the form of a joint string: only these letters, or capitals before a colon.
bool is_joint_string(std::string_view text);

/// Returns the arm, whose name is the joint string. Throws Error for an unknown letter, a wrong
/// number of items, an item that cannot be parsed, or more than 100 letters.
Arm arm_from_joint_string(std::string_view text);

/// Arms as JSON; docs/arm.schema.json is the complete grammar. Metres, radians, seconds.
///     {"name": "my arm", "base": POSE, "tool": POSE,     base and tool are optional,
///      "controller_base": POSE, "flange": POSE,           so are the ControllerFrames,
///      "controller_base_assumed", "flange_assumed",       which count as stated unless true
///      "maker", "model", "source", "note",                and these texts
///      "joint_names": [["name", ...], ...],               other descriptions' names, not kept
///      "shapes": [...], "shapes_source",                  see read_arm_shapes(), not kept
///      "joints": [{"name", "type", "origin": POSE, "axis", "point", "pitch" or "screw",
///                  "limits": {"lower", "upper", "velocity", "acceleration", "jerk"},
///                  "mimic": {"joint", "multiplier", "offset"}, "link"}, ...]}
/// or, instead of "joints", one of
///      "joint_string": "RRP:1,0.5,0.2"
///      "dh": {"convention": "standard" or "modified", "degrees": true or false,
///             "rows": [{"name", "type", "a", "alpha", "d", "theta", "limits"}, ...]}
///      "screws": {"frame": "space" or "body", "home": POSE,
///                 "rows": [{"name", "w", "v" or "point" and "pitch", "limits"}, ...]}
/// the last without "base" and "tool": see arm_from_screws().
/// "degrees": alpha, theta and the limits of revolute rows are in degrees, as in makers' tables.
/// Throws FileError for anything else; it names the line and the value: `joints[2].limits.lower`.
Arm read_arm_json(const std::string& path);
/// The same from a text; `path` names it in messages. Adds a warning of an angle that may be in
/// degrees.
Arm arm_from_json(std::string_view text, const std::string& path,
                  std::vector<ReadWarning>* warnings = nullptr);

/// Returns the arm as JSON, described by its joints; it reads back exactly.
/// Throws Error for a name that is empty, longer than 1000 bytes, not UTF-8, or that contains
/// control characters.
std::string arm_to_json(const Arm& arm);

/// Writes arm_to_json() to a file. Throws FileError when the file cannot be written.
void write_arm_json(const std::string& path, const Arm& arm);

/// The formats that arms are written in. Files end in .json, .urdf, and .xml or .mjcf.
enum class ArmFileFormat {
  json,  ///< arm_to_json()
  urdf,  ///< of ROS
  mjcf,  ///< of MuJoCo
};
std::string name(ArmFileFormat format);

/// Returns the format with the ending of the path. Throws Error for another ending.
ArmFileFormat arm_file_format(const std::string& path);

/// The kind of a gap: a part of an arm that a format of arm files cannot describe.
enum class ArmGapKind {
  helical_joint,     ///< `joint` is helical
  equal_limits,      ///< `joint` has equal position limits: in MJCF it would have none
  repeated_link,     ///< `joint` moves the link `link`, as another joint does
  reserved_link,     ///< `joint` moves the link `link`, a name that the format reserves
  too_many_joints,   ///< the bodies of an MJCF file are nested, and readers limit the depth
  controller_frame,  ///< `joint` moves the link `link`, whose name states a frame of the controller
};
struct ArmGap {
  ArmGapKind kind = ArmGapKind::helical_joint;  ///< kind of the gap
  std::string joint = {}, link = {};            ///< names
};
std::string name(ArmGapKind kind);
/// Returns one sentence without a full stop, such as `joint3 is helical; URDF has revolute and
/// prismatic joints`.
std::string sentence(const ArmGap& gap, ArmFileFormat format);

/// An arm as the text of a file.
struct ArmFile {
  std::string text = {};          ///< content of the file; empty if there are gaps
  std::vector<ArmGap> gaps = {};  ///< parts of the arm for which there is no text
  /// Joints whose limits of velocity, acceleration and jerk are not in the text, because the format
  /// has none.
  std::vector<std::string> without_rates = {};
  /// ChainEnds::tip that selects the arm, if read_arm() selects another chain without it, as it
  /// does for an arm that includes joints of a gripper; empty: none is needed.
  std::string tip = {};

  /// Returns whether there is a text.
  explicit operator bool() const { return gaps.empty(); }
};

/// Returns the arm in a format. read_arm() makes the same arm of it; only of URDF and MJCF, the
/// base becomes a part of the first joint's offset.
///   - json: exactly.
///   - urdf: joint axes pass through the origins of their links. The frame of a link whose joint
///     does not is moved to the point of the axis nearest to its origin, parallel. Limits of
///     acceleration and jerk are the attributes `acceleration` and `jerk`, which other readers
///     ignore. An unknown limit of a rate and every effort are 0, a missing position limit is
///     +-1e9.
///   - mjcf: couplings are equality constraints. Bodies get a mass and an inertia of their own
///     from `boundmass` and `boundinertia` of `<compiler>`, without which MuJoCo reads no body.
/// Links without a name are called link1, link2 and so on, and the tool is a link `tool`. The
/// ControllerFrames are links `base` and `tool0` if they are stated. An assumed one is assumed
/// again when the file is read; if it is not what would be assumed there, as after with_mount() and
/// with_tcp(), it is written and thus stated. Shapes of links are not written. Throws Error as
/// arm_to_json().
ArmFile arm_file(const Arm& arm, ArmFileFormat format);

/// Returns sentences without a full stop about what the text lacks and which option reads the arm
/// from it, such as `ur5.xml has no limits of velocity, acceleration and jerk, as MJCF has none:
/// joint1`. `where` names the text, such as the path of its file.
std::vector<std::string> file_notes(const ArmFile& file, const std::string& where,
                                    OptionStyle style = OptionStyle::keyword);

/// Writes arm_file() in the format of the path's ending. Throws Error for a gap, another ending and
/// invalid names, and FileError when the file cannot be written.
void write_arm(const std::string& path, const Arm& arm);

/// The remaining choice of a frame of a DH table, given the axes of the joints before and behind
/// the link.
enum class DhFreedom {
  none,        ///< none but the sign of x: the axes are skew or meet in a point
  along_axis,  ///< parallel axes: the origin is anywhere on the axis
  on_axis,     ///< coincident axes: so it is, and x has any direction
  line,        ///< an axis of a prismatic joint has a direction, but no position
  end,         ///< the first and the last frame, which have an axis on one side
};
std::string name(DhFreedom freedom);

/// A joint whose axis a DH table does not give.
struct DhMisfit {
  std::string joint = {};  ///< name of the joint
  bool helical = false;    ///< otherwise its axis is nearly parallel to the axis before it
  /// Distance from the link's frame of the common normal of the two axes, m; its rounding is an
  /// error of the axis.
  double distance = 0;
};
/// Returns one sentence without a full stop.
std::string sentence(const DhMisfit& misfit);

/// The Denavit-Hartenberg parameters of an arm: base * A_1(q_1) ... A_n(q_n) * tool is the pose of
/// its tool, with A_i the transform of row i (Craig, *Introduction to Robotics*, section 3.6).
struct DhTable {
  DhConvention convention = DhConvention::standard;  ///< convention of the rows
  Pose base = Pose::Identity();                      ///< pose of frame 0 in the world
  std::vector<DhRow> rows = {};  ///< one for each joint, mimic joints included; none if misfits
  Pose tool = Pose::Identity();  ///< pose of the tool in frame n
  std::vector<DhFreedom> freedom = {};  ///< of frames 0 to n
  std::vector<DhMisfit> misfits = {};   ///< joints whose axis no row gives; empty: there is a table

  /// Returns whether there is a table.
  explicit operator bool() const { return misfits.empty(); }
};

/// Returns the DH table of an arm. Every chain of revolute and prismatic joints has one, as base
/// and tool are free. A frame that the axes leave open is the one nearest to the arm's own link
/// frame: an arm that was described by a table of this convention gets its rows. The length a is
/// not negative unless the link's own frame is the frame with the opposite x. The table gives each
/// axis to 5e-13 rad and, for lengths up to 1 m, 5e-13 m; `misfits` has the joints for which none
/// does: helical joints, and axes that are nearly parallel to the axis before them, whose common
/// normal is far away (Hayati & Mirmirani, 1985). Use the product of exponentials for them.
DhTable dh_table(const Arm& arm, DhConvention convention);

/// Checks the names of the arm, its joints and its links, which are not empty, UTF-8, without
/// control characters and of at most 1000 bytes. Throws Error.
void check_names(const Arm& arm);

/// The limits that a file has for the joints of an arm.
struct JointLimits {
  /// Limits by joint name, as with_limits() takes them.
  std::map<std::string, LimitOverrides> joints;
  /// Notes on settings of the file that are not applied: one sentence each, with the file's name.
  std::vector<std::string> notes;
};

/// Reads limits of the arm's joints from a file, .json or YAML, in SI units:
///   - MoveIt's joint_limits.yaml: max_velocity, max_acceleration, max_jerk, min_position and
///     max_position of each joint below the key joint_limits, which may be nested, as in
///     `/**: ros__parameters:`. `has_velocity_limits: false` states that no limit is known; numbers
///     with the tag !degrees are in degrees, as in the files of Universal Robots. A limit
///     bounds both directions, so it is the lower of max_velocity and |min_velocity|, and of
///     max_acceleration, |min_acceleration| and |max_deceleration|. A joint NAME of the file that
///     the arm does not have is its NAME_joint; if the file has all joints of the arm with one
///     prefix, such as `panda_`, the prefix is ignored. The files of Franka's robots are read too:
///     `joint1: limit: {lower, upper, velocity}`. Notes name the file's other joints and its
///     default scaling factors, which are not applied.
///   - JSON: {"joint1": {"lower", "upper", "velocity", "acceleration", "jerk"}, ...}; all optional.
/// Joints of a built-in arm may have its makers' names too: joint_namings().
/// Throws FileError for anything else, with the line: a file without any joint of the arm, a joint
/// that is given twice, an unknown key, a number that is not finite, in quotes or out of range,
/// lower above upper.
JointLimits read_joint_limits(const std::string& path, const Arm& arm);
/// The same from a text, which is JSON if `path` ends in .json or, without .yaml and .yml, if the
/// text begins with a brace.
JointLimits joint_limits_from_text(std::string_view text, const std::string& path, const Arm& arm);

}  // namespace beeline
