#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <beeline/error.h>
#include <beeline/io/text/arm.h>
#include <beeline/pose/se3.h>

namespace beeline {

/// The unit of angles in a text; the library itself uses radians only.
enum class AngleUnit { radians, degrees };

double to_radians(double angle, AngleUnit unit);

/// Angles beyond, in radians, may be meant in degrees: 2 pi, as typed with four digits.
constexpr double plausible_angle = 6.2842;

/// The meaning of three numbers without names: x,y,theta or x,y,z.
enum class Triple {
  planar,    ///< x,y,theta
  position,  ///< x,y,z
};

/// How numbers give a pose in space: the position x,y,z, then the orientation; or both in a matrix.
enum class PoseForm {
  rpy,         ///< roll,pitch,yaw: rotations about the fixed axes X, Y, Z, as in URDF
  rotvec,      ///< rx,ry,rz: the rotation vector, unit axis times angle, always in radians
  abc,         ///< A,B,C of KUKA: rotations about Z, the new Y, the new X, always in degrees
  quaternion,  ///< qw,qx,qy,qz
  matrix,      ///< m11,m12,...,m44: the 4 x 4 matrix row by row; read also without its last row
};
std::string name(PoseForm form);
PoseForm pose_form_named(std::string_view name);  ///< throws Error, naming the choices
std::vector<std::string> pose_form_names();

/// Returns the names of the numbers of a form, which are the columns of files: x,y,z,A,B,C.
const std::vector<std::string>& pose_columns(PoseForm form);

/// The units and the form of poses in a text.
struct PoseFormat {
  /// Unit of theta, roll, pitch and yaw. Rotation vectors are always in radians, A, B and C in
  /// degrees.
  AngleUnit angle_unit = AngleUnit::radians;
  /// The meaning of three numbers without names, which are refused by default.
  std::optional<Triple> triple = std::nullopt;
  /// The form of numbers without names. Default: the form with this number of numbers; rpy for six.
  std::optional<PoseForm> pose_form = std::nullopt;
  bool millimetres = false;  ///< positions are in millimetres instead of metres
};

/// A pose as a text gives it.
struct WrittenPose {
  Pose pose;
  bool planar = false;  ///< given as x,y,theta or x,y
  /// The angle of AngleUnit, or the length of a rotation vector, that is largest by magnitude,
  /// radians; 0 in the other forms.
  double max_angle = 0;
  bool oriented = true;  ///< false: a position, x,y,z or x,y; the orientation is the identity
  std::optional<PoseForm> form = std::nullopt;  ///< none: planar or a position
};

/// Poses of a CSV file, each in one of the forms of PoseForm, or as x,y,theta or x,y in the plane z
/// = 0, or as x,y,z. The last two have no orientation.
struct PoseList {
  std::vector<Pose> poses = {};  ///< at least one
  std::vector<int> lines = {};   ///< the line of the file of each pose
  bool planar = false;           ///< given as x,y,theta or x,y
  /// The theta, roll, pitch or yaw, or the length of a rotation vector, that is largest by
  /// magnitude, rad; 0 in the other forms.
  double max_angle = 0;
  bool oriented = true;                   ///< false: positions, given as x,y,z or x,y
  std::vector<std::string> columns = {};  ///< names of the columns of the form
  bool has_header = true;                 ///< false: the form follows from the number of columns
  std::optional<PoseForm> form = std::nullopt;  ///< std::nullopt: planar or positions
  bool vector_in_degrees = false;  ///< rx, ry, rz are in degrees, as their names or a comment say
  /// Units other than m and rad that a comment gives, mm and deg.
  std::vector<std::string> commented_units = {};
};

/// The columns by which a file gives a pose, in the order of numbers without names.
struct PoseColumns {
  std::vector<std::string> names;
  std::optional<PoseForm> form = std::nullopt;  ///< form of the orientation in space
  bool planar = false;
  bool oriented = true;
};

/// Returns all forms of columns: x,y,theta first, then one for each PoseForm, then x,y,z and x,y.
const std::vector<PoseColumns>& all_pose_columns();

/// The name of the unit in which written_pose() takes the numbers of a column; empty for none.
std::string unit_of_column(const std::string& name, const PoseFormat& format);

/// Whether numbers without names may be in these columns: whether they have the orientation of
/// format.pose_form, or by default rpy, a quaternion or a matrix, or none; of three, whether they
/// are format.triple, or may be.
bool reads_without_names(const PoseColumns& columns, const PoseFormat& format);

/// The pose given by numbers in the order of `columns`. Throws Error as pose_of().
WrittenPose written_pose(std::span<const double> numbers, const PoseColumns& columns,
                         const PoseFormat& format);

/// Returns the pose given by numbers without names: 2, 3, 6, 7, 12 or 16 of them. Throws Error for
/// any other count, for three without PoseFormat::triple, for a count that PoseFormat::pose_form
/// does not have, for a quaternion whose length is not 1 to 1e-3, and for a matrix that is not a
/// rigid motion to 1e-6.
Pose pose_of(std::span<const double> numbers, const PoseFormat& format = {});

/// Returns the numbers of a pose in the form of `format`, by default rpy, in the order of
/// pose_columns(): pose_of() with the same format reads them back, to rounding or, for rpy and abc
/// in gimbal lock, to 1e-12 rad.
std::vector<double> pose_numbers(const Pose& pose, const PoseFormat& format = {});

/// Reads a CSV file whose header names the columns of one form, in any order; upper and lower case
/// are alike. Without a header, a comment before the first row names the columns, or their number
/// selects the form, see PoseFormat. The separator is a comma, a semicolon, a tab, a pipe or
/// blanks; unless it is a comma, numbers may have decimal commas. Empty lines, rules of Markdown
/// tables and lines that begin with #, % or // are skipped. Numbers are in the units of `format`,
/// except where a name of a column (x_mm, roll [deg]), a row of units below the header (mm,mm,deg)
/// or a comment before it (# units: mm, deg) gives another one. Throws FileError for a column that
/// is missing or unknown, as pose_of(), for a pose farther away than 1e100 m, and for a comment
/// that contradicts degrees or millimetres of `format`, gives a unit that is not read, or is not
/// clear about the units of columns without one. notes_on() has the notes on their units.
PoseList read_poses(const std::string& path, const PoseFormat& format = {});
/// The same from a text; `path` names it in messages.
PoseList poses_from_csv(std::string_view text, const std::string& path,
                        const PoseFormat& format = {});

/// Kinds of PoseNote.
enum class PoseNoteKind {
  no_header,             ///< the table has no header; its columns are read as `columns`
  likely_degrees,        ///< an angle of `value` rad is more than a revolution
  long_rotation_vector,  ///< a rotation vector of `value` rad is more than a revolution
  vector_in_degrees,     ///< rx, ry, rz in degrees are read as a rotation vector, not as rpy
  commented_unit,        ///< a comment gives the units `columns`
  likely_millimetres,    ///< a position `value` m away is probably in millimetres
};
std::string name(PoseNoteKind kind);

/// How poses were read where their text does not say, or what their numbers suggest. Python and the
/// command warn of it; the readers of C++ return poses alone, and notes_on() has the notes.
struct PoseNote {
  PoseNoteKind kind = PoseNoteKind::no_header;  ///< kind of the note
  std::vector<std::string> columns = {};        ///< names of the columns
  double value = 0;                             ///< the angle, rad, or the distance, m
};

/// Returns the notes on poses that were read in this format: on a missing header and on the largest
/// angle and, with the sphere of Arm::reach() of the arm that is to reach the poses, on the first
/// position that is probably in millimetres:
///     for (const PoseNote& note : notes_on(poses, format, arm.reach())) {
///       std::cerr << sentence(note, "poses.csv") << '\n';
///     }
std::vector<PoseNote> notes_on(const PoseList& list, const PoseFormat& format = {},
                               const std::optional<Arm::Reach>& sphere = std::nullopt);

/// The note on the largest angle of one pose, WrittenPose::max_angle, or of one joint value, rad;
/// none if it is plausible.
std::optional<PoseNote> angle_note(double angle, std::optional<PoseForm> form = std::nullopt,
                                   const PoseFormat& format = {});

/// The note on the position of one pose that is to be reached; none if it is plausible.
std::optional<PoseNote> distance_note(const Arm::Reach& sphere, const Pose& pose,
                                      const PoseFormat& format = {});

/// Returns one sentence without a full stop, which begins with `where`, the name of the file or of
/// the argument. It says which option reads the numbers otherwise.
std::string sentence(const PoseNote& note, const std::string& where,
                     OptionStyle style = OptionStyle::keyword);

/// Parses a pose from numbers separated by commas, as pose_of(). `p[x,y,z,rx,ry,rz]`, a pose of
/// URScript, is always in metres with a rotation vector in radians.
WrittenPose parse_pose(std::string_view text, const PoseFormat& format = {});

/// A row of a program file: a move to a waypoint, or a part that the tool takes or leaves at the
/// waypoint before. planning/program.h defines its meaning; an empty text or option is an empty
/// item.
struct ProgramRow {
  /// Kind of the motion: joint, line, screw, arc, spline, via; empty: line. Of a part: attach,
  /// detach.
  std::string motion;
  std::string relative;             ///< previous, next; empty: the pose is in the work frame
  std::optional<WrittenPose> pose;  ///< pose of the row; none if all items of the pose are empty
  std::string q;                    ///< joint values, or the name of a state
  std::optional<double> speed;      ///< tool speed, m/s
  std::optional<double> blend;      ///< deviation of the blend, m
  std::optional<double> dwell;      ///< time at rest, s
  std::string part = {};            ///< name of the obstacle that is attached or detached
  std::vector<std::string> touch = {};  ///< names of the bodies that an attached part may touch
  int line = 0;                         ///< line of the file

  /// Whether the row attaches or detaches a part, and moves nothing.
  bool is_of_part() const { return motion == "attach" || motion == "detach"; }
};

struct ProgramRows {
  std::string path;              ///< names the file in messages
  std::vector<ProgramRow> rows;  ///< at least one
};

/// Returns the columns that a program file may have besides the columns of a pose, in any order:
///     motion,relative,q,speed,blend,dwell,part,touch
const std::vector<std::string>& program_columns();

/// Whether the header of a CSV text names one of program_columns().
bool is_program(std::string_view text);

/// Reads a program file: a CSV file whose header names some of program_columns(), and the columns
/// of one form of a pose unless all rows have joint values, `q`. Throws FileError for a column that
/// is missing or unknown; a row of another length; a motion or relative that is unknown; a row with
/// neither a pose nor joint values, with both, or with a part of a pose, except a via row with a
/// position only; an attach or detach row without a part, or with items of a move; a part or touch
/// in another row; and as read_poses(). Names in touch are separated by commas, in quotes.
/// Speeds, blends and dwells are in m/s, m and s, unless their names, a row of units or a comment
/// gives another unit; joint values are in the unit of the options, and a comment that gives
/// another one is refused beside them.
ProgramRows read_program_rows(const std::string& path, const PoseFormat& format = {});
/// The same from a text; `path` names it in messages.
ProgramRows program_rows_from_csv(std::string_view text, const std::string& path,
                                  const PoseFormat& format = {});

}  // namespace beeline
