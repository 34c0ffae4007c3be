#include <algorithm>
#include <cmath>
#include <utility>

#include <beeline/error.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/internal/enum_names.h>

namespace beeline {

std::string name(Ending ending) {
  constexpr internal::EnumNames<Ending> names("ending");
  return names.of(ending);
}

namespace internal {

BudgetMeter& unlimited() {
  static BudgetMeter meter((Budget()));
  return meter;
}

BudgetMeter::BudgetMeter(const Budget& budget) : budget_(budget) { start(); }

BudgetMeter::BudgetMeter(Budget&& budget) : own_(std::move(budget)), budget_(own_) { start(); }

void BudgetMeter::start() {
  using Clock = std::chrono::steady_clock;
  if (budget_.time_limit) {
    if (!(*budget_.time_limit >= 0)) {
      throw Error("", "time_limit",
                  " is " + number(*budget_.time_limit) + " s; it must be 0 or more");
    }
    constexpr double forever = 1e9;  // seconds; a longer time would overflow the clock's count
    if (*budget_.time_limit < forever) {
      deadline_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                     std::chrono::duration<double>(*budget_.time_limit));
    }
  }
  if (budget_.max_work && *budget_.max_work < 0) {
    throw Error("", "max_work",
                " is " + std::to_string(*budget_.max_work) + "; it must be 0 or more");
  }
  limited_ = budget_.time_limit || budget_.max_work || budget_.cancelled ||
             budget_.whole.meter_ != nullptr;
}

Budget BudgetMeter::part() {
  if (!limited_) return {};
  return {.whole = WholeComputation(*this)};
}

Budget BudgetMeter::part(double begin, double end) {
  Budget some = part();
  if (reports()) {
    some.progress = [this, begin, end](double fraction) {
      report(std::lerp(begin, end, fraction));
    };
  }
  return some;
}

SpentBudget BudgetMeter::spent() const {
  return {work_.load(std::memory_order_relaxed), std::chrono::steady_clock::now() - begin_};
}

Budget BudgetMeter::part_leaving(const SpentBudget& kept) {
  using Clock = std::chrono::steady_clock;
  Budget some = part();
  if (BudgetMeter* const whole = budget_.whole.meter_) {
    const Budget of_whole = whole->part_leaving(kept);
    some.max_work = of_whole.max_work;
    some.time_limit = of_whole.time_limit;
  }
  if (budget_.max_work) {
    const std::int64_t left =
        std::max<std::int64_t>(0, *budget_.max_work - spent().work - kept.work);
    some.max_work = std::min(left, some.max_work.value_or(left));
  }
  if (deadline_ != Clock::time_point::max()) {
    const std::chrono::duration<double> time = deadline_ - Clock::now() - kept.time;
    const double left = std::max(0.0, time.count());
    some.time_limit = std::min(left, some.time_limit.value_or(left));
  }
  return some;
}

void BudgetMeter::report(double fraction) {
  if (!budget_.progress || fraction <= reported_) return;
  const std::lock_guard lock(reporting_);
  if (fraction <= reported_) return;  // another thread was first
  reported_ = fraction;
  budget_.progress(fraction);
}

bool BudgetMeter::exceeded(std::int64_t work) {
  if (!complete()) return true;
  const Ending reached = reached_limit(work);
  if (reached == Ending::complete) return false;
  Ending expected = Ending::complete;  // another thread may have been first
  ending_.compare_exchange_strong(expected, reached);
  return true;
}

Ending BudgetMeter::reached_limit(std::int64_t work) {
  using Clock = std::chrono::steady_clock;
  const std::int64_t all = work_.fetch_add(work, std::memory_order_relaxed) + work;
  BudgetMeter* const whole = budget_.whole.meter_;
  if (whole != nullptr && whole->ended(work)) return whole->ending();
  if (budget_.cancelled && budget_.cancelled()) return Ending::cancelled;
  if (budget_.max_work && all > *budget_.max_work) return Ending::work_limit;
  const bool late = deadline_ != Clock::time_point::max() && Clock::now() >= deadline_;
  return late ? Ending::time_limit : Ending::complete;
}

void FinishedSteps::add(std::int64_t steps) {
  const std::int64_t before = count_.fetch_add(steps), now = before + steps;
  if (hundredths(now) == hundredths(before)) return;
  budget_.report(static_cast<double>(now) / static_cast<double>(all_));
}

Reason ended_reason(ReasonCode code, Ending ending) {
  return {code, {{ReasonField::ending, ending}}};
}

}  // namespace internal
}  // namespace beeline
