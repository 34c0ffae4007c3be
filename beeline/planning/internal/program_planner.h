#pragma once

#include <beeline/planning/program.h>

namespace beeline::internal {

/// move_program() of a program that is valid, also in the scene of the model if one is given.
ProgramMotion planned_program(const Arm& arm, const std::optional<Configuration>& start,
                              const Program& program, const PathMotionOptions& options,
                              const CollisionModel* model);

}  // namespace beeline::internal
