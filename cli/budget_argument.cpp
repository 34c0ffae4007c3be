#include "budget_argument.h"

#include <algorithm>

#include "command/interrupt.h"

namespace beeline::command {

Option BudgetArgument::time_limit_option() {
  return Option("--time-limit SECONDS",
                "End after this time, as Ctrl-C does, with exit code 1, the status time_limit and "
                "what has been found so far. With 0 a search ends at its first check, within a "
                "millisecond; an "
                "answer by closed form is given all the same. "
                "Default: no limit.",
                &time_limit_, {.range = zero_or_more});
}

std::vector<Option> BudgetArgument::options() {
  return {time_limit_option(),
          Option("--max-work N",
                 "End a computation after N iterations, configurations and samples, with the "
                 "status work_limit; the answer is the same on every machine. A verb with several "
                 "computations, such as `move --scene` or `line --branches`, gives N to each. "
                 "Default: no limit.",
                 &max_work_)};
}

Budget BudgetArgument::next() const {
  using Clock = std::chrono::steady_clock;
  if (!begin_) {
    begin_ = Clock::now();
    catch_interrupt();
  }
  Budget budget{.max_work = max_work_, .cancelled = interrupted};
  if (time_limit_) {
    const double spent = std::chrono::duration<double>(Clock::now() - *begin_).count();
    budget.time_limit = std::max(0.0, *time_limit_ - spent);
  }
  return budget;
}

}  // namespace beeline::command
