#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include <beeline/error.h>
#include <beeline/kinematics/forward.h>
#include <beeline/motion/chord.h>
#include <beeline/motion/matched.h>
#include <beeline/motion/path/off_chord.h>
#include <beeline/motion/path/turning.h>

namespace beeline {
namespace {

int rows(const Task& task, std::size_t first) {
  return task.rows[first] + task.rows[first + 1] + task.rows[first + 2];
}

/// The tool and the piece both stand upright all the way.
bool planar(const Arm& arm, const Piece& piece) {
  constexpr double tilt = 1e-9;
  const Rotation r = pose_at(piece, 0).linear();
  return arm.planar() && turns_about_z(piece) && r.col(2).head<2>().norm() <= tilt && r(2, 2) > 0;
}

/// Most of the angle f between the tool's orientation and the piece's, which at the ends is `ends`
/// at most. Between two shortest turns in SO(3), a sphere of radius 2, the distance exceeds that of
/// their ends by 1 / cos(angle/4) at most (Jacobi's equation): that is one bound. The other needs
/// f < pi, as it is where half of either turn and `ends` do not come to it.
double turn_between(const ChordBound& tool, const OffChord& way, double ends) {
  using std::numbers::pi;
  const double angle = tool.turned + 2 * ends, most = std::max(tool.turned, way.turned);
  double bound = pi;
  if (angle < pi) bound = ends / std::cos(angle / 4) + tool.orientation + way.orientation;
  if (most + ends < pi) {
    const double swing = (tool.swing - way.swing).norm() + tool.swing_rest + way.swing_rest;
    const double k = most * std::numbers::inv_sqrtpi;
    bound = std::min(bound, ends / std::cos(k / 2) + swing_bound(swing, most));
  }
  return std::min(bound, pi);
}

}  // namespace

Deviation matched_step_bound(const Arm& arm, const Piece& piece, const Task& task, const StepEnd& a,
                             const StepEnd& b) {
  const ChordBound tool = chord_bound(arm, a.q, b.q);
  const OffChord way = off_chord(piece, a.s, b.s);
  Deviation bound;
  if (rows(task, 0) > 0) {
    bound.position = std::max(a.off.position, b.off.position) +
                     std::min(tool.position + way.position,
                              (tool.bend - way.bend).norm() + tool.rest + way.rest);
  }
  if (rows(task, 3) > 0) {
    const double ends = std::max(a.off.orientation, b.off.orientation);
    bound.orientation = turn_between(tool, way, ends);
  }
  return bound;
}

void check_matched(const Arm& arm, const Piece& piece, const Task& task) {
  const int positions = rows(task, 0), turns = rows(task, 3);
  const bool whole =
      turns % 3 == 0 || (task.rows[5] && task.frame == Frame::base && planar(arm, piece));
  if (task.frame == Frame::space || !whole || (positions % 3 != 0 && task.frame != Frame::base)) {
    throw Error("the task " + name(task) +
                " is followed along straight lines alone: other pieces need all position rows or "
                "none, and all orientation rows or none; a planar arm its rows in the plane");
  }
}

Straightness closeness(const Arm& arm, std::span<const Configuration> samples,
                       std::span<const double> places, const ToolPath& path, const Task& task) {
  const auto pieces = static_cast<double>(path.pieces.size());
  if (samples.empty() || samples.size() != places.size()) {
    throw Error("closeness needs samples, and a place on the path for each");
  }
  for (const Piece& piece : path.pieces) check_matched(arm, piece, task);
  if (path.pieces.empty()) throw Error("a path needs pieces");
  Straightness result;
  std::optional<StepEnd> before;
  std::size_t piece = 0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const double done = static_cast<double>(piece);
    if (!(places[k] >= (k > 0 ? places[k - 1] : 0)) || places[k] > std::min(done + 1, pieces)) {
      throw Error("the place of sample " + std::to_string(k + 1) +
                  " is not on the path, in order, with the end of every piece");
    }
    const Pose pose = forward_kinematics(arm, samples[k]);
    const auto end_on = [&](std::size_t i) {
      const double s = places[k] - static_cast<double>(i);
      const Deviation off = task_deviation(task, pose_at(path.pieces[i], s), pose);
      grow(result.sampled, off);
      grow(result.bound, off);
      return StepEnd{samples[k], s, off};
    };
    const StepEnd now = end_on(piece);
    if (before) {
      const Piece& on = path.pieces[piece];
      const Pose middle = forward_kinematics(arm, (samples[k - 1] + samples[k]) / 2);
      const Pose wanted = pose_at(on, (before->s + now.s) / 2);
      grow(result.measured, task_deviation(task, wanted, middle));
      grow(result.bound, matched_step_bound(arm, on, task, *before, now));
    }
    const bool next = now.s == 1 && piece + 1 < path.pieces.size();
    before.emplace(next ? end_on(++piece) : now);
  }
  grow(result.measured, result.sampled);
  return result;
}

}  // namespace beeline
