#pragma once

#include <optional>
#include <vector>

#include "program_fields.h"

namespace beeline::python {

constexpr const char* arrivals_doc =
    "The sample at which each move ends, PlannedMove.end or Verification.arrivals; with a program.";

/// A program with the samples at which its moves end.
struct FollowedProgram {
  const Program* program = nullptr;
  std::vector<std::size_t> arrivals = {};
};

/// Throws Error if only one of both is given, and TypeError for what is no program.
inline std::optional<FollowedProgram> followed_from(nb::handle program, nb::handle arrivals) {
  if (program.is_none() != arrivals.is_none()) {
    throw Error("program and arrivals are given together, or neither");
  }
  if (program.is_none()) return std::nullopt;
  FollowedProgram followed;
  if (!nb::try_cast<const Program*>(program, followed.program) || followed.program == nullptr) {
    raise_type("program", "a Program", program);
  }
  followed.arrivals = Value<std::vector<std::size_t>>::from(arrivals, "arrivals");
  return followed;
}

}  // namespace beeline::python
