#include <algorithm>
#include <cmath>

#include <beeline/draw/path_trace.h>
#include <beeline/error.h>
#include <beeline/kinematics/forward.h>
#include <beeline/path/internal/nearest_on_line.h>

namespace beeline {
namespace {

/// The part of a vector in the position rows that matter, for a tool at `pose`, in the world's
/// axes.
Vector3 in_rows(const Task& task, const Pose& pose, const Vector3& v) {
  const Vector3 kept = in_position_rows(task, pose, v);
  const bool turned = task.frame == Frame::tool && task.positions() < 3;
  return turned ? Vector3(pose.linear() * kept) : kept;
}

/// A piece with its place among the others.
struct Stretch {
  const Piece& piece;
  double begin = 0, length = 0;
};

PathTrace::Place place_of(const Arm& arm, const Configuration& q, double s, std::size_t step,
                          const Stretch& stretch, const Task& task) {
  const Pose pose = forward_kinematics(arm, q);
  if (const auto* line = std::get_if<Line>(&stretch.piece)) s = nearest_fraction(*line, pose, task);
  const Pose wanted = pose_at(stretch.piece, s);
  return {step, stretch.begin + s * stretch.length, task_deviation(task, wanted, pose),
          pose.translation(), in_rows(task, pose, pose.translation() - wanted.translation())};
}

/// The ends of lines, and 32 chords of other pieces.
std::vector<Vector3> course_of(const ToolPath& path) {
  std::vector<Vector3> course{pose_at(path, 0).translation()};
  for (const Piece& piece : path.pieces) {
    const int chords = std::holds_alternative<Line>(piece) ? 1 : 32;
    for (int i = 1; i <= chords; ++i) {
      course.push_back(pose_at(piece, static_cast<double>(i) / chords).translation());
    }
  }
  return course;
}

}  // namespace

PathTrace trace_path(const Arm& arm, std::span<const Configuration> samples,
                     const FollowedPath& followed) {
  const ToolPath& path = followed.path;
  const std::vector<double>& places = followed.places;
  const Task& task = followed.task;
  if (places.empty() || places.size() > samples.size() || path.pieces.empty() ||
      path.spans.size() != path.pieces.size()) {
    throw Error("a trace along a path needs its pieces, samples, and their places");
  }
  check_places(path, places);
  constexpr std::size_t wanted = 3000;  // measured; a chart shows no more
  const std::size_t parts = std::clamp<std::size_t>(wanted / samples.size(), 2, 16);
  PathTrace trace;
  trace.course = course_of(path);
  std::vector<Stretch> stretches;
  double begin = 0;
  for (const Piece& piece : path.pieces) {
    const Pose from = pose_at(piece, 0), to = pose_at(piece, 1);
    const double turn = way_of_a_radian * pose_difference(to, from).tail<3>().norm();
    const double length = length_of(piece);
    stretches.push_back({piece, begin, std::max(length, turn)});
    trace.turns_only = trace.turns_only || length < turn;
    begin += stretches.back().length;
  }
  std::size_t on = path.pieces.size();  // the piece before
  for (std::size_t k = 1; k < places.size(); ++k) {
    for (const PieceStep& step :
         cut_at_pieces(path, task, samples[k - 1], places[k - 1], samples[k], places[k])) {
      const Stretch& stretch = stretches[step.piece];
      const auto at = [&](double share, std::size_t number) {
        return place_of(arm, step.q_a + share * (step.q_b - step.q_a),
                        std::lerp(step.s_a, step.s_b, share), number, stretch, task);
      };
      if (step.piece != on) trace.places.push_back(at(0, 0));
      on = step.piece;
      const double from = trace.places.back().way;
      for (std::size_t part = 1; part <= parts; ++part) {
        trace.places.push_back(at(static_cast<double>(part) / static_cast<double>(parts), k));
      }
      trace.steps.push_back({from, trace.places.back().way, measured(arm, path, task, step).bound});
    }
  }
  if (trace.places.empty()) {
    trace.places.push_back(place_of(arm, samples.front(), 0, 0, stretches.front(), task));
  }
  const std::size_t reached = arrivals(places).size();
  for (std::size_t i = 0; i < reached; ++i) {
    trace.ends.push_back(stretches[i].begin + stretches[i].length);
  }
  return trace;
}

}  // namespace beeline
