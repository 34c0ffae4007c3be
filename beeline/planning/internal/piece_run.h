#pragma once

#include <vector>

#include <beeline/planning/internal/piece_blend.h>
#include <beeline/planning/internal/program_trajectory.h>
#include <beeline/timing/internal/sampled_section.h>

namespace beeline::internal {

/// Consecutive samples of a trajectory.
struct SampleRange {
  std::size_t first = 0, last = 0;
};

/// Samples of a piece that is a path, in a trajectory.
struct PathSamples {
  std::size_t part = 0, begin = 0;           ///< index of the part, and the first sample
  std::vector<double> path_parameters = {};  ///< of its samples
};

/// What a run has in the trajectory to which it was appended, or why it has no motion.
struct RunSamples {
  Reason reason = {};
  std::vector<SampleRange> blends = {};  ///< after each piece but the last
  std::vector<PathSamples> paths = {};
};

/// Pieces from one stop to the next, with blends between them, timed as one section.
class PieceRun {
 public:
  /// The pieces from `first` to `last`. Keeps references to all arguments but the indices.
  PieceRun(const Arm& arm, const std::vector<ProgramPart>& parts,
           const std::vector<MovePiece>& pieces, const std::vector<PieceBlend>& blends,
           std::size_t first, std::size_t last, const PathMotionOptions& options,
           BudgetMeter& budget);

  /// Appends the quickest motion. Without a rate it has samples at the ends of blends and segments,
  /// and as many more as the proof of the paths needs.
  RunSamples append_to(ProgramTrajectory& trajectory) const;

  /// The duration of its time scaling, s; infinite if there is none.
  double shortest_duration() const;

 private:
  double begin_of(std::size_t k) const;
  double end_of(std::size_t k) const;
  ToolSpeeds tool_speeds() const;
  SectionOptions section_options() const;
  JointPath joint_path() const;
  std::vector<double> required() const;
  SampleRange samples_of(const SampledSection& sampled, double begin, double end) const;
  SampleRange samples_around(const SampledSection& sampled, double begin, double end) const;
  PathSamples path_samples(const SampledSection& sampled, std::size_t k) const;
  bool add_required(const SampledSection& sampled, std::vector<double>& required) const;

  const Arm& arm_;
  const std::vector<ProgramPart>& parts_;
  const std::vector<MovePiece>& pieces_;
  const std::vector<PieceBlend>& blends_;
  std::size_t first_, last_;
  const PathMotionOptions& options_;
  BudgetMeter& budget_;
  std::vector<double> offsets_ = {};  ///< parameter at which each piece of the run begins
};

}  // namespace beeline::internal
