#include <algorithm>
#include <variant>

#include <beeline/planning/internal/line_blends.h>

namespace beeline::internal {
namespace {

/// Whether a motion is not proved or leaves the limits, for each segment of its path.
std::vector<bool> refused_segments(const Arm& arm, const PathMotion& refused,
                                   const Deviation& tolerance, std::size_t count) {
  std::vector<bool> segments(count, false);
  const std::vector<double>& at = refused.path_parameters;
  const auto mark = [&](std::size_t interval) {
    if (interval + 1 >= at.size()) return;
    const auto first = static_cast<std::size_t>(at[interval]);
    const auto last = static_cast<std::size_t>(at[interval + 1]);
    for (std::size_t i = first; i <= std::min(last, count - 1); ++i) segments[i] = true;
  };
  const std::vector<Deviation>& bounds = refused.deviation.interval_bounds;
  for (std::size_t k = 0; k < bounds.size(); ++k) {
    if (!within(bounds[k], tolerance)) mark(k);
  }
  if (const auto fault = first_joint_fault(arm, refused.trajectory)) mark(fault->sample);
  return segments;
}

/// Whether a motion is refused for the number of its samples, or for its rate: with smaller blends
/// it would be so, too.
bool needs_other_samples(const PathMotion& refused) {
  return refused.status == MotionStatus::too_many_samples ||
         refused.reason.code == ReasonCode::no_motion_at_rate;
}

}  // namespace

std::vector<std::size_t> refused_blends(const Arm& arm, const ProgramPart& part,
                                        const PathMotion& refused, const Deviation& tolerance) {
  if (needs_other_samples(refused)) return {};
  const std::size_t count = part.moves.size();
  const auto is_blend = [&](std::size_t i) {
    return i < count && part.blend_radii[part.moves[i] - part.first] > 0 &&
           std::holds_alternative<SplineSegment>(part.route.path.segments[i]);
  };
  std::vector<bool> segments(count, false);
  bool with_neighbours = true;
  if (const ReasonValue* const segment = refused.reason.find(ReasonField::segment)) {
    segments[std::get<std::size_t>(*segment) - 1] = true;
    with_neighbours = false;  // a line that is not possible is so with a stop
  } else if (refused.trajectory.size() > 0) {
    segments = refused_segments(arm, refused, tolerance, count);
  }
  if (std::find(segments.begin(), segments.end(), true) == segments.end()) {
    segments.assign(count, true);
  }
  std::vector<std::size_t> moves, neighbours;
  for (std::size_t i = 0; i < count; ++i) {
    if (!is_blend(i)) continue;
    const bool beside = (i > 0 && segments[i - 1]) || (i + 1 < count && segments[i + 1]);
    if (segments[i]) moves.push_back(part.moves[i]);
    if (beside) neighbours.push_back(part.moves[i]);
  }
  return moves.empty() && with_neighbours ? neighbours : moves;
}

void LineBlends::refuse(std::size_t p, std::vector<std::size_t> moves) {
  part_ = p;
  moves_ = std::move(moves);
}

bool LineBlends::make_smaller(const Program& program, double tool_speed,
                              std::vector<ProgramPart>& parts) {
  if (moves_.empty()) return false;
  parts_.resize(parts.size());
  ProgramPart& part = parts[part_];
  auto& [refusals, refused] = parts_[part_];
  if (!refusals.any_left()) return false;
  refusals.count();
  std::vector<double> scales = part.blend_scales;
  refused.resize(scales.size(), 0);
  for (const std::size_t move : moves_) {
    const std::size_t i = move - part.first;
    scales[i] *= refusals.fraction(++refused[i]);
  }
  if (refusals.rest_stops()) {
    const std::size_t first = moves_.front() - part.first;  // they are in order
    std::fill(scales.begin() + static_cast<std::ptrdiff_t>(first), scales.end(), 0.0);
  }
  part = with_blend_scales(program, part, tool_speed, scales);
  moves_.clear();
  return true;
}

}  // namespace beeline::internal
