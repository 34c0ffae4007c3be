#include <algorithm>
#include <cmath>

#include <beeline/certificate/verify.h>
#include <beeline/planning/internal/motion_request.h>
#include <beeline/planning/internal/piece_run.h>

namespace beeline::internal {
namespace {

constexpr double time_rounding = 2e-9;  // by which times of samples have been rounded
constexpr int linear_samples = 200;     // of a run, where joints move linearly between them
constexpr int max_rounds = 6;           // of samples that are added for the proof

double rounding(const ParameterState& state) { return 1e-12 + time_rounding * state.speed; }

}  // namespace

PieceRun::PieceRun(const Arm& arm, const std::vector<ProgramPart>& parts,
                   const std::vector<MovePiece>& pieces, const std::vector<PieceBlend>& blends,
                   std::size_t first, std::size_t last, const PathMotionOptions& options,
                   BudgetMeter& budget)
    : arm_(arm),
      parts_(parts),
      pieces_(pieces),
      blends_(blends),
      first_(first),
      last_(last),
      options_(options),
      budget_(budget) {
  double offset = 0;
  for (std::size_t k = first; k <= last; ++k) {
    offsets_.push_back(offset);
    offset += pieces[k].length();
  }
}

/// The parameter at which piece k begins to follow its own path, and the one at which it ends.
double PieceRun::begin_of(std::size_t k) const {
  return offsets_[k - first_] + (k == first_ ? 0 : blends_[k - 1].after);
}

double PieceRun::end_of(std::size_t k) const {
  return offsets_[k - first_] + pieces_[k].length() - (k == last_ ? 0 : blends_[k].before);
}

/// The limits of the tool's speed; on a blend the lower one of both pieces.
ToolSpeeds PieceRun::tool_speeds() const {
  ToolSpeeds speeds;
  speeds.ends.clear();
  speeds.limits.clear();
  const auto add = [&](double end, double limit) {
    if (!speeds.ends.empty() && !(end > speeds.ends.back())) return;
    if (!speeds.limits.empty() && speeds.limits.back() == limit) {
      speeds.ends.back() = end;
      return;
    }
    speeds.ends.push_back(end);
    speeds.limits.push_back(limit);
  };
  for (std::size_t k = first_; k <= last_; ++k) {
    const ToolSpeeds& own = pieces_[k].speeds;
    for (std::size_t i = 0; i < own.limits.size(); ++i) {
      add(std::min(offsets_[k - first_] + own.ends[i], end_of(k)), own.limits[i]);
    }
    if (k == last_) break;
    add(begin_of(k + 1), std::min(own.limits.back(), pieces_[k + 1].speeds.limits.front()));
  }
  speeds.ends.back() = Limits::none;
  return speeds;
}

/// The parameters that get a sample.
std::vector<double> PieceRun::required() const {
  std::vector<double> s;
  for (std::size_t k = first_; k <= last_; ++k) {
    if (k > first_) s.push_back(begin_of(k));
    if (k < last_) s.push_back(end_of(k));
    if (!pieces_[k].tool) continue;
    for (const double end : pieces_[k].tool->segment_ends()) {
      const double here = offsets_[k - first_] + end;
      if (here > begin_of(k) && here < end_of(k)) s.push_back(here);
    }
  }
  const double length = end_of(last_);
  const bool linear = options_.interpolation == Interpolation::linear;
  for (int i = 1; linear && i < linear_samples; ++i) s.push_back(length * i / linear_samples);
  std::sort(s.begin(), s.end());
  s.erase(std::unique(s.begin(), s.end()), s.end());
  return s;
}

/// The samples from the first at or after one parameter to the last at or before another.
SampleRange PieceRun::samples_of(const SampledSection& sampled, double begin, double end) const {
  const std::vector<ParameterState>& progress = sampled.progress;
  SampleRange range{0, progress.size() - 1};
  while (range.first < range.last &&
         progress[range.first].s < begin - rounding(progress[range.first]))
    ++range.first;
  while (range.last > range.first && progress[range.last].s > end + rounding(progress[range.last]))
    --range.last;
  return range;
}

/// The samples from the last at or before one parameter to the first at or after another.
SampleRange PieceRun::samples_around(const SampledSection& sampled, double begin,
                                     double end) const {
  const std::vector<ParameterState>& progress = sampled.progress;
  auto [first, last] = samples_of(sampled, begin, end);
  if (first > 0 && progress[first].s > begin + rounding(progress[first])) --first;
  if (last + 1 < progress.size() && progress[last].s < end - rounding(progress[last])) ++last;
  return {first, last};
}

/// The samples of piece k on its path.
PathSamples PieceRun::path_samples(const SampledSection& sampled, std::size_t k) const {
  const MovePiece& piece = pieces_[k];
  const auto [first, last] = samples_of(sampled, begin_of(k), end_of(k));
  PathSamples samples{piece.part, first, {}};
  const auto end = static_cast<double>(piece.last_segment + 1);
  double before = static_cast<double>(piece.first_segment);
  for (std::size_t i = first; i <= last; ++i) {
    const ParameterState& state = sampled.progress[i];
    const double s = piece.tool->path_parameter(sampled.trajectory.positions[i],
                                                state.s - offsets_[k - first_], rounding(state));
    const bool at_end = k == last_ && i + 1 == sampled.progress.size();
    before = at_end ? end : std::clamp(s, before, end);
    samples.path_parameters.push_back(before);
  }
  return samples;
}

/// Adds a parameter between samples between which the deviation is not proved; returns whether
/// there are any.
bool PieceRun::add_required(const SampledSection& sampled, std::vector<double>& required) const {
  const std::size_t before = required.size();
  const Deviation tolerance{options_.tolerance, options_.orientation_tolerance};
  for (std::size_t k = first_; k <= last_; ++k) {
    if (!pieces_[k].tool) continue;
    const PathSamples samples = path_samples(sampled, k);
    const std::size_t end = samples.begin + samples.path_parameters.size() - 1;
    const PathDeviation deviation = path_deviation(
        arm_, samples_between(sampled.trajectory, samples.begin, end), samples.path_parameters,
        parts_[pieces_[k].part].route.path, *options_.task, budget_.part());
    for (std::size_t i = 0; i < deviation.interval_bounds.size(); ++i) {
      if (within(deviation.interval_bounds[i], tolerance)) continue;
      required.push_back(0.5 * (sampled.progress[samples.begin + i].s +
                                sampled.progress[samples.begin + i + 1].s));
    }
  }
  std::sort(required.begin(), required.end());
  return required.size() > before && budget_.complete();
}

SectionOptions PieceRun::section_options() const {
  SectionOptions options{.timing = timing_options(options_), .budget = budget_};
  options.tool_speeds = tool_speeds();
  return options;
}

JointPath PieceRun::joint_path() const {
  const auto at = [](const auto& list, std::size_t i) {
    return list.begin() + static_cast<std::ptrdiff_t>(i);
  };
  std::vector<const MovePiece*> pieces;
  for (std::size_t k = first_; k <= last_; ++k) pieces.push_back(&pieces_[k]);
  return joined(pieces, {at(blends_, first_), at(blends_, last_)});
}

double PieceRun::shortest_duration() const {
  if (!(end_of(last_) > 0)) return 0;
  const TimedSection timed = timed_section(arm_, joint_path(), section_options());
  return timed.scaling ? timed.scaling.duration() : Limits::none;
}

RunSamples PieceRun::append_to(ProgramTrajectory& trajectory) const {
  RunSamples result;
  if (!(end_of(last_) > 0)) return result;  // at rest
  SectionOptions options = section_options();
  options.required = required();
  options.samples_before = trajectory.last() + 1;
  options.begin = trajectory.end_time();
  const TimedSection timed = timed_section(arm_, joint_path(), options);
  result.reason = timed.scaling.reason;
  if (!timed.scaling) return result;
  SampledSection sampled = sample_section(arm_, timed, options);
  for (int i = 0; sampled && options_.rate == 0 && i < max_rounds; ++i) {
    if (!add_required(sampled, options.required)) break;
    sampled = sample_section(arm_, timed, options);
  }
  result.reason = sampled.reason;
  if (!sampled) return result;
  std::size_t shift = 0;
  for (std::size_t k = 1; k < sampled.trajectory.size(); ++k) {
    trajectory.append(sampled.trajectory, k);
    if (k == 1) shift = trajectory.last() - 1;
  }
  for (std::size_t k = first_; k <= last_; ++k) {
    if (k < last_) {
      const auto [first, last] = samples_around(sampled, end_of(k), begin_of(k + 1));
      result.blends.push_back({shift + first, shift + last});
    }
    if (!pieces_[k].tool) continue;
    result.paths.push_back(path_samples(sampled, k));
    result.paths.back().begin += shift;
  }
  return result;
}

}  // namespace beeline::internal
