#pragma once

#include <atomic>
#include <chrono>
#include <mutex>

#include <beeline/budget.h>
#include <beeline/reason.h>

namespace beeline::internal {

/// An amount of a budget.
struct SpentBudget {
  std::int64_t work = 0;
  std::chrono::steady_clock::duration time = {};
};

/// The budget of one computation, and the amount that it has spent. Functions that search take it
/// by reference and call ended() at intervals of less than a millisecond.
class BudgetMeter {
 public:
  /// Starts the clock. Keeps a reference to the budget, or a temporary one. Throws Error for a
  /// limit below zero.
  explicit BudgetMeter(const Budget& budget);
  explicit BudgetMeter(Budget&& budget);
  BudgetMeter(const BudgetMeter&) = delete;
  BudgetMeter& operator=(const BudgetMeter&) = delete;

  /// Adds to the work done and returns whether the computation must end, from now on. Several
  /// threads may call it. Costs one comparison without limits.
  bool ended(std::int64_t work = 1) { return limited_ && exceeded(work); }

  /// Returns why ended() has returned true; complete if it has not.
  Ending ending() const { return ending_.load(std::memory_order_relaxed); }
  bool complete() const { return ending() == Ending::complete; }

  /// Returns the budget of a part of the computation: the remainder of this one.
  Budget part();
  /// Returns the budget of a part that computes from the fraction `begin` to `end` of the whole,
  /// and reports its fraction.
  Budget part(double begin, double end);

  /// Returns the amount spent since the meter was made.
  SpentBudget spent() const;
  /// Returns the budget of a part that leaves this amount of the remainder.
  Budget part_leaving(const SpentBudget& kept);

  /// Reports the fraction computed, unless it or a greater one was reported: a search that begins
  /// again with finer steps does not run backwards. Several threads may call it; the calls of
  /// Budget::progress follow each other.
  void report(double fraction);
  bool reports() const { return static_cast<bool>(budget_.progress); }

 private:
  void start();
  bool exceeded(std::int64_t work);
  Ending reached_limit(std::int64_t work);

  Budget own_ = {};  ///< the temporary one
  const Budget& budget_;
  bool limited_ = false;
  std::atomic<Ending> ending_ = Ending::complete;
  std::atomic<std::int64_t> work_ = 0;
  std::mutex reporting_;
  std::atomic<double> reported_ = -1;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point deadline_ = std::chrono::steady_clock::time_point::max();
};

/// The steps that the threads of a computation have finished, of `all`.
class FinishedSteps {
 public:
  FinishedSteps(BudgetMeter& budget, std::int64_t all) : budget_(budget), all_(all) {}

  /// Adds steps, and reports each hundredth of them all.
  void add(std::int64_t steps);
  std::int64_t count() const { return count_; }

 private:
  std::int64_t hundredths(std::int64_t count) const { return 100 * count / all_; }

  BudgetMeter& budget_;
  const std::int64_t all_;
  std::atomic<std::int64_t> count_ = 0;
};

/// The meter of a computation without limits, which never ends.
BudgetMeter& unlimited();

/// The reason, with the field `ending`, of a search that its budget ended.
Reason ended_reason(ReasonCode code, Ending ending);

/// The enumerator of a status with the name of an ending that is not complete.
template <class Status>
Status status_of(Ending ending) {
  return ending == Ending::time_limit  ? Status::time_limit
         : ending == Ending::cancelled ? Status::cancelled
                                       : Status::work_limit;
}

/// Sets the status and the reason of a result whose search the budget ended.
template <class Result>
void set_ended(ReasonCode code, Ending ending, Result& result) {
  result.status = status_of<decltype(result.status)>(ending);
  result.reason = ended_reason(code, ending);
}

}  // namespace beeline::internal
