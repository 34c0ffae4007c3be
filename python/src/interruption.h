#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <type_traits>

#include <beeline/budget.h>

#include <nanobind/nanobind.h>

namespace beeline::python {

namespace nb = nanobind;

/// A Python object that is released with Python's lock, from whichever thread.
std::shared_ptr<nb::object> shared_object(nb::object object);

/// The `progress` of a Budget: none for False or None, a progress bar for True, else the callable.
std::function<void(double)> progress_of(nb::handle value);

/// While work runs without Python's lock: ends it, through its budget, at Ctrl-C and at an
/// exception of the progress callback. Signals reach Python's main thread only, so only the thread
/// that the work was called from looks for them.
class Interruption {
 public:
  explicit Interruption(Budget& budget);
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;
  ~Interruption();

  /// Throws the exception that ended the work. Requires Python's lock.
  void rethrow();

 private:
  struct State;
  Budget& budget_;
  std::unique_ptr<State> state_;
};

/// Returns work(), computed without Python's lock; `budget` is the one that the work uses.
template <class Work>
auto unlocked(Budget& budget, Work work) {
  Interruption interruption(budget);
  std::optional<std::invoke_result_t<Work>> result;
  {
    nb::gil_scoped_release release;
    result.emplace(work());
  }
  interruption.rethrow();
  return std::move(*result);
}

}  // namespace beeline::python
