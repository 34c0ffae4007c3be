#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include <beeline/error.h>

namespace beeline {

namespace internal {
class BudgetMeter;
}

/// How a computation ended: by itself, or by a part of its budget. A result that has a status uses
/// the same name there.
enum class Ending {
  complete,    ///< the computation came to its own end
  time_limit,  ///< the budget's time ended it
  cancelled,   ///< it was cancelled
  work_limit,  ///< the budget's work ended it
};
std::string name(Ending ending);

/// The computation that a budget is a part of. Only the library makes one that is not empty.
class WholeComputation {
 public:
  WholeComputation() = default;

 private:
  friend class internal::BudgetMeter;
  explicit WholeComputation(internal::BudgetMeter& meter) : meter_(&meter) {}
  internal::BudgetMeter* meter_ = nullptr;
};

/// Limits of a search. The search ends soon after the first limit that it reaches, with a status of
/// its own and with the results found so far; it never throws for this. Searches also have limits
/// of their own, such as max_restarts and max_samples. By default only these apply, so that results
/// do not depend on the speed of the machine. A result that no limit of the budget ended is the
/// same as without a budget.
struct Budget {
  /// Time from the call, seconds, 0 or more. With 0 a search ends at its first check, within a
  /// millisecond; what it has found by then, such as an answer by closed form, is its result.
  /// The result of an ended search depends on the machine.
  /// Default: no limit.
  std::optional<double> time_limit = std::nullopt;
  /// Units of work, 0 or more: one is an iteration of a numerical method, a configuration of a
  /// graph, a sample, or a step of a simulation, which take some microseconds. The result of an
  /// ended search is the same on every machine. Default: no limit.
  std::optional<std::int64_t> max_work = std::nullopt;
  /// Function that returns whether the search must end. It is called every millisecond or more
  /// often, by several threads at once if the search has several, and must not throw. Default:
  /// never.
  std::function<bool()> cancelled = {};
  /// Function that is called now and then with the fraction computed, from 0 to 1, which increases
  /// from call to call. One call returns before the next begins, also if several threads compute. A
  /// computation that cannot estimate its fraction does not call it.
  std::function<void(double)> progress = {};
  /// The computation whose budget a part of it spends; empty in a budget of a user.
  WholeComputation whole = {};
};

}  // namespace beeline
