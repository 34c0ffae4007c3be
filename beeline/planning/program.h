#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <beeline/certificate/clearance.h>
#include <beeline/certificate/verify.h>
#include <beeline/error.h>
#include <beeline/planning/move_along.h>

namespace beeline {

enum class MoveKind {
  joint,   ///< a straight line in joint space
  around,  ///< a joint motion around the obstacles of a scene: see move_around()
  line,    ///< a straight line of the tool
  screw,   ///< a screw motion of the tool
  arc,     ///< a circular arc through Move::via
  spline,  ///< consecutive spline moves make one spline; a dwell ends it
};
std::string name(MoveKind kind);

/// Throws Error listing the kinds for another name.
MoveKind move_kind_named(std::string_view name);

/// Returns whether moves of this kind are joint motions, `joint` and `around`. Their waypoint may
/// be a configuration, and the path of the tool between the waypoints is not given.
bool is_joint_motion(MoveKind kind);

/// A move from the waypoint before it to its own waypoint. The tool is at rest there unless the
/// move blends into the next one or both are part of one spline.
struct Move {
  MoveKind kind = MoveKind::line;
  Pose target = Pose::Identity();  ///< the waypoint, world_T_tool
  /// The waypoint of a joint motion as a configuration; it replaces `target`.
  std::optional<Configuration> q = std::nullopt;
  std::optional<Vector3> via = std::nullopt;  ///< a position on the arc in the world, m
  /// Limit of the tool origin's speed, m/s, 1e-8 or more; default: the limit of the options. It
  /// also holds on the blend with the next move. On a blend with a joint move the limits of both
  /// moves hold; verify() only knows where the tool passes the waypoint, and checks the one of this
  /// move up to there and the next one after it.
  std::optional<double> speed = std::nullopt;
  /// Max deviation of the blend with the next move from the waypoint, m. The max deviation in
  /// orientation is 5 rad for each metre. 0: no blend. Each of both moves must be a line or a joint
  /// move. Between two lines it is 1e-4 m or more, and also holds for the deviation from both: see
  /// blended_lines(). Where no motion is found with this blend, its radius becomes 0.4, 0.16 or
  /// 0.064 of it, or the arm stops.
  /// Between two joint moves, the tool passes the waypoint within it; if this is a configuration,
  /// so does each joint: within 5 rad for each metre, or, if it slides, within as many metres.
  /// Between a line and a joint move, the tool follows the line, up to or from a point on the half
  /// at the waypoint that is within it.
  double blend = 0;
  double dwell = 0;        ///< time at rest at the waypoint, s, 0 or more
  std::string place = {};  ///< place of the move in a file, for messages: pick.csv:5
  int line = 0;            ///< line of this file; 0: none
};

/// Max moves of a program, which is planned as a whole in memory: some 10 s and 1 GB for this many.
constexpr std::size_t max_moves = 5000;

/// A part that the tool carries from one waypoint to another: an obstacle of the scene that is a
/// body of the arm in between, fixed to the last link. It is taken as it stands relative to the
/// tool, where the arm comes to rest at the first waypoint, before its dwell. At the second one it
/// becomes an obstacle where it is. Obstacles and the other links must keep their clearance from
/// it, as from a shape of the tool, also where pairs of links do not count;
/// CollisionOptions::allowed_pairs with its name hold for both. While it is carried it keeps the
/// clearance of the model; an obstacle with a larger one of its own cannot be carried.
struct Attachment {
  std::string part = {};  ///< name of the obstacle
  /// Number of moves before it is attached, at the waypoint of the last of them; 0: at the start.
  std::size_t after = 0;
  /// Likewise for its end; default: it stays attached.
  std::optional<std::size_t> until = std::nullopt;
  /// Links and obstacles that may touch it while it is attached, such as the table below it.
  std::vector<std::string> touch = {};
  std::string place = {};         ///< place of its beginning in a file, for messages: pick.csv:5
  int line = 0;                   ///< line of this file; 0: none
  std::string detach_place = {};  ///< place of its end, likewise
};

/// The moves of an arm in order, such as a whole pick.
struct Program {
  std::vector<Move> moves;                   ///< moves in order
  std::vector<Attachment> attachments = {};  ///< parts that the tool carries, in any order
};

/// "attach box (pick.csv:5)": the name of attachments[i] in messages.
std::string attachment_name(const Program& program, std::size_t i);

/// "move 3 (line, pick.csv:5)": the name of moves[i] in messages.
std::string move_name(const Program& program, std::size_t i);

/// Invalid input in one move of a program. The message is move_name(), `: ` and the fault.
class MoveError : public Error {
 public:
  MoveError(const Program& program, std::size_t move, const std::string& fault);

  std::size_t move() const { return move_; }           ///< index in Program::moves
  const std::string& fault() const { return fault_; }  ///< message without the name of the move

 private:
  std::size_t move_;
  std::string fault_;
};

/// Invalid input in one attachment of a program. The message is attachment_name(), `: ` and the
/// fault.
class AttachmentError : public Error {
 public:
  AttachmentError(const Program& program, std::size_t attachment, const std::string& fault);

  std::size_t attachment() const { return attachment_; }  ///< index in Program::attachments
  const std::string& fault() const { return fault_; }     ///< message without the name

 private:
  std::size_t attachment_;
  std::string fault_;
};

/// What became of the blend of a move with the next one. The search for blends between two stops of
/// a program ends after 20 motions that are refused, and one more for each joint path along lines;
/// but every sequence of blends is tried once.
enum class BlendOutcome {
  none,     ///< the move has no blend
  full,     ///< it is as large as its deviation, both moves and the limits at its samples allow
  smaller,  ///< it is smaller, because a larger one is not possible or proved, or takes longer
  stop,     ///< the arm stops, because no blend is proved in the search or a stop is quicker
};
std::string name(BlendOutcome outcome);

/// The part of a trajectory that is one move.
struct PlannedMove {
  std::size_t begin = 0;  ///< index of its first sample
  /// The sample at its waypoint. If it blends into the next move: with two lines, the sample at the
  /// blend's end or the first after it, otherwise the sample nearest to the waypoint. A dwell
  /// follows.
  std::size_t end = 0;
  Deviation bound = {};     ///< proved deviation from the path it follows; 0 for a joint motion
  double tool_speed = 0;    ///< bound on the speed of the tool's origin, m/s
  double blend_radius = 0;  ///< length of the part of both lines that the blend replaces, m
  /// Length of the part of both moves that a blend with a joint move replaces, in joint space:
  /// norm of the change of the joints, which adds radians and metres.
  double joint_blend_radius = 0;
  BlendOutcome blend = BlendOutcome::none;  ///< what became of the blend with the next move
  /// Of a move around obstacles: FreePath::waypoints. The motion passes the inner ones in blends
  /// or stops there. Of a joint move that is passed in a blend: its waypoint.
  std::vector<Configuration> waypoints = {};
};

/// A trajectory of a program, with its proof. Only status, reason and failed are set unless
/// reached: the bound of the deviation is then infinite, and the margins are 0.
struct ProgramMotion {
  MotionStatus status = MotionStatus::not_found;
  Reason reason = {};  ///< why, with the move; none if reached
  /// Index of the move where the motion ends; the number of moves if it is complete.
  std::size_t failed = 0;
  /// How the search for blends with joint moves ended. Unless complete, the budget ended it: the
  /// blends proved by then stay, and the arm stops at the waypoints of the others.
  Ending search_ending = Ending::complete;
  Trajectory trajectory;           ///< trajectory from rest to rest
  std::vector<PlannedMove> moves;  ///< one for each move of the program
  PathDeviation deviation;         ///< proved deviation of all moves except joint motions
  LimitUsage limits;               ///< fractions of the limits that the trajectory uses
  /// The section that leads back within the position limits, with the option `recover`. Empty if
  /// the motion starts within them.
  std::optional<Recovery> recovery = std::nullopt;
  /// Smallest distance of a joint to a position limit, as a fraction of half its range, over all
  /// moves except joint motions.
  double limit_margin = 1;
  /// Smallest inverse condition number of the task's Jacobian, from 0 to 1, over all moves except
  /// joint motions.
  double inverse_condition = 1;

  /// Whether the end was reached.
  explicit operator bool() const { return status == MotionStatus::reached; }
  /// Returns the duration of the trajectory, s.
  double duration() const { return trajectory.duration(); }
};

/// Prints the status with its reason, or the duration, the samples, the moves, the proved deviation
/// and, if the budget ended it, the end of the search for blends.
std::ostream& operator<<(std::ostream& out, const ProgramMotion& motion);

/// Plans the moves of a program as one trajectory from rest to rest.
///
/// - Without `start` the motion begins at the waypoint of the first move, which must be a joint
///   motion or a line. Where the first move is `around`, this is a free configuration.
/// - A joint motion to a pose ends at a configuration from which the moves up to the next one are
///   possible. Of the configurations found, it ends at the one that it reaches first at the
///   velocity limits. No other move changes the branch: see move_along().
/// - A move `around` is a motion of move_around() with its default options in the scene of `model`,
///   with the parts that the tool carries at the time. The moves after it, up to where a part is
///   next attached or detached or to the next joint motion, keep the clearance. Of the
///   configurations for a pose, it ends at the one with the shortest path that is found.
/// - path_deviation() bounds the deviation of all moves except joint motions, for the trajectory
/// with
///   all its pauses, and verify() passes it. The options hold for all moves, except that a move can
///   have its own speed; `suggest` is ignored.
/// - A blend with a joint move passes the waypoint on a joint path, without a stop. It is a quintic
///   polynomial from a point of one move to a point of the next, at most as long as half of each.
///   If the motion is not proved with it, it is made smaller, and in the end a stop:
///   PlannedMove::blend. So it is where stops take less time than blends, and where a joint motion
///   turns back. Where the joints do not move between two waypoints, the arm stops.
/// - A blend between two lines is made smaller, and in the end a stop, where no motion is found
///   with it. Consecutive waypoints within 1e-5 m and rad of each other are passed in one blend, if
///   there are longer lines before and after them; otherwise the arm stops there.
/// - A dwell has a sample at both ends. With a rate it lasts a whole number of periods and has a
///   sample in each.
///
/// With options.recover the motion may begin with a recovery, as in move_along(): the first
/// move then begins at its end, PlannedMove::begin. With options.recover_clearance a first move
/// `around` may lead out of the clearance, and prove_clearance() accepts other first moves that do.
///
/// Attachments are at waypoints where the arm stops. Only moves `around` depend on them and on
/// `model`, which is the arm in its scene: its links and limits are the same, its base may be at
/// another pose. prove_clearance() with a program proves the clearance of the other moves.
///
/// `budget` limits the planning of the whole program. If its time or work ends in the search for
/// blends with joint moves, those proved by then stay: ProgramMotion::search_ending. A part of it
/// is kept for their last proof. Throws Error for a program without moves,
/// AttachmentError for a part without a name, for one that is attached twice at a time, for an end
/// before its beginning or after the last move, and at a waypoint that the tool passes without a
/// stop, and MoveError for a blend that is not between lines and joint moves or is at a dwell, for
/// a via or a configuration of a move that cannot have one, for an arc without via, for a move
/// `around` without a model, for a speed, blend or dwell out of range, for a configuration outside
/// the limits, for `recover` or `recover_clearance` out of range, for the latter without a start or
/// a model, and if path_through(), blended_lines() or move_along() throws. With a model it also
/// throws as prove_clearance() with a program does.
ProgramMotion move_program(const Arm& arm, const std::optional<Configuration>& start,
                           const Program& program, const PathMotionOptions& options = {},
                           const CollisionModel* model = nullptr);

/// Proves or refutes, from the columns only, that a trajectory is a motion of the program:
///
/// - The tool is at the waypoints in order, or the joints at Move::q, within the tolerances. They
///   are at rest there, unless a blend or a spline passes the waypoint, and for each dwell. A
///   trajectory that does not begin at the first waypoint moves there first. Rest is to the
///   tolerance of verify() for the ends; a dwell is within 1e-5 rad or m of one configuration.
/// - A blend with a joint move passes the waypoint within Move::blend, at a sample or between two.
///   A line that begins or ends in such a blend is verified from or to the sample at which the tool
///   is on it, within Move::blend of the waypoint and on the line's half there; without a sample on
///   this part of the line it is refused. Up to 16 passages are tried.
/// - A joint motion to a pose ends at a rest there before the next waypoint: it may change the
///   configuration at the same pose. Up to 16 rests are tried.
/// - verify() proves all moves except joint motions from stop to stop. A joint motion only has to
///   be within the arm's limits. A blend between two lines has the radius of move_program(), or
///   0.4, 0.16 or 0.064 of it, or the arm stops at its waypoint.
/// - The tool's speed is within the speed limit of each move; in a blend with a joint move up to
///   the passage of the waypoint, and after it within the limit of the next move.
///
/// With options.recover the motion may begin outside the position limits; the program then begins
/// at the first sample at which all joints are within them.
///
/// arrivals[i] of the result is PlannedMove::end of move i; `path` and its parameters are empty.
/// Throws Error as move_program() and verify() do, and AttachmentError for an attachment at a
/// waypoint at which the arm rests twice, away from it in between: which rest is meant is not
/// known.
Verification verify(const Arm& arm, const Trajectory& trajectory, const Program& program,
                    const VerifyOptions& options = {});

/// An attachment of a program, along a trajectory.
struct AttachedPart {
  std::string part = {};                          ///< name of the obstacle
  double attached = 0;                            ///< time at which it is attached, s
  std::optional<double> detached = std::nullopt;  ///< time at which it is detached, s
  Pose tool_T_part = Pose::Identity();            ///< pose of its first shape in the tool
  std::vector<std::string> touch = {};            ///< see Attachment::touch
};

/// Returns where a trajectory attaches the parts of a program, in the order of
/// Program::attachments. Throws Error as prove_clearance() with a program does.
std::vector<AttachedPart> attached_parts(const CollisionModel& model, const Trajectory& trajectory,
                                         const Program& program,
                                         std::span<const std::size_t> arrivals);

/// The arm with the parts that it carries, among the other obstacles, at some times of a motion.
struct ProgramScene {
  double begin = 0;      ///< time from which it is so, up to the next one, s
  CollisionModel model;  ///< arm and obstacles
};

/// Returns the scenes of a trajectory, at its beginning and from each time at which parts are
/// attached or detached. Throws Error as prove_clearance() with a program does.
std::vector<ProgramScene> program_scenes(const CollisionModel& model, const Trajectory& trajectory,
                                         const Program& program,
                                         std::span<const std::size_t> arrivals);

/// Proves or refutes prove_clearance() for a trajectory that is a motion of the program, section by
/// section: from one waypoint where a part is attached or detached to the next, against the scene
/// and with the bodies of the arm that there are in between. `model` is the arm in the scene
/// before, and `arrivals` has the sample at which each move ends, PlannedMove::end or, after
/// verify(), Verification::arrivals.
///
/// The reason says in which move. A part that is too close to a body at the waypoint where it is
/// attached or detached is refused there. ClearanceProof::pairs is the largest number in a section.
/// The motion may lead out of the clearance, ClearanceOptions::recover_clearance, before a part is
/// attached or detached at a later waypoint. Shapes are carried with a padding of some 1e-14 m, a
/// bound of the rounding of their poses.
///
/// Throws Error for arrivals that are not a sample for each move, in order; AttachmentError as
/// verify() does, for a part that is no obstacle of the scene, that is a half-space, and for an
/// unknown name in Attachment::touch; and as the other prove_clearance() does.
ClearanceProof prove_clearance(const CollisionModel& model, const Trajectory& trajectory,
                               const Program& program, std::span<const std::size_t> arrivals,
                               const ClearanceOptions& options = {});

/// clearance_over_time() of each section, one after the other. The result has no parts if no pair
/// counts in one of them. Throws Error as prove_clearance() does.
ClearanceOverTime clearance_over_time(const CollisionModel& model, const Trajectory& trajectory,
                                      const Program& program, std::span<const std::size_t> arrivals,
                                      const Budget& budget = {});

}  // namespace beeline
