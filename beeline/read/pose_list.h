#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <beeline/error.h>
#include <beeline/pose/se3.h>

namespace beeline {

/// The unit of angles in a text; the library itself uses radians only.
enum class AngleUnit { radians, degrees };

double to_radians(double angle, AngleUnit unit);

/// The meaning of three numbers without names: x,y,theta or x,y,z.
enum class Triple { planar, position };

/// A pose as a text gives it.
struct WrittenPose {
  Pose pose;
  bool planar = false;   ///< given as x,y,theta or x,y
  double max_angle = 0;  ///< the angle that is largest by magnitude, radians; 0 with a quaternion
  bool oriented = true;  ///< false: a position, x,y,z or x,y; the orientation is the identity
};

/// Poses of a CSV file. A text gives a pose in one of these forms, in metres and an AngleUnit:
///     x,y,theta     x,y,z,roll,pitch,yaw     x,y,z,qw,qx,qy,qz     x,y,z     x,y
/// The first and the last are planar: in the plane z = 0. The last two have no orientation.
struct PoseList {
  std::vector<Pose> poses = {};           ///< at least one
  std::vector<int> lines = {};            ///< the line of the file of each pose
  bool planar = false;                    ///< given as x,y,theta or x,y
  double max_angle = 0;                   ///< the angle that is largest by magnitude, radians
  bool oriented = true;                   ///< false: positions, given as x,y,z or x,y
  std::vector<std::string> columns = {};  ///< of the form
  bool has_header = true;                 ///< false: the form follows from the number of columns
};

/// Returns the names of the columns of the five forms, in the order above.
const std::array<std::vector<std::string>, 5>& pose_forms();

/// Returns the pose given by 2, 3, 6 or 7 numbers in the order of pose_forms(). Throws Error for
/// any other count and for a quaternion that is not of unit length.
Pose pose_of(std::span<const double> numbers, AngleUnit unit = AngleUnit::radians,
             Triple triple = Triple::planar);

/// Reads a CSV file whose header names the columns of one form, in any order. Without a header, the
/// columns are those of the form with as many, in its order; of three, `triple` says which. The
/// separator is a comma or, where the first line has no comma, a semicolon. Throws FileError for a
/// column that is missing or unknown, for a quaternion that is not of unit length, and for a pose
/// farther away than 1e100 m.
PoseList read_poses(const std::string& path, AngleUnit unit = AngleUnit::radians,
                    Triple triple = Triple::planar);
/// The same from a text; `path` names it in messages.
PoseList poses_from_csv(std::string_view text, const std::string& path,
                        AngleUnit unit = AngleUnit::radians, Triple triple = Triple::planar);

/// Parses a pose from 2, 3, 6 or 7 numbers separated by commas, as pose_of().
WrittenPose parse_pose(std::string_view text, AngleUnit unit = AngleUnit::radians,
                       Triple triple = Triple::planar);

/// A row of a program file: a move to a waypoint. What it means is in planning/program.h; an empty
/// text or option is an empty item.
struct ProgramRow {
  std::string motion;               ///< joint, line, screw, arc, spline, via; empty: line
  std::string relative;             ///< previous, next; empty: the pose is in the work frame
  std::optional<WrittenPose> pose;  ///< none where all items of the pose are empty
  std::string q;                    ///< joint values, or the name of a state
  std::optional<double> speed;      ///< metres per second
  std::optional<double> blend;      ///< metres
  std::optional<double> dwell;      ///< seconds
  int line = 0;                     ///< of the file
};

struct ProgramRows {
  std::string path;              ///< names the file in messages
  std::vector<ProgramRow> rows;  ///< at least one
};

/// The columns that a program file may have besides those of a pose, in any order:
///     motion,relative,q,speed,blend,dwell
const std::vector<std::string>& program_columns();

/// Whether the header of a CSV text names one of program_columns().
bool is_program(std::string_view text);

/// Reads a program file: a CSV file whose header names some of program_columns(), and the columns
/// of one form of a pose unless all rows have joint values, `q`. Throws FileError for a column that
/// is missing or unknown; a row of another length; a motion or relative that is unknown; a row with
/// neither a pose nor joint values, with both, or with a part of a pose; and as read_poses().
ProgramRows read_program_rows(const std::string& path, AngleUnit unit = AngleUnit::radians);
/// The same from a text; `path` names it in messages.
ProgramRows program_rows_from_csv(std::string_view text, const std::string& path,
                                  AngleUnit unit = AngleUnit::radians);

}  // namespace beeline
