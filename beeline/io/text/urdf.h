#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <beeline/collision/scene.h>
#include <beeline/error.h>
#include <beeline/io/text/arm.h>
#include <beeline/model/arm.h>

namespace beeline {

/// Reads the chain from `ends.base` to `ends.tip` of a URDF file; the world is the base link's
/// frame. Both may be any links of the tree.
///   - Without `ends.base` the chain begins at the root or, if a floating or planar joint places
///     the arm in the world, below that joint. Without `ends.tip` it ends at a leaf below the base
///     that a joint moves or, if there is none, at another end of the tree. Among leaves that only
///     fixed joints connect, it is `tool0`, otherwise the first in the file; among other leaves
///     `tool0`. If the last joints move a finger of a gripper, by their names, the chain ends
///     before them. Appends to `warnings`, unless null, what was selected.
///   - On the way up, a joint carries its parent link: its origin and axis are inverted. Its
///     coordinate remains the file's, and so do its limits and its mimic factors.
///   - Revolute, continuous and prismatic joints are the arm's joints. Fixed joints become part of
///     the next joint's offset, the last ones part of the tool. Other types are refused if they are
///     on the chain.
///   - The orientation of an `<origin>` is `rpy`, or the quaternion `quat_xyzw` of URDF 1.2.
///   - A missing `<axis>` is 1 0 0; a missing `<limit>` means no limits. Effort and soft limits are
///     ignored. Infinities and position limits beyond 1e6 rad or m stand for no limit.
///   - The attributes `acceleration`, `deceleration` and `jerk` of `<limit>` are read beside
///     `velocity`; the acceleration limit is the smaller of the first two. A limit of a rate that
///     is missing, 0, -1 or beyond 1e10 is unknown; another negative one on the chain is refused.
///   - Elements and attributes of a joint that URDF does not define are ignored, and so is a second
///     element of one name; `warnings` says so, except of names with a prefix.
///   - Mimic joints whose leader is not on the chain follow the first of them in the file, which
///     has a coordinate of its own. A mimic joint whose leader is fixed is fixed too, at its
///     offset: `warnings` says so. One whose leader is floating or planar is refused.
///   - ControllerFrames: the root frame is the link `base` and the flange the link `tool0`, as in
///     ROS-Industrial's descriptions (REP 199), where only fixed joints connect them to the chain's
///     ends. Otherwise they are the base link and the tip.
///   - Frames are the file's: each joint moves the frame of its child link (on the way up, of its
///     parent link), named in Joint::link.
///   - Faults beside the chain are appended to `warnings`: links and joints that cannot be read or
///     connected, names given twice, elements of xacro, and joints with an unknown type, an axis
///     without direction, a lower limit that exceeds the upper one, a limit of a rate that is too
///     small, or a leader that the file does not have. Without `ends.tip`, a joint that moves and
///     is not connected is refused if it may belong to the chain: the name of its parent resembles
///     the name of a link, or as many joints move below it as on the chain.
///
/// A file whose root element is `<mujoco>` is MJCF, MuJoCo's format; its bodies are the links, and
/// the world is the link `world`:
///   - Hinge and slide joints are the arm's joints, with MuJoCo's coordinates: at `ref` a body is
///     at its pose. Ball and free joints are refused on the chain; a free joint above the arm
///     places it in the world, as a floating joint does. Several joints of a body follow each
///     other; all but the last one move links that are called `BODY.1`, `BODY.2` and so on.
///   - Default classes, `<frame>`, all forms of orientations, `<compiler>` and `<include>` are
///     read. An included file must be in the folder of the file. `<replicate>`, `<attach>`,
///     `<composite>` and `<flexcomp>` are refused.
///   - An equality constraint of two joints with a linear polycoef is a mimic joint; of one joint,
///     it fixes the joint. Other constraints are ignored: `warnings` names those that are active.
///     Ranges of actuators are ignored.
///   - `ends` may name sites, too, which are no ends of the tree unless they are named. A site with
///     the name of a body is called `NAME_`. Bodies and joints without names are called `body2` and
///     `joint0`, by MuJoCo's indices.
///
/// A file `.xacro` is expanded by the program `xacrodoc` or `xacro`, if one is in a folder of PATH;
/// KeptExpansions passes arguments to it. Programs run for at most a minute. Other files with
/// elements of xacro are read as described above. Throws FileError for text that is neither URDF
/// nor MJCF; for a `.xacro` file where no program is installed or it fails, with its message; for
/// what is malformed in MJCF; several roots or tips without a choice by `ends`; a tip that is
/// unknown, not connected to the base, or not moved by any joint; on the chain a fault, an axis of
/// zero length, a lower limit that exceeds the upper one, or a mimic joint whose leader is not in
/// the file.
Arm read_urdf(const std::string& path, const ChainEnds& ends = {},
              std::vector<ReadWarning>* warnings = nullptr);
/// The same from a text; `path` names it in messages.
Arm arm_from_urdf(std::string_view text, const std::string& path, const ChainEnds& ends = {},
                  std::vector<ReadWarning>* warnings = nullptr);

namespace internal {
struct Expansions;
}

/// Values of the `<xacro:arg>` elements of a .xacro file, by name.
using XacroArguments = std::map<std::string, std::string>;

/// Keeps the expanded texts of .xacro files for as long as it lives: functions that are called in
/// its thread meanwhile run the program once for each file, unless its text changes, and give it
/// `arguments`. One without arguments, made while another one lives, uses what that one has. The
/// command has one for each call. Throws Error for a name with other characters than letters,
/// digits, `_` and `-`, or that begins with `-`. Use it as a local variable only: they must be
/// destroyed in reverse order, in their thread.
class KeptExpansions {
 public:
  explicit KeptExpansions(const XacroArguments& arguments = {});
  ~KeptExpansions();
  KeptExpansions(const KeptExpansions&) = delete;
  KeptExpansions& operator=(const KeptExpansions&) = delete;

 private:
  std::unique_ptr<internal::Expansions> own_;  ///< null: it uses what `around_` has
  internal::Expansions* around_ = nullptr;
};

/// An SRDF file, which MoveIt reads beside a URDF file: groups of joints, named states, and pairs
/// of links whose contact does not count. The functions that use names of joints and links compare
/// them with an arm; exempted_pairs() (scene.h) with its shapes.
struct Srdf {
  struct Group {
    std::string name;
    std::vector<ChainEnds> chains = {};
    std::vector<std::string> joints = {}, links = {}, groups = {};
    int line = 0;
  };
  struct State {
    std::string name, group;  ///< the group is empty where the file has none
    std::map<std::string, std::vector<double>> joints = {};  ///< values in rad or m, by joint
    int line = 0;
  };

  std::string path;  ///< names the file in messages
  std::vector<Group> groups = {};
  std::vector<State> states = {};
  std::vector<std::string> virtual_joints = {};     ///< they place the robot in the world
  std::vector<NamedPair> disabled_collisions = {};  ///< pairs of links that may touch
  /// Links that may touch all others, except in `enabled_collisions`.
  std::vector<std::string> disabled_links = {};
  std::vector<NamedPair> enabled_collisions = {};
};

/// Reads an SRDF file. End effectors, passive joints and spheres of links are ignored.
/// Throws FileError for text that is not SRDF, a missing attribute, two groups of one name, two
/// states of one name and group, and a value that is not a number.
Srdf read_srdf(const std::string& path);
/// The same from a text; `path` names it in messages.
Srdf srdf_from_text(std::string_view text, const std::string& path);

/// Returns the base and the tip of a group in a URDF file. A group with a `<chain>` has the ends of
/// the chain. For a group that lists joints, links (each means the joint above it) or groups, they
/// are the link above its first joint and the link below its last one. Mimic joints need not be
/// listed.
/// Throws FileError for an unknown group, joint or link (the message lists the known ones), and for
/// a group whose joints do not form one complete chain.
ChainEnds group_ends(const Srdf& srdf, const std::string& group, const std::string& urdf_path);

/// Returns the configuration of a named state with a value for each coordinate of the arm, of this
/// group if it has one of the name.
/// Throws FileError for an unknown name (it lists the known ones), a state without a value for a
/// coordinate, and several states of the name with different values.
Configuration named_state(const Srdf& srdf, const Arm& arm, const std::string& name,
                          const std::string& group = "");

}  // namespace beeline
