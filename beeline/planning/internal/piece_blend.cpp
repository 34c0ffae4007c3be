#include <algorithm>
#include <cmath>

#include <beeline/kinematics/forward.h>
#include <beeline/planning/internal/piece_blend.h>
#include <beeline/planning/internal/waypoint_distance.h>
#include <beeline/timing/internal/blended_path.h>

namespace beeline::internal {
namespace {

// Of the deviation. The rest is for the samples, of which one is near the waypoint.
constexpr double planned_blend = 0.8;
constexpr double line_part = 0.45;  // of a line that a blend replaces at most
constexpr double joint_part = 0.5;  // of a joint motion
constexpr double snap = 0.95;       // of a length; a grid point as near to its end is taken
constexpr int bisections = 24, tests = 16;

constexpr double touching = 1e-12;  // length of a motion between two blends; shorter, they touch

void append_point(JointPath& path, double s, const PathPoint& point) {
  if (!path.s.empty() && s - path.s.back() <= touching) return;
  path.s.push_back(s);
  path.q.push_back(point.q);
  path.dq.push_back(point.dq);
  path.ddq.push_back(point.ddq);
}

/// The path of a blend, from 0 to the sum of its lengths.
JointPath blend_path(const PieceBlend& blend, const MovePiece& before, const MovePiece& after) {
  JointPath path;
  append_point(path, 0, before.at(before.length() - blend.before));
  append_point(path, blend.before + blend.after, after.at(blend.after));
  return path;
}

/// Whether a blend leaves the parts of both lines that it must.
bool leaves_lines(const PieceBlend& blend, const MovePiece& before, const MovePiece& after) {
  const auto fraction = [](const MovePiece& piece, double s, std::size_t segment) {
    return piece.tool->path_parameter(piece.at(s).q, s, 0) - static_cast<double>(segment);
  };
  if (before.tool &&
      fraction(before, before.length() - blend.before, before.last_segment) < 1 - line_part) {
    return false;
  }
  return !after.tool || fraction(after, blend.after, after.first_segment) <= line_part;
}

/// The grid point of a path a little nearer to an end than `length`, or the length itself.
double snapped(const MovePiece& piece, double length, bool from_end) {
  double best = 0;
  for (const double s : piece.path.s) {
    const double here = from_end ? piece.length() - s : s;
    if (here <= length && here > best) best = here;
  }
  return piece.tool && best >= snap * length ? best : length;
}

PieceBlend of_radius(double radius, const MovePiece& before, const MovePiece& after) {
  PieceBlend blend{.asked_for = true};
  blend.before = snapped(before, radius, true);
  blend.after = snapped(after, radius, false);
  return blend;
}

}  // namespace

PieceBlend largest_piece_blend(const Arm& arm, const Task& task, const Move& move,
                               const MovePiece& before, const MovePiece& after) {
  PieceBlend none{.asked_for = true};
  if (before.path.size() == 0 || after.path.size() == 0) {
    none.reason = {ReasonCode::blend_turns_back};
    return none;
  }
  if (turns_back(before.path.dq.back().normalized(), after.path.dq.front().normalized())) {
    none.reason = {ReasonCode::blend_turns_back};
    return none;
  }
  const Deviation tolerance = blend_tolerance(move);
  const Deviation most{planned_blend * tolerance.position, planned_blend * tolerance.orientation};
  const auto deviates = [&](const ConfigurationRef& a, const ConfigurationRef& b) {
    return !within(task_deviation(task, forward_kinematics(arm, a), forward_kinematics(arm, b)),
                   most) ||
           (move.q && joint_distance(arm, a, b, most) > 1);
  };
  const auto fits = [&](double radius) {
    const PieceBlend blend{.before = radius, .after = radius};
    if (!leaves_lines(blend, before, after)) return false;
    const JointPath path = blend_path(blend, before, after);
    for (int i = 1; i < tests; ++i) {
      const double s = radius * (2.0 * i / tests - 1);  // from the waypoint
      const Configuration given = s < 0 ? before.at(before.length() + s).q : after.at(s).q;
      if (deviates(given, path_point(path, 0, double(i) / tests).q)) return false;
    }
    return true;
  };
  double low = 0;
  double high = joint_part * std::min(before.length_beside_end(), after.length_beside_begin());
  if (fits(high)) low = high;
  for (int i = 0; i < bisections && low < high; ++i) {
    const double middle = 0.5 * (low + high);
    (fits(middle) ? low : high) = middle;
  }
  if (low >= least_blend) return of_radius(low, before, after);
  none.reason = {ReasonCode::blend_smaller, {{ReasonField::radius, 0.0}}};
  return none;
}

PieceBlend halved(const PieceBlend& blend, const MovePiece& before, const MovePiece& after,
                  const Reason& reason) {
  const double radius = 0.5 * std::min(blend.before, blend.after);
  PieceBlend smaller{.asked_for = true};
  if (radius >= least_blend) smaller = of_radius(radius, before, after);
  smaller.reason = {ReasonCode::blend_smaller, {{ReasonField::radius, smaller.radius()}}, {reason}};
  return smaller;
}

JointPath joined(const std::vector<const MovePiece*>& pieces,
                 const std::vector<PieceBlend>& blends) {
  JointPath path;
  double offset = 0;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const MovePiece& piece = *pieces[k];
    const double begin = k == 0 ? 0 : blends[k - 1].after;
    const double end = piece.length() - (k + 1 < pieces.size() ? blends[k].before : 0);
    append_point(path, offset + begin, piece.at(begin));
    for (std::size_t i = 0; i < piece.path.size(); ++i) {
      const double s = piece.path.s[i];
      if (!(s > begin && s < end)) continue;
      append_point(path, offset + s, {piece.path.q[i], piece.path.dq[i], piece.path.ddq[i], {}});
    }
    append_point(path, offset + end, piece.at(end));
    offset += piece.length();
  }
  return path;
}

}  // namespace beeline::internal
