#pragma once

#include <algorithm>
#include <optional>

#include <beeline/planning/internal/track_segment.h>
#include <beeline/planning/status.h>

namespace beeline {

/// How near a motion comes to what it should stay away from.
struct Margins {
  /// The least way that a joint has left to a limit, as a share of half its range; 1 where no joint
  /// has limits.
  double limit = 1;
  /// The least inverse condition of the task's Jacobian, lengths in units of the arm's reach: 0 at
  /// a singularity.
  double dexterity = 1;
  double least() const { return std::min(limit, dexterity); }
};

/// Takes in one more configuration of the motion.
void narrow(Margins& margins, const Arm& arm, const Task& task, const Configuration& q);

/// One way of the arm along a path: what becomes of a solution at its begin that is followed
/// continuously.
struct Branch {
  Configuration start = {};
  MotionStatus status = MotionStatus::reached;
  std::string reason = {};  ///< where and why it ends; empty when it goes all the way, or not asked
  double path_parameter = 0;  ///< segments completed, the last one in part
  double limit_margin = 1;    ///< see Margins
  double dexterity = 1;
  std::vector<TrackedSegment> segments = {};  ///< a single sample where what matters stands still
};

/// Fills in the margins of the branch's samples, to the arm's limits and singularities.
void measure(const Arm& arm, const Task& task, Branch& branch);

/// Whether `a` is to be preferred: it goes farther, or stays farther from limits and singularities.
bool better(const Branch& a, const Branch& b);

struct BranchOptions {
  Task task;
  Deviation tolerance = {1e-4, 1e-4};
  std::size_t max_samples = 200'000;  ///< of one branch
  int finest_grid = 256;  ///< of plan_path(), for joints to spare: see LayeredGraphOptions::grid
  /// Whose end is explained, which takes milliseconds: all branches', or that of the one which goes
  /// farthest, or none's.
  enum class Reasons { all, best, none } reasons = Reasons::best;
  /// Where there is a choice, the configuration at a place (whole segments and a fraction) is taken
  /// next to this one; see TrackOptions::guide.
  std::function<Configuration(double)> guide = {};
  std::function<void(double)> progress = {};  ///< told the share done, in [0, 1], now and then
};

/// Every branch of the arm along the path, those that go all the way first, and of these the one
/// farthest from limits and singularities first. Each is followed without the limits of joints that
/// turn around; then every such joint gets the turn at which it stays farthest within its limits.
/// For arms without joints to spare, where inverse kinematics finds all solutions. Empty when it
/// finds none for the path's begin. Throws Error for a path without segments, and what check_task()
/// refuses.
std::vector<Branch> track_branches(const Arm& arm, const ToolPath& path,
                                   const BranchOptions& options);

/// The same for the one branch that begins at `start`, within the limits as they are.
Branch track_branch(const Arm& arm, const Configuration& start, const ToolPath& path,
                    const BranchOptions& options);

/// Says why the branch ends before the path does: its status and reason. Does nothing where that
/// has been said, or where it goes all the way.
void explain(const Arm& arm, const ToolPath& path, const BranchOptions& options, Branch& branch);

}  // namespace beeline
