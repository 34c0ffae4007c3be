#include <algorithm>
#include <cmath>

#include <beeline/kinematics/forward.h>
#include <beeline/path/internal/nearest_on_line.h>
#include <beeline/planning/internal/blend_chain.h>
#include <beeline/planning/internal/motion_request.h>
#include <beeline/planning/internal/planned_lines.h>
#include <beeline/planning/internal/program_parts.h>
#include <beeline/planning/internal/waypoint_passages.h>
#include <beeline/timing/internal/retimed_paths.h>

namespace beeline::internal {
namespace {

constexpr double margin = 0.95;   // of the deviation, for the interpolation between samples
constexpr int max_attempts = 8;   // to prove a motion, each with smaller blends than the one before
constexpr int max_additions = 3;  // of grid points to lines, before that

bool is_joint(const PlannedProgram& planned, std::size_t move) {
  return is_joint_motion(planned.program.moves[move].kind);
}

}  // namespace

BlendChain::BlendChain(const PlannedProgram& planned, const MoveRange& moves,
                       const CollisionModel* model, BudgetMeter& budget)
    : planned_(planned), moves_(moves), model_(model), budget_(budget) {
  const auto begin = planned.program.moves.begin();
  program_.moves.assign(begin + static_cast<std::ptrdiff_t>(moves.first),
                        begin + static_cast<std::ptrdiff_t>(moves.last) + 1);
  program_.moves.back().blend = program_.moves.back().dwell = 0;
  MoveRange piece{moves.first, moves.first};
  for (std::size_t i = moves.first; i <= moves.last; ++i) {
    piece.last = i;
    if (i < moves.last && continues_path(planned.program, i)) continue;
    if (i < moves.last) blends_.push_back(i);
    if (!add_piece(piece)) return;
    piece.first = i + 1;
  }
  for (std::size_t i = 0; i < blends_.size(); ++i) {
    constexpr int work = 200;  // configurations at most
    if (budget.ended(work)) {
      largest_.clear();
      return;
    }
    largest_.push_back(largest_radius(i));
  }
}

bool BlendChain::add_piece(const MoveRange& moves) {
  Piece piece{.moves = moves};
  if (!is_joint(planned_, moves.first)) {
    if (!add_path(piece)) return false;
  } else {
    const auto& positions = planned_.trajectory.positions;
    const PlannedMove& move = planned_.moves[moves.first];
    const std::optional<double>& speed = planned_.program.moves[moves.first].speed;
    piece.limited = {straight_path(positions[move.begin], positions[move.end]),
                     speed.value_or(planned_.options.tool_speed)};
  }
  pieces_.push_back(std::move(piece));
  return true;
}

/// Sets the joint path along lines; returns whether there is one.
bool BlendChain::add_path(Piece& piece) const {
  std::optional<PlannedLines> lines = planned_lines(planned_, piece.moves, budget_);
  if (!lines) return false;
  const std::vector<Segment>& segments = planned_.parts[lines->part].route.path.segments;
  const auto line = [](const Segment& segment) {
    const Line* const found = std::get_if<Line>(&segment);
    return found != nullptr ? std::optional(*found) : std::nullopt;
  };
  piece.begin = line(segments[lines->first_segment]);
  piece.end = line(segments[lines->last_segment]);
  piece.begin_length = lines->limited.tool_speeds.ends.front();
  const std::vector<double>& ends = lines->limited.tool_speeds.ends;
  piece.end_length = ends.back() - (ends.size() > 1 ? ends[ends.size() - 2] : 0);
  piece.limited = std::move(lines->limited);
  return true;
}

/// Whether a blend is within its deviation from the waypoint, and the lines beside it are followed
/// up to there.
bool BlendChain::fits(std::size_t corner, double radius) const {
  constexpr int places = 8;  // of the middle half of the blend
  const Arm& arm = planned_.arm;
  const Task& task = *planned_.options.task;
  const Move& move = planned_.program.moves[blends_[corner]];
  const Pose waypoint = waypoint_of(arm, move);
  const Piece &before = pieces_[corner], &after = pieces_[corner + 1];
  const JointPath blend = blend_between(before.limited.path, after.limited.path, radius);
  double nearest = Limits::none;
  for (int i = 0; i <= places; ++i) {
    const Configuration q = path_point(blend, 0, 0.25 + 0.5 * i / places).q;
    nearest =
        std::min(nearest, blend_distance(arm, task, move, waypoint, q, forward_kinematics(arm, q)));
  }
  const Deviation most = blend_deviation(move);
  const auto leaves_line = [&](const Line& line, const Configuration& q, bool at_end) {
    const Pose tool = forward_kinematics(arm, q);
    const double fraction = nearest_fraction(line, tool, task);
    return (at_end ? 1 - fraction : fraction) <= margin * blended_fraction &&
           within(task_deviation(task, waypoint, tool),
                  {margin * most.position, margin * most.orientation});
  };
  return nearest <= margin && (!before.end || leaves_line(*before.end, blend.q[0], true)) &&
         (!after.begin || leaves_line(*after.begin, blend.q[1], false));
}

double BlendChain::largest_radius(std::size_t corner) const {
  constexpr int bisections = 20;
  const Piece &before = pieces_[corner], &after = pieces_[corner + 1];
  const bool lines = !is_joint(planned_, before.moves.last) && !before.end;
  if (lines || (!is_joint(planned_, after.moves.first) && !after.begin)) return 0;
  const JointPath &in = before.limited.path, &out = after.limited.path;
  const Configuration& at = in.q.back();
  if (turns_back({at - in.dq.back(), at, at + out.dq.front(), 0})) return 0;
  double high = std::min(before.end ? blended_fraction * before.end_length : 0.5 * in.s.back(),
                         after.begin ? blended_fraction * after.begin_length : 0.5 * out.s.back());
  if (high < least_blend) return 0;
  if (fits(corner, high)) return high;
  double low = 0;
  for (int i = 0; i < bisections; ++i) {
    const double middle = 0.5 * (low + high);
    (fits(corner, middle) ? low : high) = middle;
  }
  return low < least_blend ? 0 : low;
}

/// Times the chain; returns why there is no motion.
Reason BlendChain::timed(const std::vector<double>& radii, BlendedMotion& motion) {
  std::vector<LimitedPath> pieces;
  for (const Piece& piece : pieces_) pieces.push_back(piece.limited);
  std::vector<JointPath> paths;
  std::vector<ToolSpeeds> speeds;
  for (LimitedPath& joined : joined_paths(pieces, radii)) {
    paths.push_back(std::move(joined.path));
    speeds.push_back(std::move(joined.tool_speeds));
  }
  RetimeOptions options = timing_options(planned_.options);
  Retimed retimed = retimed_paths(planned_.arm, paths, options, budget_, speeds);
  motion.trajectory = std::move(retimed.trajectory);
  motion.radii = radii;
  return retimed.reason;
}

/// Adds a grid point, and so a sample without a rate, in the middle between any two on lines.
void BlendChain::add_grid_points() {
  for (Piece& piece : pieces_) {
    if (is_joint(planned_, piece.moves.first)) continue;
    const JointPath& path = piece.limited.path;
    JointPath denser;
    const auto add = [&denser](double s, const PathPoint& point) {
      denser.s.push_back(s);
      denser.q.push_back(point.q);
      denser.dq.push_back(point.dq);
      denser.ddq.push_back(point.ddq);
    };
    for (std::size_t k = 0; k + 1 < path.size(); ++k) {
      add(path.s[k], path_point(path, k, 0));
      add(0.5 * (path.s[k] + path.s[k + 1]), path_point(path, k, 0.5));
    }
    add(path.s.back(), path_point(path, path.size() - 2, 1));
    piece.limited.path = std::move(denser);
  }
}

/// Halves the blends at both ends of a move, or all if none is there.
void BlendChain::make_smaller(const std::optional<std::size_t>& move,
                              std::vector<double>& radii) const {
  const auto halve = [&](const auto& selected) {
    bool changed = false;
    for (std::size_t i = 0; i < radii.size(); ++i) {
      if (radii[i] == 0 || !selected(blends_[i])) continue;
      radii[i] = radii[i] / 2 < least_blend ? 0 : radii[i] / 2;
      changed = true;
    }
    return changed;
  };
  const bool changed =
      move && halve([&](std::size_t blend) { return blend == *move || blend + 1 == *move; });
  if (!changed) halve([](std::size_t) { return true; });
}

/// Proves a motion, and sets its arrivals. Returns the move at which it is refused; none if it is
/// proved.
std::optional<std::size_t> BlendChain::faulty_move(BlendedMotion& motion) {
  VerifyOptions options = proof_options(planned_.options);
  options.budget = budget_.part();
  Verification found = verify(planned_.arm, motion.trajectory, program_, options);
  motion.fault = found.fault;
  motion.arrivals = std::move(found.arrivals);
  if (!found) return std::min(moves_.first + motion.arrivals.size(), moves_.last);
  if (model_ == nullptr) return std::nullopt;
  const ClearanceProof proof =
      prove_clearance(*model_, motion.trajectory, {.budget = budget_.part()});
  if (proof) return std::nullopt;
  std::size_t move = 0;
  while (move + 1 < motion.arrivals.size() &&
         motion.trajectory.times[motion.arrivals[move]] < proof.time) {
    ++move;
  }
  return moves_.first + move;
}

std::optional<BlendedMotion> BlendChain::proved(std::vector<double> radii) {
  int additions = planned_.options.rate > 0 ? max_additions : 0;
  for (int attempt = 0; attempt < max_attempts && !budget_.ended();) {
    if (std::all_of(radii.begin(), radii.end(), [](double r) { return r == 0; })) break;
    BlendedMotion motion;
    const Reason reason = timed(radii, motion);
    if (!budget_.complete()) break;
    std::optional<std::size_t> faulty;
    if (!reason) {
      faulty = faulty_move(motion);
      if (!budget_.complete()) break;
      if (!faulty) return motion;
      if (motion.fault == Fault::deviation && additions++ < max_additions) {
        add_grid_points();
        continue;
      }
    }
    ++attempt;
    if (2 * attempt > max_attempts) faulty.reset();  // smaller everywhere
    make_smaller(faulty, radii);
  }
  return std::nullopt;
}

/// The radii with a part of those where the limit of the tool's speed changes. The lower limit
/// holds on the whole blend, so that a smaller one may be quicker.
std::vector<double> BlendChain::smaller_at_changes(double part) const {
  std::vector<double> radii = largest_;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const double before = pieces_[i].limited.tool_speeds.limits.back();
    const double after = pieces_[i + 1].limited.tool_speeds.limits.front();
    if (before == after) continue;
    radii[i] = part * radii[i] < least_blend ? 0 : part * radii[i];
  }
  return radii;
}

std::optional<BlendedMotion> BlendChain::motion() {
  if (largest_.empty()) return std::nullopt;
  const std::vector<double>& times = planned_.trajectory.times;
  double shortest =
      times[planned_.moves[moves_.last].end] - times[planned_.moves[moves_.first].begin];
  std::optional<BlendedMotion> best;
  std::vector<std::vector<double>> tried;
  const auto attempt = [&](const std::vector<double>& radii) {
    if (std::find(tried.begin(), tried.end(), radii) != tried.end()) return;
    tried.push_back(radii);
    std::optional<BlendedMotion> found = proved(radii);
    if (!found || !(found->trajectory.duration() < shortest)) return;
    shortest = found->trajectory.duration();
    best = std::move(found);
  };
  for (const double part : {1.0, 0.25, 0.0625, 0.0}) attempt(smaller_at_changes(part));
  attempt(with_stops_below(small_blend, best ? best->radii : largest_));
  return best;
}

}  // namespace beeline::internal
