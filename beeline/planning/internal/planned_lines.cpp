#include <algorithm>

#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/planning/internal/motion_request.h>
#include <beeline/planning/internal/planned_lines.h>
#include <beeline/planning/internal/section_joint_path.h>

namespace beeline::internal {
namespace {

constexpr int samples_of_segment = 16;

/// The configuration of a planned motion at a path parameter, by linear interpolation.
Configuration configuration_at(const PlannedProgram& planned, const PlannedPart& part,
                               double parameter) {
  const std::vector<double>& parameters = part.path_parameters;
  const auto next = std::lower_bound(parameters.begin() + 1, parameters.end() - 1, parameter);
  const auto k = static_cast<std::size_t>(next - parameters.begin());
  const double whole = parameters[k] - parameters[k - 1];
  const double u = whole > 0 ? (parameter - parameters[k - 1]) / whole : 1;
  const auto& q = planned.trajectory.positions;
  const std::size_t at = part.begin + k;
  return q[at - 1] + std::clamp(u, 0.0, 1.0) * (q[at] - q[at - 1]);
}

/// Configurations along segments of a part, with the tool on them. No samples if one is not found.
BranchSection samples_along(const PlannedProgram& planned, const PlannedPart& part,
                            const PlannedLines& lines, const MoveRange& moves,
                            BudgetMeter& budget) {
  const auto& positions = planned.trajectory.positions;
  const ToolPath& path = planned.parts[part.part].route.path;
  const Bounds bounds = bounds_of(planned.arm);
  BranchSection section{{positions[planned.moves[moves.first].begin]},
                        {static_cast<double>(lines.first_segment)}};
  for (std::size_t i = lines.first_segment; i <= lines.last_segment; ++i) {
    for (int k = 1; k <= samples_of_segment; ++k) {
      const double fraction = static_cast<double>(k) / samples_of_segment;
      const double parameter = static_cast<double>(i) + fraction;
      section.path_parameters.push_back(parameter);
      if (i == lines.last_segment && k == samples_of_segment) {
        section.samples.push_back(positions[planned.moves[moves.last].end]);
        break;
      }
      const NumericalResult found = levenberg_marquardt(
          planned.arm, pose_at(path.segments[i], fraction), *planned.options.task, bounds,
          configuration_at(planned, part, parameter));
      if (!found.converged || budget.ended(found.iterations)) return {};
      section.samples.push_back(found.q);
    }
  }
  return section;
}

}  // namespace

std::optional<PlannedLines> planned_lines(const PlannedProgram& planned, const MoveRange& moves,
                                          BudgetMeter& budget) {
  const auto part =
      std::find_if(planned.planned.begin(), planned.planned.end(), [&](const PlannedPart& one) {
        return planned.parts[one.part].first <= moves.first &&
               moves.last <= planned.parts[one.part].last;
      });
  if (part == planned.planned.end()) return std::nullopt;
  const ProgramPart& whole = planned.parts[part->part];
  PlannedLines lines{.part = part->part,
                     .first_segment = whole.first_segment(moves.first),
                     .last_segment = whole.last_segment(moves.last)};
  BranchSection samples = samples_along(planned, *part, lines, moves, budget);
  if (samples.samples.empty()) return std::nullopt;
  for (std::size_t k = 1; k < samples.samples.size(); ++k) {
    if (samples.samples[k] == samples.samples[k - 1]) return std::nullopt;
  }
  const MotionRequest request{planned.arm,
                              std::nullopt,
                              whole.route,
                              branch_options(planned.arm, planned.options, 1),
                              timing_options(planned.options),
                              proof_options(planned.options)};
  const SectionJointPath path(request, std::move(samples), budget);
  lines.limited.path = path.joint_path();
  ToolSpeeds& speeds = lines.limited.tool_speeds;
  speeds.ends.clear();
  speeds.limits.clear();
  for (std::size_t i = lines.first_segment; i <= lines.last_segment; ++i) {
    speeds.limits.push_back(whole.route.speeds[i]);
    speeds.ends.push_back(path.parameter_at(static_cast<double>(i + 1)));
  }
  return budget.complete() ? std::optional(std::move(lines)) : std::nullopt;
}

}  // namespace beeline::internal
