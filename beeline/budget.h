#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include <beeline/error.h>

namespace beeline {

/// Whether a computation came to its own end, and if not, which part of its budget ended it. Where
/// a result has a status, the status has the same name.
enum class Ending {
  complete,    ///< the computation came to its own end
  time_limit,  ///< the budget's time ended it
  cancelled,   ///< it was cancelled
  work_limit,  ///< the budget's work ended it
};
std::string name(Ending ending);

/// What a search may spend. It ends at the limit that it reaches first, soon after that limit, with
/// a status of its own and with what it has found so far; it never throws for that. Searches have
/// limits of their own besides, such as max_restarts and max_samples. By default only these hold,
/// so that results do not depend on the speed of the machine; a result that no limit of the budget
/// ended is the same as without it.
struct Budget {
  /// Seconds from the call, 0 or more. What it ends depends on the machine. Default: no limit.
  std::optional<double> time_limit = std::nullopt;
  /// Units of work, 0 or more: one is an iteration of a numerical method, a configuration of a
  /// graph, a sample, or a step of a simulation, which take some microseconds. What it ends is the
  /// same on every machine. Default: no limit.
  std::optional<std::int64_t> max_work = std::nullopt;
  /// Returns whether the search is to end. Called every millisecond or more often, by several
  /// threads at once where the search has several; it must not throw. Default: never.
  std::function<bool()> cancelled = {};
  /// Called now and then with the fraction computed, from 0 to 1, which never falls: by motions
  /// along paths, their branches and nearby paths, batches and retiming.
  std::function<void(double)> progress = {};
  /// Set by the library for a part of a computation: adds to the work of the whole, and returns
  /// what has ended that; `complete` if nothing has.
  std::function<Ending(std::int64_t work)> whole = {};
};

}  // namespace beeline
