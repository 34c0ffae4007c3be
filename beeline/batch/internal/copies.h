#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <vector>

namespace beeline::internal {

/// Copies of a value for the threads of in_parallel(). Each block borrows one. A copy is made when
/// all others are in use.
template <class Value>
class Copies {
 public:
  using Loan = std::unique_ptr<Value, std::function<void(Value*)>>;

  explicit Copies(const Value& original) : original_(original) {}

  /// Returns a copy in the state that the previous block left. The copy comes back when the loan is
  /// destroyed, which must happen before this object is destroyed.
  Loan borrow() {
    const std::lock_guard lock(mutex_);
    if (free_.empty()) free_.push_back(std::make_unique<Value>(original_));
    Value* copy = free_.back().release();
    free_.pop_back();
    return {copy, [this](Value* returned) {
              const std::lock_guard returning(mutex_);
              free_.emplace_back(returned);
            }};
  }

 private:
  const Value original_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Value>> free_;
};

}  // namespace beeline::internal
