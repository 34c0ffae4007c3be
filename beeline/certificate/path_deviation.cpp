#include <algorithm>
#include <cmath>

#include <beeline/certificate/internal/line_step.h>
#include <beeline/certificate/path_deviation.h>
#include <beeline/error.h>
#include <beeline/kinematics/forward.h>
#include <beeline/path/internal/nearest_on_line.h>
#include <beeline/path/internal/nearest_parameter.h>

namespace beeline {

void check_task(const Arm& arm, const Piece& piece, const Task& task) {
  check_task(task);
  if (!std::holds_alternative<Line>(piece)) check_matched(arm, piece, task);
}

void check_task(const Arm& arm, const ToolPath& path, const Task& task) {
  if (path.pieces.empty()) throw Error("a path needs pieces");
  for (const Piece& piece : path.pieces) check_task(arm, piece, task);
}

void check_route(const Arm& arm, const Route& route, const Task& task) {
  const std::size_t pieces = route.path.pieces.size();
  if (pieces == 0 || route.stops.size() != pieces || route.path.spans.size() != pieces) {
    throw Error("a route needs pieces, and for each its span and whether the arm stops behind it");
  }
  check_task(arm, route.path, task);
}

bool all_lines(const ToolPath& path) {
  return std::all_of(path.pieces.begin(), path.pieces.end(),
                     [](const Piece& piece) { return std::holds_alternative<Line>(piece); });
}

bool stands_still(const Piece& piece, const Task& task) {
  constexpr double nothing = 1e-9;
  const Pose begin = pose_at(piece, 0);
  const auto there = [&](double s) {
    return within(task_deviation(task, pose_at(piece, s), begin), {nothing, nothing});
  };
  return there(1) && there(0.5) && there(0.25);
}

Deviation deviation_from(const Piece& piece, double s, const Pose& pose, const Task& task) {
  if (const auto* line = std::get_if<Line>(&piece)) return deviation_from(*line, pose, task);
  return task_deviation(task, pose_at(piece, s), pose);
}

Deviation deviation_from(const ToolPath& path, double place, const Pose& pose, const Task& task) {
  const std::size_t i = piece_at(path, place);
  return deviation_from(path.pieces[i], place - static_cast<double>(i), pose, task);
}

Deviation step_bound(const Arm& arm, const Piece& piece, const Task& task, const StepEnd& a,
                     const StepEnd& b) {
  const auto* line = std::get_if<Line>(&piece);
  if (line == nullptr) return matched_step_bound(arm, piece, task, a, b);
  return line_step_bound(arm, *line, task, a.q, b.q, a.off, b.off);
}

std::vector<PieceStep> cut_at_pieces(const ToolPath& path, const Task& task,
                                     const ConfigurationRef& q_a, double place_a,
                                     const ConfigurationRef& q_b, double place_b) {
  const auto last = static_cast<double>(path.pieces.size() - 1);
  const auto first_piece = static_cast<std::size_t>(std::clamp(std::floor(place_a), 0.0, last));
  const std::size_t last_piece = std::max(first_piece, piece_at(path, place_b));
  if (first_piece == last_piece) {
    const auto done = static_cast<double>(first_piece);
    return {{first_piece, q_a, q_b, place_a - done, place_b - done}};
  }
  std::vector<PieceStep> steps;
  std::vector<double> ways;
  double whole = 0;
  for (std::size_t i = first_piece; i <= last_piece; ++i) {
    const auto done = static_cast<double>(i);
    const double s_a = std::max(place_a - done, 0.0), s_b = std::min(place_b - done, 1.0);
    steps.push_back({i, {}, {}, s_a, s_b});
    ways.push_back(stands_still(path.pieces[i], task) ? 0 : (s_b - s_a) * path.spans[i]);
    whole += ways.back();
  }
  double way = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const auto at = [&](double share) { return Configuration(q_a + share * (q_b - q_a)); };
    steps[i].q_a = i == 0 ? Configuration(q_a) : steps[i - 1].q_b;
    way += ways[i];
    steps[i].q_b = i + 1 == steps.size() ? Configuration(q_b) : at(whole > 0 ? way / whole : 0);
  }
  return steps;
}

MeasuredStep measured(const Arm& arm, const ToolPath& path, const Task& task,
                      const PieceStep& step) {
  const Piece& piece = path.pieces[step.piece];
  const auto end = [&](const Configuration& q, double s) {
    return StepEnd{q, s, deviation_from(piece, s, forward_kinematics(arm, q), task)};
  };
  const Configuration half_way = (step.q_a + step.q_b) / 2;
  const StepEnd a = end(step.q_a, step.s_a), b = end(step.q_b, step.s_b);
  const StepEnd middle = end(half_way, (step.s_a + step.s_b) / 2);
  const Deviation whole = step_bound(arm, piece, task, a, b);
  Deviation halves = step_bound(arm, piece, task, a, middle);
  grow(halves, step_bound(arm, piece, task, middle, b));
  return {
      a.off,
      middle.off,
      b.off,
      {std::min(whole.position, halves.position), std::min(whole.orientation, halves.orientation)}};
}

void check_places(const ToolPath& path, std::span<const double> places) {
  const auto pieces = static_cast<double>(path.pieces.size());
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (places[k] >= (k > 0 ? places[k - 1] : 0) && places[k] <= pieces) continue;
    throw Error("the place of sample " + std::to_string(k + 1) +
                " is not on the path, in order: " + number(places[k]));
  }
}

PathDeviation path_deviation(const Arm& arm, std::span<const Configuration> samples,
                             std::span<const double> places, const ToolPath& path,
                             const Task& task) {
  if (samples.empty() || samples.size() != places.size()) {
    throw Error("path_deviation needs samples, and a place on the path for each");
  }
  check_task(arm, path, task);
  check_places(path, places);
  PathDeviation result;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const Pose pose = forward_kinematics(arm, samples[k]);
    grow(result.sampled, deviation_from(path, places[k], pose, task));
    if (k == 0) continue;
    const auto steps =
        cut_at_pieces(path, task, samples[k - 1], places[k - 1], samples[k], places[k]);
    for (const PieceStep& step : steps) {
      const MeasuredStep seen = measured(arm, path, task, step);
      for (const Deviation& off : {seen.begin, seen.middle, seen.end}) grow(result.measured, off);
      grow(result.bound, seen.bound);
    }
  }
  grow(result.measured, result.sampled);
  grow(result.bound, result.sampled);
  return result;
}

std::vector<double> places_along(const Arm& arm, std::span<const Configuration> samples,
                                 const ToolPath& path, std::span<const std::size_t> arrivals,
                                 const Task& task) {
  if (samples.empty() || arrivals.size() > path.pieces.size()) {
    throw Error("places need samples, and an arrival for each piece of the path");
  }
  std::vector<double> places{0};
  for (std::size_t i = 0; i < arrivals.size(); ++i) {
    const auto end = static_cast<double>(i + 1);
    if (arrivals[i] + 1 < places.size() || arrivals[i] >= samples.size()) {
      throw Error("arrival " + std::to_string(i + 1) + " is not among the samples, in order");
    }
    for (std::size_t k = places.size(); k <= arrivals[i]; ++k) {
      const Pose pose = forward_kinematics(arm, samples[k]);
      places.push_back(nearest_place(path, task, pose, std::max(places.back(), end - 1), end));
    }
    places.back() = end;
  }
  places.resize(samples.size(), places.back());
  return places;
}

std::vector<std::size_t> arrivals(std::span<const double> places) {
  std::vector<std::size_t> all;
  for (std::size_t k = 0; k < places.size(); ++k) {
    while (places[k] >= static_cast<double>(all.size() + 1)) all.push_back(k);
  }
  return all;
}

}  // namespace beeline
