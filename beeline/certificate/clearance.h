#pragma once

#include <iosfwd>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <beeline/budget.h>
#include <beeline/collision/collision_model.h>
#include <beeline/error.h>
#include <beeline/reason.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline {

/// The answer of prove_clearance().
enum class ClearanceStatus {
  clear,        ///< proved: at all times each pair keeps its clearance
  collides,     ///< proved: at `time` a pair is closer than its clearance
  not_decided,  ///< from `begin` to `end` a pair is nearer to its clearance than the resolution
  time_limit,   ///< the budget ended the search before an answer
  cancelled,    ///< likewise
  work_limit,   ///< likewise
};
std::string name(ClearanceStatus status);
std::ostream& operator<<(std::ostream& out, ClearanceStatus status);  ///< name(status)

struct ClearanceOptions {
  /// Distance to the clearance below which a pair is not decided, as a fraction of the clearance,
  /// 1e-6 to 1.
  double resolution = 0.01;
  /// Whether a motion that is clear is examined for its closest approach: `pair` and `time` are
  /// set, and `least_distance` is raised to within 2 % of their distance where that can be proved.
  bool closest = false;
  /// Largest depth from which the motion may lead out of the clearance, m, 0 to
  /// max_recover_clearance: by how much pairs may be closer than their clearance at the first
  /// sample, to 1e-9 m. See ClearanceRecovery.
  double recover_clearance = 0;
  Budget budget = {};
};

/// The largest depth from which a motion may lead out of the clearance, m.
constexpr double max_recover_clearance = 0.1;

/// The beginning of a motion that starts closer than the clearance, or in contact, and leads out.
/// Let d(t) be the signed distance of a pair: the distance or, in contact, the negative depth. Let
/// l(t) <= d(t) be its lower bound, BodyDistance::lower, which is d(t) to rounding for bodies that
/// are apart, and may be far below it for bodies in contact. The beginning is divided into 64 parts
/// or more, at its samples and between them. For each pair that is not proved to keep its clearance
/// c at the start, and for the first time a of each part, it is proved that
///
///     d(t) >= min(c, l(a)) - 1e-9 m    for all t from a to the end of the beginning,
///
/// to the rounding of the joint values. So a pair that is apart never comes closer than it is at
/// the start, its distances at these times do not fall, and it keeps its clearance as soon as it
/// does at one of them, all to 1e-9 m. Of a pair in contact the bound l does not fall: the contact
/// may become deeper, down to the `distance` that is reported. All other pairs keep their clearance
/// from the start, and all pairs keep it after the beginning.
struct ClearanceRecovery {
  NamedPair names = {};   ///< the deepest pair at the start
  double depth = 0;       ///< its clearance less its signed distance there, m, rounded up
  double distance = 0;    ///< its signed distance there, m, rounded down
  std::size_t pairs = 0;  ///< number of pairs that are not proved to keep their clearance there
  /// Index of the first sample at which all pairs keep their clearance, with a thousandth of it to
  /// spare where a sample does; of the last one if there is none.
  std::size_t sample = 0;
  double time = 0;  ///< time of that sample, s
};

/// The proof that a motion keeps its clearance, or the first place where it does not.
struct ClearanceProof {
  ClearanceStatus status = ClearanceStatus::not_decided;  ///< answer
  Reason reason = {};  ///< bodies, time, place and distance; none if `status` is clear
  /// Lower bound of the distances of all pairs that count, at all times, m, rounded down, if
  /// `status` is clear; infinite without pairs. -infinity, which bounds nothing, for any other
  /// status. With a recovery, at all times after it.
  double least_distance = -std::numeric_limits<double>::infinity();
  /// The pair that is too close, or that is not decided. If `status` is clear, the pair of the
  /// closest approach that was found, with ClearanceOptions::closest; else without names.
  BodyDistance pair = {};
  double time = 0;        ///< time of `pair`, s
  double begin = 0;       ///< everything before this time is proved, s
  double end = 0;         ///< end of the first time that is not decided, s
  std::size_t parts = 0;  ///< number of parts of the motion that were examined
  /// Number of pairs that count: CollisionModel::pair_count(), and CollisionModel::apart_count()
  /// if the motion leaves the position limits.
  std::size_t pairs = 0;
  /// The beginning that leads out of the clearance, with ClearanceOptions::recover_clearance; of a
  /// motion that starts clear none. If `status` is not clear, only what it says of the start holds.
  std::optional<ClearanceRecovery> recovery = std::nullopt;

  /// Returns whether the motion is proved to keep its clearance, after its recovery if it has one.
  explicit operator bool() const { return status == ClearanceStatus::clear; }
};

/// Prints `clear, each of the 12 pairs that count keeps at least 0.05 m`, or the status with its
/// reason.
std::ostream& operator<<(std::ostream& out, const ClearanceProof& proof);

/// Proves or refutes that each pair of the model keeps its clearance at all times of the motion
/// that the trajectory, matched_to() the model's arm, means by its columns (see Interpolation).
///
/// Let n be a unit vector that is fixed to a body B, and h_A(n) the maximum of n . x over the
/// points of a body A. Then A and B are at least -h_B(-n) - h_A(n) apart, for any n. The motion is
/// divided into parts. In each part the joints are within a tube about a straight joint motion, and
/// h_A is bounded over the tube by its first-order motion and the remainder of Taylor's theorem
/// (collision/internal/tube_gap.h, chain_motion.h). A part for which no n suffices is halved. An
/// algorithm for the nearest points proposes n: a wrong one costs a division, and never a proof.
/// All bounds include the rounding errors of their evaluation.
///
/// A motion that starts closer than the clearance collides, unless the depth is at most
/// ClearanceOptions::recover_clearance and the motion leads out: see ClearanceRecovery. The bound
/// above holds for signed distances, too.
///
/// Throws Error where matched_to() does, for a trajectory without samples, and for options out of
/// their range.
ClearanceProof prove_clearance(const CollisionModel& model, const Trajectory& trajectory,
                               const ClearanceOptions& options = {});

/// The least distance beyond the clearance, over time, of the pairs that count
/// (ClearanceProof::pairs).
struct ClearanceOverTime {
  std::vector<double> times = {};  ///< begin of the first part, then the end of each, s, (m + 1,)
  /// Distance that each pair is proved to keep beyond its clearance at all times of a part, m,
  /// (m,). It is below 0 if only less than the clearance is proved.
  std::vector<double> proved = {};
  std::vector<double> sample_times = {};  ///< times of `sampled`, s, (k,)
  std::vector<double> sampled = {};  ///< least distance beyond the clearance, m, rounded up, (k,)
  /// The clearance of all pairs, m; none if an obstacle has another one.
  std::optional<double> clearance = std::nullopt;
  /// How the computation ended: the parts are up to there.
  Ending ending = Ending::complete;
};

/// Divides a motion into some hundred parts. In each part, samples the distances at five times and
/// proves a lower bound of them at all times, as prove_clearance() does. The bound is tried half a
/// percent below the least sampled distance, then at lower values; it never rests on the samples.
/// The result has no parts if no pair counts. Throws Error where prove_clearance() does.
ClearanceOverTime clearance_over_time(const CollisionModel& model, const Trajectory& trajectory,
                                      const Budget& budget = {});

}  // namespace beeline
