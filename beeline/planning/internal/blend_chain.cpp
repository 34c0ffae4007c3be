#include <algorithm>

#include <beeline/planning/internal/blend_chain.h>
#include <beeline/planning/internal/motion_request.h>
#include <beeline/timing/internal/retimed_paths.h>

namespace beeline::internal {
namespace {

constexpr int max_additions = 3;  // of grid points to a line

/// The blends of a chain from `first` up to before `end`.
std::vector<std::size_t> blends_between(std::size_t first, std::size_t end) {
  std::vector<std::size_t> blends;
  for (; first < end; ++first) blends.push_back(first);
  return blends;
}

}  // namespace

BlendChain::BlendChain(const PlannedProgram& planned, std::vector<ChainPart> parts,
                       std::vector<double> largest, const CollisionModel* model,
                       BlendRefusals& refusals, BudgetMeter& budget)
    : planned_(planned),
      parts_(std::move(parts)),
      largest_(std::move(largest)),
      model_(model),
      refusals_(refusals),
      budget_(budget),
      allowed_(largest_),
      refused_(largest_.size(), 0),
      additions_(parts_.size(), 0) {
  const auto begin = planned.program.moves.begin();
  program_.moves.assign(begin + static_cast<std::ptrdiff_t>(moves().first),
                        begin + static_cast<std::ptrdiff_t>(moves().last) + 1);
  program_.moves.back().blend = program_.moves.back().dwell = 0;
}

/// Times the chain. Returns why it has no motion; none if it has one or the budget ends.
std::optional<BlendChain::Refusal> BlendChain::timed(const std::vector<double>& radii,
                                                     BlendedMotion& motion) {
  std::vector<LimitedPath> parts;
  for (const ChainPart& part : parts_) parts.push_back(part.limited);
  std::vector<JointPath> paths;
  std::vector<ToolSpeeds> speeds;
  for (LimitedPath& joined : joined_paths(parts, radii)) {
    paths.push_back(std::move(joined.path));
    speeds.push_back(std::move(joined.tool_speeds));
  }
  Retimed retimed =
      timed_paths(planned_.arm, paths, timing_options(planned_.options), budget_, speeds);
  motion.trajectory = std::move(retimed.trajectory);
  motion.radii = radii;
  if (!budget_.complete() || !retimed.reason) return std::nullopt;
  if (retimed.sections < paths.size()) return refusal_of_section(radii, retimed.sections);
  return refusal_outside_limits(radii, motion.trajectory);
}

/// The refusal of the blends near the configurations at which a motion leaves the position limits
/// between two samples, or of all if there are none near them.
BlendChain::Refusal BlendChain::refusal_outside_limits(const std::vector<double>& radii,
                                                       const Trajectory& trajectory) const {
  constexpr double near = 1.5;  // radii from the waypoint
  std::vector<std::size_t> blends;
  for (const std::size_t k : intervals_outside_limits(planned_.arm, trajectory)) {
    const Configuration& q = trajectory.positions[k];
    for (std::size_t i = 0; i < radii.size(); ++i) {
      const double away = (q - parts_[i].limited.path.q.back()).norm();
      if (radii[i] > 0 && away <= near * radii[i]) blends.push_back(i);
    }
  }
  std::sort(blends.begin(), blends.end());
  blends.erase(std::unique(blends.begin(), blends.end()), blends.end());
  if (blends.empty()) blends = blends_between(0, radii.size());
  const std::size_t part = blends.front();
  return {std::move(blends), part};
}

/// The refusal of all blends of a section, from stop to stop.
BlendChain::Refusal BlendChain::refusal_of_section(const std::vector<double>& radii,
                                                   std::size_t section) const {
  const auto stop_from = [&](std::size_t i) {
    const auto first = radii.begin() + static_cast<std::ptrdiff_t>(i);
    return static_cast<std::size_t>(std::find(first, radii.end(), 0.0) - radii.begin());
  };
  std::size_t first = 0;
  for (; section > 0; --section) first = stop_from(first) + 1;
  return {blends_between(first, stop_from(first)), first};
}

/// The refusal of a motion at a sample of a move: the nearer one of the blends at both ends of the
/// move's part is the cause, or both.
BlendChain::Refusal BlendChain::refusal_at(const BlendedMotion& motion, std::size_t move,
                                           std::size_t sample, bool of_whole_move) const {
  const auto after = std::find_if(parts_.begin(), parts_.end() - 1,
                                  [&](const ChainPart& part) { return move <= part.moves.last; });
  const auto part = static_cast<std::size_t>(after - parts_.begin());
  const auto blends = [&](std::size_t i) { return i < motion.radii.size() && motion.radii[i] > 0; };
  const bool before = part > 0 && blends(part - 1), behind = blends(part);
  Refusal refusal{blends_between(part - (before ? 1 : 0), part + (behind ? 1 : 0)), part};
  if (!before || !behind || of_whole_move) return refusal;
  const Configuration& q = motion.trajectory.positions[sample];
  const JointPath& path = after->limited.path;
  const bool nearer_to_begin = (q - path.q.front()).norm() < (q - path.q.back()).norm();
  refusal.blends = {nearer_to_begin ? part - 1 : part};
  return refusal;
}

/// Times and proves a motion. Returns why it is refused; none if it is proved or the budget ends.
std::optional<BlendChain::Refusal> BlendChain::refusal(const std::vector<double>& radii,
                                                       BlendedMotion& motion) {
  std::optional<Refusal> untimed = timed(radii, motion);
  if (untimed || !budget_.complete()) return untimed;
  VerifyOptions options = proof_options(planned_.options);
  options.budget = budget_.part();
  const Verification found = verify(planned_.arm, motion.trajectory, program_, options);
  motion.arrivals = found.arrivals;
  if (!budget_.complete()) return std::nullopt;
  const std::size_t first = moves().first;
  if (!found) {
    Refusal refused = refusal_at(motion, first + refused_move(found, program_.moves.size()),
                                 found.sample, found.fault == Fault::tool_speed);
    refused.deviates = found.fault == Fault::deviation;
    return refused;
  }
  if (model_ == nullptr) return std::nullopt;
  const ClearanceProof proof =
      prove_clearance(*model_, motion.trajectory, {.budget = budget_.part()});
  if (proof || !budget_.complete()) return std::nullopt;
  const std::vector<double>& times = motion.trajectory.times;
  const auto sample = static_cast<std::size_t>(
      std::lower_bound(times.begin(), times.end() - 1, proof.time) - times.begin());
  const auto arrival = std::lower_bound(found.arrivals.begin(), found.arrivals.end(), sample);
  return refusal_at(motion, first + static_cast<std::size_t>(arrival - found.arrivals.begin()),
                    sample, false);
}

/// Makes the blends that may be the cause of a refusal smaller; returns whether there are any.
bool BlendChain::make_smaller(const Refusal& refusal, std::vector<double>& radii) {
  bool changed = false;
  for (const std::size_t i : refusal.blends) {
    if (radii[i] == 0) continue;
    const double radius = refusals_.fraction(++refused_[i]) * radii[i];
    allowed_[i] = radii[i] = radius < least_blend ? 0 : radius;
    changed = true;
  }
  if (!changed || !refusals_.rest_stops()) return changed;
  for (std::size_t i = refusal.blends.front(); i < radii.size(); ++i) allowed_[i] = radii[i] = 0;
  return true;
}

/// Adds samples, if there is no rate, to the part whose line is not followed; returns whether it
/// does.
bool BlendChain::add_samples(const Refusal& refusal) {
  if (!refusal.deviates || parts_[refusal.part].joint || planned_.options.rate > 0) return false;
  if (additions_[refusal.part]++ >= max_additions) return false;
  add_grid_points(parts_[refusal.part].limited.path);
  return true;
}

std::optional<BlendedMotion> BlendChain::proved(std::vector<double> radii) {
  while ((refusals_.any_left() || !tried_) && !refused_part_ && !budget_.ended()) {
    if (std::all_of(radii.begin(), radii.end(), [](double r) { return r == 0; })) break;
    tried_ = true;
    BlendedMotion motion;
    const std::optional<Refusal> refused = refusal(radii, motion);
    if (!budget_.complete()) break;
    if (!refused) return motion;
    refusals_.count();
    if (!add_samples(*refused) && !make_smaller(*refused, radii)) refused_part_ = refused->part;
  }
  return std::nullopt;
}

/// The radii with a fraction of those where the limit of the tool's speed changes. The lower limit
/// holds on the whole blend, so that a smaller one may be quicker.
std::vector<double> BlendChain::smaller_at_changes(double fraction) const {
  std::vector<double> radii = allowed_;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const double before = parts_[i].limited.tool_speeds.limits.back();
    const double after = parts_[i + 1].limited.tool_speeds.limits.front();
    if (before == after) continue;
    const double radius = std::min(radii[i], fraction * largest_[i]);
    radii[i] = radius < least_blend ? 0 : radius;
  }
  return radii;
}

std::optional<BlendedMotion> BlendChain::motion() {
  const std::vector<double>& times = planned_.trajectory.times;
  double shortest =
      times[planned_.moves[moves().last].end] - times[planned_.moves[moves().first].begin];
  std::optional<BlendedMotion> best;
  std::vector<std::vector<double>> tried;
  const auto attempt = [&](const std::vector<double>& radii) {
    if (std::find(tried.begin(), tried.end(), radii) != tried.end()) return;
    tried.push_back(radii);
    std::optional<BlendedMotion> found = proved(radii);
    if (!found) return;
    tried.push_back(found->radii);
    if (!(found->trajectory.duration() < shortest)) return;
    shortest = found->trajectory.duration();
    best = std::move(found);
  };
  for (const double fraction : {1.0, 0.25, 0.0625, 0.0}) attempt(smaller_at_changes(fraction));
  attempt(with_stops_below(small_blend, best ? best->radii : allowed_));
  return best;
}

}  // namespace beeline::internal
