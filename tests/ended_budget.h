#pragma once

#include <atomic>
#include <gtest/gtest.h>

#include <beeline/budget.h>

namespace beeline::testing {

/// A budget that cancels at its question number n, from 0 on, and at all later ones.
class CancelAt {
 public:
  explicit CancelAt(int n) : n_(n) {}
  CancelAt(const CancelAt&) = delete;
  CancelAt& operator=(const CancelAt&) = delete;

  Budget budget() {
    return {.cancelled = [this] { return asked_++ >= n_; }};
  }
  /// Whether it has cancelled.
  bool cancelled() const { return asked_ > n_; }

 private:
  int n_;
  std::atomic<int> asked_ = 0;
};

/// A function for Budget::progress without a lock of its own. Fails if the fraction does not
/// increase or a call begins before the last has returned.
struct Reports {
  int calls = 0, running = 0;
  double last = -1;

  void operator()(double fraction) {
    EXPECT_EQ(++running, 1);
    EXPECT_GT(fraction, last);
    last = fraction;
    ++calls;
    --running;
  }
};

/// Calls `run(n)` with n = 0, 1, 2, ..., from `dense` on in growing steps, until it returns false,
/// which it does for a computation that was not cancelled.
template <class Run>
void for_each_cancellation(int dense, Run&& run) {
  for (int n = 0; run(n); n += n < dense ? 1 : 1 + n / 8) {
  }
}

}  // namespace beeline::testing
