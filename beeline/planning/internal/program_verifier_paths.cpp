#include <array>
#include <cmath>

#include <beeline/certificate/internal/path_checks.h>
#include <beeline/planning/internal/blend_refusals.h>
#include <beeline/planning/internal/program_verifier.h>
#include <beeline/trajectory/internal/append.h>

namespace beeline::internal {
namespace {

/// The segments of a part from one stop to the next.
Route section_of(const ProgramPart& part, std::size_t first, std::size_t last) {
  const auto slice = [&](const auto& all) {
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first);
    return std::decay_t<decltype(all)>(begin,
                                       begin + static_cast<std::ptrdiff_t>(last - first) + 1);
  };
  const ToolPath& path = part.route.path;
  return {{slice(path.segments), slice(path.spans), slice(path.names)}, slice(part.route.stops)};
}

void replace_line(Route& route, std::size_t segment, const Line& line) {
  route.path.segments[segment] = line;
  route.path.spans[segment] = span_of(line);
}

}  // namespace

/// Checks a path with its largest blends between lines, and then with those that it seems to have.
bool ProgramVerifier::check_path() {
  const ProgramPart& part = parts_[now_.part];
  const bool blends = std::any_of(part.blend_radii.begin(), part.blend_radii.end(),
                                  [](double radius) { return radius > 0; });
  if (!blends) return check_path(part);
  return check_candidates(std::array{true, false}, [&](bool largest) {
    if (largest) return check_path(part);
    const std::vector<double> scales = seen_blend_scales(part);
    const bool same = std::all_of(scales.begin(), scales.end(), [](double x) { return x == 1; });
    return !same && check_path(with_blend_scales(program_, part, Limits::none, scales));
  });
}

bool ProgramVerifier::check_path(const ProgramPart& part) {
  const bool last_part = now_.part + 1 == parts_.size();
  std::size_t begin = 0;
  for (std::size_t i = 0; i < part.route.stops.size(); ++i) {
    if (!part.route.stops[i]) continue;
    const bool last = last_part && i + 1 == part.route.stops.size();
    if (!check_section(part, begin, i, last)) return false;
    begin = i + 1;
  }
  ++now_.part;
  return true;
}

/// The scales of the blends between the lines of a part that begins at the next sample: of those
/// that move_program() gives, the nearest to the distance at which the tool passes the waypoint.
std::vector<double> ProgramVerifier::seen_blend_scales(const ProgramPart& part) const {
  constexpr double near = 2;  // deviations of the blend: samples may be beyond it
  std::vector<double> scales(part.blend_radii.size(), 1);
  std::size_t from = now_.begin;
  for (std::size_t i = 0; i < part.moves.size(); ++i) {
    const auto* const blend = std::get_if<SplineSegment>(&part.route.path.segments[i]);
    const std::size_t index = part.moves[i] - part.first;
    if (blend == nullptr || part.blend_radii[index] == 0) continue;
    Move move = program_.moves[part.moves[i]];
    move.blend *= near;
    const auto passed = passages_.nearest(move, from);
    if (!passed) continue;
    from = passed->sample;
    if (is_at(move.target, from) && rests_.rests_at(from)) {
      scales[index] = 0;
      continue;
    }
    const Deviation largest = task_deviation(task_, move.target, pose_at(*blend, 0.5));
    const double size = blend_distance(move, largest);
    const double seen = passed->distance / size;
    if (!(size > 0) || !(seen >= 0)) continue;
    const double times = std::log(seen) / std::log(BlendRefusals::smaller);
    constexpr double most = BlendRefusals::max_smaller;
    scales[index] = std::pow(BlendRefusals::smaller, std::clamp(std::round(times), 0.0, most));
  }
  return scales;
}

/// The rests at which a path may end, or where the tool passes its end without one; those that
/// leave no time for its motion last.
std::vector<std::size_t> ProgramVerifier::path_rests(const Route& route) const {
  const Pose goal = pose_at(route.path.segments.back(), 1);
  const bool moves =
      std::any_of(route.path.segments.begin(), route.path.segments.end(),
                  [&](const Segment& segment) { return !stands_still(segment, task_); });
  std::vector<std::size_t> rests = rests_.rests({.target = goal}, now_.begin);
  if (moves && !rests.empty() && rests.front() == now_.begin) {
    std::rotate(rests.begin(), rests.begin() + 1, rests.end());
  }
  if (!rests.empty()) return rests;
  std::size_t first = now_.begin;
  const bool closed = within(task_deviation(task_, goal, pose_at(route.path, 0)),
                             {options_.tolerance, options_.orientation_tolerance});
  while (closed && moves && first < trajectory_.size() && rests_.offset(goal, first) <= 1) {
    ++first;
  }
  if (const auto passed = rests_.passes({.target = goal}, first)) rests.push_back(*passed);
  return rests;
}

/// The samples up to which the tool may follow a line that ends in the blend of a move: of each
/// stay near its end first the sample at the waypoint, if the arm stops there, then the first one
/// and the last one, up to which the tool may already leave the line.
std::vector<std::size_t> ProgramVerifier::line_ends(const Line& line, std::size_t move) const {
  const Deviation blend = blend_deviation(program_.moves[move]);
  std::vector<std::size_t> ends;
  std::optional<std::size_t> first, stop, last;  // of the stay so far
  const auto end_stay = [&] {
    if (!first) return;
    for (const std::size_t end : {stop.value_or(*first), *first, *last}) {
      if (std::find(ends.begin(), ends.end(), end) == ends.end()) ends.push_back(end);
    }
    first.reset();
    stop.reset();
  };
  std::size_t k = passages_.next_near(line.to, blend, now_.begin);
  for (; k < trajectory_.size() && !budget_.ended();
       k = passages_.next_near(line.to, blend, k + 1)) {
    double fraction = 0;
    if (!is_on(line, k, fraction) || fraction < 1 - blended_fraction) continue;
    if (first && k > *last + 1) end_stay();
    if (ends.size() >= max_candidates) return ends;
    if (!first) first = k;
    last = k;
    if (!stop && is_at(line.to, k) && rests_.rests_at(k)) stop = k;
  }
  end_stay();
  return ends;
}

bool ProgramVerifier::check_section(const ProgramPart& part, std::size_t first, std::size_t last,
                                    bool to_end) {
  Route route = section_of(part, first, last);
  // Lines that blends replace completely have no segment.
  const std::size_t move = last + 1 < part.moves.size() ? part.moves[last + 1] - 1 : part.last;
  const bool leaves = move == part.last && blends_with_joint_move(program_, move) &&
                      is_followed(route.path.segments.back());
  const std::size_t end_segment = route.path.segments.size() - 1;
  const Segment whole = route.path.segments.back();
  if (now_.speed_from) {
    const Line line = std::get<Line>(route.path.segments.front());
    double fraction = 0;
    is_on(line, now_.begin, fraction);
    replace_line(route, 0, {pose_at(line, fraction), line.to});
  }
  const std::vector<std::size_t> ends =
      leaves ? line_ends(std::get<Line>(whole), move) : path_rests(route);
  if (!budget_.complete()) return end(budget_.ending(), {});
  if (ends.empty() && !leaves) return fail_to_reach(move);
  if (ends.empty()) return fail_to_pass(move, now_.begin, &std::get<Line>(whole));
  // At the end of the program the path is checked to the last sample from any of them.
  return check_candidates(std::span(ends).first(to_end ? 1 : ends.size()), [&](std::size_t end) {
    Route followed = route;
    if (leaves) {
      const Line line = std::get<Line>(route.path.segments[end_segment]);
      double fraction = 0;
      is_on(line, end, fraction);
      replace_line(followed, end_segment, {line.from, pose_at(line, fraction)});
    }
    return check_section(part, followed, {first, move, end, to_end, leaves});
  });
}

/// Checks a path from the sample at which it begins to a stop, or to a blend with a joint move.
bool ProgramVerifier::check_section(const ProgramPart& part, const Route& route,
                                    const SectionEnd& end) {
  const std::size_t first = end.first, move = end.move, begin = now_.begin;
  const bool enters = now_.speed_from.has_value();
  VerifyOptions options = options_;
  options.moving = {enters || (options_.moving.start && begin == 0),
                    end.leaves || (options_.moving.end && end.is_last)};
  const std::size_t until = end.is_last ? trajectory_.size() - 1 : end.sample;
  const Verification found =
      verify(arm_, samples_between(trajectory_, begin, until), route, options);
  if (!add(found)) return false;
  auto from = static_cast<SampleTime>(speed_from());
  std::vector<std::size_t>& arrivals = now_.result.arrivals;
  for (std::size_t i = arrivals.size(); i <= move; ++i) {
    const std::size_t segment = part.last_segment(i);  // before `first` if the line has none left
    const std::size_t reached = begin + (segment < first ? 0 : found.arrivals[segment - first]);
    if (i == move && end.leaves) break;
    arrivals.push_back(reached);
    if (i == move || segment < first) {
      const auto end_of_move = static_cast<SampleTime>(reached);
      if (!check_speed_between(i, from, end_of_move, program_.moves[i].speed)) return false;
      continue;
    }
    const std::size_t last_sample = begin + found.arrivals.back();
    const auto after =
        check_passing(i, move, route.path.segments[segment - first], from, reached, last_sample);
    if (!after) return false;
    from = *after;
  }
  if (!end.leaves) return check_stop(move) && check_dwell(move);
  const SampleTime sample = std::ceil(from);
  if (!check_speed_between(move, from, sample, program_.moves[move].speed)) return false;
  now_.begin = end.sample;
  now_.speed_from = static_cast<std::size_t>(sample);
  now_.leaving = move;
  return true;
}

/// Adds what was found from the first sample of a path on; returns whether it passed.
bool ProgramVerifier::add(const Verification& found) {
  PathDeviation& whole = now_.result.deviation;
  grow(whole.sampled, found.deviation.sampled);
  grow(whole.measured, found.deviation.measured);
  grow(whole.bound, found.deviation.bound);
  const std::vector<Deviation>& bounds = found.deviation.interval_bounds;
  std::copy(bounds.begin(), bounds.end(),
            interval_bounds_.begin() + static_cast<std::ptrdiff_t>(now_.begin));
  bounds_end_ = std::max(bounds_end_, now_.begin + bounds.size());
  if (found) return true;
  if (found.fault == Fault::none) return end(found.ending, found.reason);
  return fail(found.fault, now_.begin + found.sample, found.reason);
}

}  // namespace beeline::internal
