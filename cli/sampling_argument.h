#pragma once

#include <optional>
#include <string>
#include <vector>

#include "command/option.h"

namespace beeline::command {

/// Options of the samples and the steps of a motion, which several verbs have. The last argument of
/// each is the values of --method that it requires.

/// --rate; `of` follows "Samples per second": ", from the first to the last. Default: ...".
Option rate_option(Target target, const std::string& of = ".",
                   std::vector<std::string> methods = {});

/// --duration; `of` says how the motion gets it.
Option duration_option(std::optional<double>* target, const std::string& of,
                       const std::string& excludes = "", std::vector<std::string> methods = {});

/// --joint-blend of paths in joint space; `otherwise` says what holds without it.
Option joint_blend_option(Target target, const std::string& otherwise,
                          std::vector<std::string> methods = {});

/// --max-samples; `when` says what else ends the computation.
Option max_samples_option(int* target, const std::string& when,
                          std::vector<std::string> methods = {});

/// --time-step and --max-steps of a simulation.
std::vector<Option> step_options(double* time_step, int* max_steps,
                                 const std::vector<std::string>& methods);

}  // namespace beeline::command
