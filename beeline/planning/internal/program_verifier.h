#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <beeline/certificate/verify.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/planning/internal/program_parts.h>
#include <beeline/planning/internal/waypoint_passages.h>
#include <beeline/planning/internal/waypoint_rests.h>
#include <beeline/planning/program.h>

namespace beeline::internal {

/// Joint moves from one stop, or line, to the next, which pass the waypoints between them in
/// blends.
struct JointRun {
  /// The moves whose waypoints are passed, in order. The first may be a line, the others are joint
  /// moves.
  std::vector<std::size_t> passed = {};
  /// The joint move at whose waypoint the arm then rests; none: a line follows the last blend.
  std::optional<std::size_t> rest = std::nullopt;
  std::size_t next = 0;  ///< the part after them
};

/// Passages of the waypoint of a move, with the passage of the move before from which each is
/// possible.
struct PassageLayer {
  std::vector<Passage> passages = {};
  std::vector<std::size_t> before = {};
  std::vector<bool> stops = {};  ///< whether the arm stops at the waypoint there
};

/// Where the motion of a run may end: at a rest, or where the line after it begins.
struct RunEnd {
  std::size_t sample = 0;
  std::size_t passage = 0;  ///< the one of the last waypoint that the run passes
};

/// Proves the parts of a program one after the other. Each begins at the sample at which the one
/// before it ends.
class ProgramVerifier {
 public:
  /// All arguments must outlive the object.
  ProgramVerifier(const Arm& arm, const Trajectory& trajectory, const Program& program,
                  const VerifyOptions& options, BudgetMeter& budget);

  Verification run();

 private:
  /// The state from which a further candidate for the end of a move is verified.
  struct Progress {
    Verification result = {};
    std::size_t part = 0;   ///< the next one
    std::size_t begin = 0;  ///< the sample at which it begins
    /// The line whose end is being passed in a blend with the next joint move.
    std::optional<std::size_t> leaving = std::nullopt;
    /// The sample from which the speed of the next move counts, if not from `begin`: the line that
    /// is being left has no sample at its end, and a blend ends before its line is followed. A path
    /// that has one begins in a blend.
    std::optional<std::size_t> speed_from = std::nullopt;
    /// End of the last dwell, s.
    double dwelled_until = -std::numeric_limits<double>::infinity();
  };

  /// The end of a section of a path.
  struct SectionEnd {
    std::size_t first = 0;  ///< segment of the part
    std::size_t move = 0;   ///< its last one
    std::size_t sample = 0;
    bool is_last = false;  ///< of the program
    bool leaves = false;   ///< whether it ends in a blend with a joint move
  };

  // In program_verifier.cpp:
  bool fail(Fault fault, std::size_t k, Reason reason);
  bool fail(Fault fault, std::size_t k, std::size_t move, Reason reason);
  bool fail_to_reach(std::size_t move);
  bool end(Ending ending, const Reason& reason);
  Pose tool_at(std::size_t k) const { return rests_.tool()[k]; }
  bool check_stop(std::size_t i);
  bool check_dwell(std::size_t move);
  bool check_rest(std::size_t move);
  std::size_t speed_from() const { return now_.speed_from.value_or(now_.begin); }
  void return_to(Progress saved);

  // In program_verifier_speeds.cpp:
  /// A time as a sample plus a fraction of the interval after it.
  using SampleTime = double;
  /// When the tool is within tolerance of a waypoint.
  struct NearWaypoint {
    SampleTime begin = 0, end = 0;
  };
  std::optional<std::size_t> fast_interval(std::size_t from, std::size_t to,
                                           const std::optional<double>& limit);
  bool check_speed(std::size_t move, std::size_t from, std::size_t to,
                   const std::optional<double>& limit);
  bool check_speed(std::size_t move, std::size_t k, double from, double to,
                   const std::optional<double>& limit);
  bool check_speed_between(std::size_t move, SampleTime from, SampleTime to,
                           const std::optional<double>& limit);
  bool fail_too_fast(std::size_t move, std::size_t from, std::size_t to, std::size_t fast,
                     double limit);
  bool fail_too_fast(std::size_t move, std::size_t k, double speed, double limit);
  double offset_at(const Pose& waypoint, SampleTime at) const;
  SampleTime end_of_neighbourhood(const Pose& waypoint, SampleTime from, SampleTime bound) const;
  NearWaypoint near_waypoint(const Pose& waypoint, SampleTime first, std::size_t nearest,
                             std::size_t last) const;
  std::optional<SampleTime> check_passing(std::size_t i, std::size_t last, const Segment& segment,
                                          SampleTime from, std::size_t reached, std::size_t end);

  // In program_verifier_joints.cpp:
  bool is_followed(const Segment& segment) const;
  bool passes_after(std::size_t part) const;
  JointRun joint_run() const;
  bool check_joint_moves();
  bool check_rests(const JointRun& run, const std::vector<PassageLayer>& layers);
  bool check_line_begins(const JointRun& run, const std::vector<PassageLayer>& layers);
  bool stops_in(const Move& move, const Passage& passage) const;
  static std::vector<std::size_t> passages_before(const std::vector<PassageLayer>& layers,
                                                  double at);
  bool add_layers(const JointRun& run, std::vector<PassageLayer>& layers);
  void add_arrivals(std::span<const Passage> passed);
  bool fail_to_pass(std::size_t move, std::size_t first, const Line* line = nullptr);
  std::vector<std::size_t> joint_rests(std::size_t part, std::size_t first) const;
  bool check_passages(const JointRun& run, std::size_t next, const std::vector<Passage>& passed);
  std::vector<std::size_t> line_begins(const Line& line, std::size_t move,
                                       const Passage& passage) const;

  // In program_verifier_paths.cpp:
  bool check_path();
  bool check_path(const ProgramPart& part);
  std::vector<double> seen_blend_scales(const ProgramPart& part) const;
  std::vector<std::size_t> path_rests(const Route& route) const;
  std::vector<std::size_t> line_ends(const Line& line, std::size_t move) const;
  bool check_section(const ProgramPart& part, std::size_t first, std::size_t last, bool to_end);
  bool check_section(const ProgramPart& part, const Route& route, const SectionEnd& end);
  bool add(const Verification& found);

  /// Whether sample k is at a waypoint, within the tolerance.
  bool is_at(const Pose& waypoint, std::size_t k) const;

  /// Whether sample k is on a line, within the tolerance, at its fraction `fraction`.
  bool is_on(const Line& line, std::size_t k, double& fraction) const;

  /// Tries the candidates for the end of a move one after the other until one passes. If none does,
  /// what failed is the attempt that passed most moves, the first of them.
  template <class Candidates, class Check>
  bool check_candidates(const Candidates& candidates, const Check& check,
                        std::size_t most = max_candidates) {
    const Progress before = now_;
    std::optional<Progress> failed;
    for (std::size_t i = 0; i < std::min(candidates.size(), most); ++i) {
      return_to(before);
      if (check(candidates[i])) return true;
      if (now_.result.ending != Ending::complete) return false;
      if (!failed || now_.result.arrivals.size() > failed->result.arrivals.size()) failed = now_;
    }
    return_to(*failed);
    return false;
  }

  static constexpr std::size_t max_candidates = 16;

  const Arm& arm_;
  const Trajectory& trajectory_;
  const Program& program_;
  VerifyOptions options_;
  BudgetMeter& budget_;
  Task task_;
  WaypointRests rests_;
  WaypointPassages passages_;
  std::vector<ProgramPart> parts_ = {};
  Progress now_ = {};
  std::vector<Deviation> interval_bounds_ = {};  // 0 on joint moves
  std::vector<double> speed_bounds_ = {};        // of the tool in each interval, as far as proved
  std::size_t bounds_end_ = 0;                   // of those that the last attempt wrote
};

}  // namespace beeline::internal
