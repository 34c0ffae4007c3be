#pragma once

#include <chrono>
#include <optional>

#include <beeline/budget.h>

#include "command/option.h"

namespace beeline::command {

/// --time-limit and --max-work of a verb that searches, which Ctrl-C ends too.
class BudgetArgument {
 public:
  std::vector<Option> options();
  Option time_limit_option();

  /// The budget of the verb's next computation: the time that is left of the limit, which begins
  /// with the first of them. From then on Ctrl-C cancels.
  Budget next() const;

 private:
  std::optional<double> time_limit_;
  std::optional<std::int64_t> max_work_;
  mutable std::optional<std::chrono::steady_clock::time_point> begin_;
};

}  // namespace beeline::command
