#pragma once

#include <map>
#include <string>
#include <utility>

#include <beeline/error.h>

namespace beeline::web {

/// Values that the page names by numbers, which are not used again.
template <class Value>
class Handles {
 public:
  explicit Handles(std::string what) : what_(std::move(what)) {}

  int add(Value value) {
    values_.emplace(next_, std::move(value));
    return next_++;
  }

  /// Throws Error for an unknown handle.
  Value& at(int handle) {
    const auto found = values_.find(handle);
    if (found == values_.end()) throw unknown(handle);
    return found->second;
  }

  void release(int handle) {
    if (values_.erase(handle) == 0) throw unknown(handle);
  }

 private:
  Error unknown(int handle) const {
    return Error("no " + what_ + " has the handle " + std::to_string(handle));
  }

  std::string what_;
  std::map<int, Value> values_;
  int next_ = 0;
};

}  // namespace beeline::web
