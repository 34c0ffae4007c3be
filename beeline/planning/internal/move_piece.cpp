#include <algorithm>
#include <cmath>

#include <beeline/planning/internal/move_piece.h>

namespace beeline::internal {
namespace {

constexpr double at_rest_length = 1e-12;   // radians or metres
constexpr double samples_of_segment = 32;  // that the joint path passes through, about

/// The samples of a motion from one to another, with some distance between them, and the ends of
/// segments.
BranchSection spaced_samples(const PathMotion& motion, std::size_t first, std::size_t last,
                             double spacing) {
  const auto& q = motion.trajectory.positions;
  const auto& parameters = motion.path_parameters;
  const auto ends_segment = [&](double s) { return s == std::floor(s); };
  BranchSection section{{q[first]}, {parameters[first]}};
  for (std::size_t k = first + 1; k <= last; ++k) {
    const double chord = (q[k] - section.samples.back()).norm();
    const bool ends = k == last || ends_segment(parameters[k]);
    if (chord <= at_rest_length) {
      if (ends) section.path_parameters.back() = parameters[k];
      continue;
    }
    if (chord < spacing && !ends) continue;
    const bool crowded = section.samples.size() > 1 && chord < 0.5 * spacing &&
                         !ends_segment(section.path_parameters.back());
    if (crowded) section.samples.pop_back(), section.path_parameters.pop_back();
    section.samples.push_back(q[k]);
    section.path_parameters.push_back(parameters[k]);
  }
  return section;
}

/// Whether the samples have the end of each segment.
bool has_segment_ends(const BranchSection& section, std::size_t first, std::size_t last) {
  std::size_t ends = 0;
  for (const double s : section.path_parameters) ends += s == std::floor(s) ? 1 : 0;
  return ends == last - first + 2;
}

ToolSpeeds speeds_of(const ProgramPart& part, const MovePiece& piece) {
  ToolSpeeds speeds;
  speeds.ends.clear();
  speeds.limits.clear();
  for (std::size_t i = piece.first_segment; i <= piece.last_segment; ++i) {
    speeds.limits.push_back(part.route.speeds[i]);
    speeds.ends.push_back(i == piece.last_segment
                              ? piece.length()
                              : piece.tool->parameter_at(static_cast<double>(i + 1)));
  }
  return speeds;
}

}  // namespace

PathPoint MovePiece::at(double s) const {
  const auto next = std::lower_bound(path.s.begin() + 1, path.s.end() - 1, s);
  const auto k = static_cast<std::size_t>(next - path.s.begin()) - 1;
  return path_point(path, k, std::clamp((s - path.s[k]) / (path.s[k + 1] - path.s[k]), 0.0, 1.0));
}

double MovePiece::length_beside_end() const {
  return first_segment == last_segment
             ? length()
             : length() - tool->parameter_at(static_cast<double>(last_segment));
}

double MovePiece::length_beside_begin() const {
  return first_segment == last_segment ? length()
                                       : tool->parameter_at(static_cast<double>(first_segment + 1));
}

MovePiece joint_piece(const ProgramPart& part, std::size_t index, const Configuration& from,
                      const Configuration& to, double tool_speed) {
  MovePiece piece{.part = index, .last_move = part.last};
  piece.speeds = {tool_speed};
  const double length = (to - from).norm();
  if (length <= at_rest_length) return piece;
  const Configuration direction = (to - from) / length, none = Configuration::Zero(from.size());
  piece.path = {{0, length}, {from, to}, {direction, direction}, {none, none}};
  return piece;
}

std::vector<MovePiece> path_pieces(const MotionRequest& request, const ProgramPart& part,
                                   std::size_t index, const PathMotion& motion,
                                   BudgetMeter& budget) {
  std::vector<MovePiece> pieces;
  const std::size_t segments = part.route.path.segments.size();
  std::size_t first = 0, begin = 0;
  for (std::size_t i = 0; i < segments; ++i) {
    if (!part.route.stops[i] && i + 1 < segments) continue;
    const std::size_t end = motion.arrivals[i];
    MovePiece piece{.part = index, .first_segment = first, .last_segment = i};
    piece.last_move = i + 1 < segments ? part.moves[i + 1] - 1 : part.last;
    const auto& q = motion.trajectory.positions;
    double length = 0;
    for (std::size_t k = begin + 1; k <= end; ++k) length += (q[k] - q[k - 1]).norm();
    if (length > at_rest_length) {
      const double spacing = length / (samples_of_segment * static_cast<double>(i - first + 1));
      BranchSection samples = spaced_samples(motion, begin, end, spacing);
      samples.path_parameters.front() = static_cast<double>(first);
      samples.path_parameters.back() = static_cast<double>(i + 1);
      if (!has_segment_ends(samples, first, i)) return {};
      piece.tool = std::make_shared<SectionJointPath>(request, std::move(samples), budget);
      piece.path = piece.tool->joint_path();
      piece.speeds = speeds_of(part, piece);
    }
    pieces.push_back(std::move(piece));
    first = i + 1;
    begin = end;
  }
  return pieces;
}

}  // namespace beeline::internal
