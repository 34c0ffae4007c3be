#include <algorithm>

#include <beeline/planning/internal/blend_chain.h>
#include <beeline/planning/internal/motion_request.h>
#include <beeline/timing/internal/retimed_paths.h>

namespace beeline::internal {
namespace {

constexpr int max_refusals = 20;       // of motions, until the search ends
constexpr int stop_refused_from = 10;  // refusals left from which a refused blend becomes a stop
constexpr int stop_rest_from = 2;      // the same for all blends after it too
constexpr int max_smaller = 3;         // times that a blend is made smaller before it is a stop
constexpr int max_additions = 3;       // of grid points to a line
constexpr double smaller_blend = 0.4;  // of the radius that was refused

}  // namespace

BlendChain::BlendChain(const PlannedProgram& planned, std::vector<ChainPart> parts,
                       std::vector<double> largest, const CollisionModel* model,
                       BudgetMeter& budget)
    : planned_(planned),
      parts_(std::move(parts)),
      largest_(std::move(largest)),
      model_(model),
      budget_(budget),
      allowed_(largest_),
      refused_(largest_.size(), 0),
      additions_(parts_.size(), 0),
      refusals_left_(max_refusals) {
  const auto begin = planned.program.moves.begin();
  program_.moves.assign(begin + static_cast<std::ptrdiff_t>(moves().first),
                        begin + static_cast<std::ptrdiff_t>(moves().last) + 1);
  program_.moves.back().blend = program_.moves.back().dwell = 0;
}

/// Times the chain. Returns the section, from stop to stop, that has no motion, if there is none.
std::size_t BlendChain::timed(const std::vector<double>& radii, BlendedMotion& motion) {
  std::vector<LimitedPath> parts;
  for (const ChainPart& part : parts_) parts.push_back(part.limited);
  std::vector<JointPath> paths;
  std::vector<ToolSpeeds> speeds;
  for (LimitedPath& joined : joined_paths(parts, radii)) {
    paths.push_back(std::move(joined.path));
    speeds.push_back(std::move(joined.tool_speeds));
  }
  Retimed retimed =
      retimed_paths(planned_.arm, paths, timing_options(planned_.options), budget_, speeds);
  motion.trajectory = std::move(retimed.trajectory);
  motion.radii = radii;
  return retimed.sections;
}

/// The refusal of all blends of a section, from stop to stop; of all sections if the whole of them
/// is refused.
BlendChain::Refusal BlendChain::refusal_of_section(const std::vector<double>& radii,
                                                   std::size_t section) const {
  const auto stop_from = [&](std::size_t i) {
    const auto first = radii.begin() + static_cast<std::ptrdiff_t>(i);
    return static_cast<std::size_t>(std::find(first, radii.end(), 0.0) - radii.begin());
  };
  Refusal refusal;
  for (; section > 0 && refusal.first <= radii.size(); --section) {
    refusal.first = stop_from(refusal.first) + 1;
  }
  if (refusal.first > radii.size()) return {0, radii.size(), 0, false};
  refusal.end = stop_from(refusal.first);
  refusal.part = refusal.first;
  return refusal;
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
  Refusal refusal{part - (before ? 1 : 0), part + (behind ? 1 : 0), part, false};
  if (!before || !behind || of_whole_move) return refusal;
  const Configuration& q = motion.trajectory.positions[sample];
  const JointPath& path = after->limited.path;
  const bool nearer_to_begin = (q - path.q.front()).norm() < (q - path.q.back()).norm();
  nearer_to_begin ? --refusal.end : ++refusal.first;
  return refusal;
}

/// Times and proves a motion. Returns why it is refused; none if it is proved or the budget ends.
std::optional<BlendChain::Refusal> BlendChain::refusal(const std::vector<double>& radii,
                                                       BlendedMotion& motion) {
  const std::size_t section = timed(radii, motion);
  if (!budget_.complete()) return std::nullopt;
  if (motion.trajectory.size() == 0) return refusal_of_section(radii, section);
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
  for (std::size_t i = refusal.first; i < refusal.end; ++i) {
    if (radii[i] == 0) continue;
    const bool stops = refusals_left_ <= stop_refused_from || ++refused_[i] > max_smaller;
    const double radius = stops ? 0 : smaller_blend * radii[i];
    allowed_[i] = radii[i] = radius < least_blend ? 0 : radius;
    changed = true;
  }
  for (std::size_t i = refusal.first; refusals_left_ <= stop_rest_from && i < radii.size(); ++i) {
    allowed_[i] = radii[i] = 0;
  }
  return changed;
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
  while (refusals_left_ > 0 && !budget_.ended()) {
    if (std::all_of(radii.begin(), radii.end(), [](double r) { return r == 0; })) break;
    BlendedMotion motion;
    const std::optional<Refusal> refused = refusal(radii, motion);
    if (!budget_.complete()) break;
    if (!refused) return motion;
    if (add_samples(*refused)) continue;
    --refusals_left_;
    if (make_smaller(*refused, radii)) continue;
    refused_part_ = refused->part;
    refusals_left_ = 0;
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
