#include <beeline/certificate/internal/path_checks.h>
#include <beeline/kinematics/internal/deviation_reason.h>
#include <beeline/model/internal/joint_reason.h>
#include <beeline/path/internal/nearest_on_line.h>
#include <beeline/planning/internal/program_verifier.h>

namespace beeline::internal {
namespace {

/// The passages before `last`, each with the one of the move before from which it is possible.
std::vector<Passage> chain_of(const std::vector<PassageLayer>& layers, std::size_t last) {
  std::vector<Passage> chain(layers.size());
  for (std::size_t i = layers.size(); i-- > 0;) {
    chain[i] = layers[i].passages[last];
    last = layers[i].before[last];
  }
  return chain;
}

/// The last passage of a layer that is not after a time; the passages are in its order.
std::optional<std::size_t> last_until(const PassageLayer& layer, double at) {
  const auto after =
      std::upper_bound(layer.passages.begin(), layer.passages.end(), at,
                       [](double time, const Passage& passage) { return time < passage.at; });
  if (after == layer.passages.begin()) return std::nullopt;
  return static_cast<std::size_t>(after - layer.passages.begin()) - 1;
}

/// The last stop of a layer that is not after a time.
std::optional<std::size_t> last_stop_until(const PassageLayer& layer, double at) {
  for (std::size_t i = layer.passages.size(); i-- > 0;) {
    if (layer.stops[i] && layer.passages[i].at <= at) return i;
  }
  return std::nullopt;
}

/// A passage that is too fast: the samples between which, and the first interval.
struct FastPassage {
  std::size_t from = 0, to = 0, fast = 0;
};

}  // namespace

bool ProgramVerifier::is_followed(const Segment& segment) const {
  return std::holds_alternative<Line>(segment) && !stands_still(segment, task_);
}

bool ProgramVerifier::is_on(const Line& line, std::size_t k, double& fraction) const {
  fraction = nearest_fraction(line, tool_at(k), task_);
  return within(deviation_from(line, tool_at(k), task_),
                {options_.tolerance, options_.orientation_tolerance});
}

bool ProgramVerifier::is_at(const Pose& waypoint, std::size_t k) const {
  return passages_.is_near(waypoint, {options_.tolerance, options_.orientation_tolerance}, k);
}

/// Whether the joint move of a part passes its waypoint in a blend. The tool rests before a line
/// without length, which could not be followed.
bool ProgramVerifier::passes_after(std::size_t part) const {
  if (!blends_with_joint_move(program_, parts_[part].last)) return false;
  const ProgramPart& next = parts_[part + 1];
  return next.joint || is_followed(next.route.path.segments.front());
}

JointRun ProgramVerifier::joint_run() const {
  JointRun run{.next = now_.part};
  if (now_.leaving) run.passed.push_back(*now_.leaving);
  while (true) {
    const std::size_t part = run.next++, move = parts_[part].last;
    if (!passes_after(part)) {
      run.rest = move;
      return run;
    }
    run.passed.push_back(move);
    if (!parts_[run.next].joint) return run;
  }
}

/// Fails at a waypoint that is not passed within the deviation of its blend, at the nearest sample
/// from `first` on: with what the blend allows, and the joint that is farthest off. If the waypoint
/// is passed, but not on the line before it, fails at the line. If the tool is on the line there,
/// but does not follow it far enough, fails with the distance from the waypoint.
bool ProgramVerifier::fail_to_pass(std::size_t move, std::size_t first, const Line* line) {
  const Move& goal = program_.moves[move];
  std::size_t nearest = first;
  double least = passages_.distance(goal, first);
  for (std::size_t k = first + 1; k < trajectory_.size(); ++k) {
    const double here = passages_.distance(goal, k);
    if (here < least) nearest = k, least = here;
  }
  double fraction = 0;
  const bool passed = line != nullptr && least <= 1 && !is_on(*line, nearest, fraction);
  const Pose waypoint = waypoint_of(arm_, goal), tool = tool_at(nearest);
  Reason reason =
      deviation_reason(ReasonCode::off_path, passed ? deviation_from(*line, tool, task_)
                                                    : task_deviation(task_, waypoint, tool));
  const std::string name = move_name(program_, move);
  reason.set(ReasonField::move, move + 1)
      .set(ReasonField::segment_name, passed ? name : "the waypoint of " + name);
  if (passed) return fail(Fault::deviation, nearest, std::move(reason));
  if (least <= 1) return fail(Fault::not_through, nearest, std::move(reason));
  const Deviation most = blend_deviation(goal);
  reason.set(ReasonField::limit, most.position).set(ReasonField::angle_limit, most.orientation);
  double largest = 1;
  for (int i = 0; goal.q && i < arm_.dof(); ++i) {
    const double error = std::abs(trajectory_.positions[nearest][i] - (*goal.q)[i]);
    const double allowed = allowed_in_blend(arm_, goal, i);
    if (!(error > largest * allowed)) continue;
    largest = error / allowed;
    set_joint(arm_.joint_of(i), reason).set(ReasonField::error, error);
  }
  return fail(Fault::not_through, nearest, std::move(reason));
}

void ProgramVerifier::add_arrivals(std::span<const Passage> passed) {
  for (const Passage& passage : passed) now_.result.arrivals.push_back(passage.nearest());
}

/// Whether the arm stops at the waypoint of a move in a passage.
bool ProgramVerifier::stops_in(const Move& move, const Passage& passage) const {
  const std::size_t k = passage.before();
  return k == passage.after() && rests_.rests_at(k) && rests_.offset(move, k) <= 1;
}

/// The passages of the last waypoint up to a time from which the motion to the next may continue,
/// in the order in which they are tried: the last one in which the arm stops, as it does where its
/// blend is no better, and the latest one, as less of the motion is between them. 0 if there is no
/// waypoint before.
std::vector<std::size_t> ProgramVerifier::passages_before(const std::vector<PassageLayer>& layers,
                                                          double at) {
  if (layers.empty()) return {0};
  std::vector<std::size_t> before;
  if (const auto stop = last_stop_until(layers.back(), at)) before.push_back(*stop);
  const auto last = last_until(layers.back(), at);
  if (last && (before.empty() || before.front() != *last)) before.push_back(*last);
  return before;
}

/// Finds the passages of the waypoints that a run passes. A passage counts if it is after one of
/// the waypoint before and the tool keeps the speed of the move between them.
bool ProgramVerifier::add_layers(const JointRun& run, std::vector<PassageLayer>& layers) {
  auto first = static_cast<double>(now_.begin);
  for (const std::size_t move : run.passed) {
    const auto& limit = program_.moves[move].speed;
    PassageLayer layer;
    std::optional<FastPassage> too_fast;
    for (const Passage& passage : passages_.passages(program_.moves[move], first, max_candidates)) {
      for (const std::size_t before : passages_before(layers, passage.at)) {
        const std::size_t from =
            layers.empty() ? speed_from() : layers.back().passages[before].after();
        if (const auto fast = fast_interval(from, passage.before(), limit)) {
          if (!too_fast) too_fast = {from, passage.before(), *fast};
          continue;
        }
        layer.passages.push_back(passage);
        layer.before.push_back(before);
        layer.stops.push_back(stops_in(program_.moves[move], passage));
        break;
      }
    }
    if (!budget_.complete()) return end(budget_.ending(), {});
    if (layer.passages.empty()) {
      if (!layers.empty()) add_arrivals(chain_of(layers, layers.back().passages.size() - 1));
      return too_fast ? fail_too_fast(move, too_fast->from, too_fast->to, too_fast->fast, *limit)
                      : fail_to_pass(move, static_cast<std::size_t>(first));
    }
    first = layer.passages.front().at;
    layers.push_back(std::move(layer));
  }
  return true;
}

/// Checks the speed in the intervals between samples that contain passages: of each move up to its
/// passage, and of the next one after it. `next` is the move after the last passage.
bool ProgramVerifier::check_passages(const JointRun& run, std::size_t next,
                                     const std::vector<Passage>& passed) {
  constexpr double resolution = 1e-6;  // of an interval: shorter parts belong to their neighbours
  const auto check_part = [&](std::size_t i, std::size_t begin, double from, double to) {
    const std::size_t move = i < run.passed.size() ? run.passed[i] : next;
    return check_speed(move, begin, from, to, program_.moves[move].speed);
  };
  for (std::size_t i = 0; i < passed.size();) {
    const std::size_t first = i, begin = passed[i].before(), end = passed[i].after();
    double from = 0;
    for (; i < passed.size() && passed[i].before() == begin; ++i) {
      const double at = passed[i].at - static_cast<double>(begin);
      if (at - from < resolution) continue;
      const double to = 1 - at < resolution ? 1 : at;
      if (!check_part(i, begin, from, to)) return false;
      from = to;
    }
    if (begin < end && from < 1 && !check_part(i, begin, from, 1)) return false;
    add_arrivals(std::span(passed).subspan(first, i - first));
  }
  return true;
}

/// The rests from sample `first` on at which the joint move of a part may end. Before a joint move
/// to another pose, the last one before that pose comes first, as a joint move may change the
/// configuration at a pose.
std::vector<std::size_t> ProgramVerifier::joint_rests(std::size_t part, std::size_t first) const {
  std::vector<std::size_t> rests = rests_.rests(program_.moves[parts_[part].first], first);
  std::sort(rests.begin(), rests.end());
  if (part + 1 == parts_.size() || !parts_[part + 1].joint || rests.empty()) return rests;
  std::vector<std::size_t> next =
      rests_.rests(program_.moves[parts_[part + 1].first], rests.front());
  if (next.empty()) return rests;
  const auto later =
      std::lower_bound(rests.begin(), rests.end(), *std::min_element(next.begin(), next.end()));
  std::reverse(rests.begin(), later);
  return rests;
}

/// Checks joint moves up to a stop or to a line, and the path after them: a joint move to a pose
/// may end there at several rests, in different configurations.
bool ProgramVerifier::check_joint_moves() {
  const JointRun run = joint_run();
  std::vector<PassageLayer> layers;
  if (!add_layers(run, layers)) return false;
  return run.rest ? check_rests(run, layers) : check_line_begins(run, layers);
}

bool ProgramVerifier::check_rests(const JointRun& run, const std::vector<PassageLayer>& layers) {
  const std::size_t move = *run.rest;
  const std::size_t first = layers.empty() ? now_.begin : layers.back().passages.front().after();
  std::vector<std::size_t> rests = joint_rests(run.next - 1, first);
  if (rests.empty()) {
    const auto passed = rests_.passes(program_.moves[move], first);
    if (!passed) return fail_to_reach(move);
    rests.push_back(*passed);
  }
  std::vector<RunEnd> ends;
  for (const std::size_t rest : rests) {
    for (const std::size_t passage : passages_before(layers, static_cast<double>(rest))) {
      ends.push_back({rest, passage});
    }
  }
  const auto check = [&](const RunEnd& end) {
    std::size_t from = speed_from();
    if (!layers.empty()) {
      const std::vector<Passage> passed = chain_of(layers, end.passage);
      if (!check_passages(run, move, passed)) return false;
      from = passed.back().after();
    }
    now_.leaving.reset();
    now_.result.arrivals.push_back(end.sample);
    if (!check_speed(move, from, end.sample, program_.moves[move].speed) || !check_stop(move) ||
        !check_dwell(move)) {
      return false;
    }
    now_.part = run.next;
    if (now_.part == parts_.size()) return check_rest(move);
    return parts_[now_.part].joint || check_path();
  };
  return check_candidates(ends, check, 2 * max_candidates);  // two passages of each rest
}

/// The samples after a passage from which the tool may follow a line that begins at its waypoint:
/// the first one and the last one before the tool is farther along it. The first one is tried first
/// if it is at the waypoint, where the arm stops; from others the tool may still approach the line.
std::vector<std::size_t> ProgramVerifier::line_begins(const Line& line, std::size_t move,
                                                      const Passage& passage) const {
  const Deviation blend = blend_deviation(program_.moves[move]);
  std::vector<std::size_t> begins;
  for (std::size_t k = passage.after(); k < trajectory_.size(); ++k) {
    if (!passages_.is_near(line.from, blend, k)) break;
    double fraction = 0;
    if (!is_on(line, k, fraction)) continue;
    if (fraction > blended_fraction) {
      if (!begins.empty()) break;
      continue;
    }
    if (begins.size() == 2) begins.pop_back();
    begins.push_back(k);
  }
  if (!begins.empty() && !is_at(line.from, begins.front())) {
    std::reverse(begins.begin(), begins.end());
  }
  return begins;
}

bool ProgramVerifier::check_line_begins(const JointRun& run,
                                        const std::vector<PassageLayer>& layers) {
  const std::size_t move = run.passed.back();
  const ProgramPart& path = parts_[run.next];
  const Line line = std::get<Line>(path.route.path.segments.front());
  const std::vector<Passage>& passages = layers.back().passages;
  std::vector<RunEnd> ends;
  for (std::size_t i = 0; i < passages.size(); ++i) {
    for (const std::size_t begin : line_begins(line, move, passages[i])) {
      ends.push_back({begin, i});
    }
  }
  if (ends.empty()) {
    Reason reason = deviation_reason(
        ReasonCode::off_path, deviation_from(line, tool_at(passages.front().after()), task_));
    reason.set(ReasonField::segment_name, move_name(program_, path.first));
    return fail(Fault::deviation, passages.front().nearest(), std::move(reason));
  }
  return check_candidates(ends, [&](const RunEnd& end) {
    const std::vector<Passage> passed = chain_of(layers, end.passage);
    if (!check_passages(run, path.first, passed)) return false;
    now_.leaving.reset();
    now_.begin = end.sample;
    now_.speed_from = passed.back().after();
    now_.part = run.next;
    return check_path();
  });
}

}  // namespace beeline::internal
