#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <thread>

#include <beeline/budget.h>

#include <nanobind/nanobind.h>

namespace beeline::python {

namespace nb = nanobind;

/// A Python object that is released with Python's lock, from whichever thread.
std::shared_ptr<nb::object> shared_object(nb::object object);

/// The `progress` of a Budget: none for False or None, a progress bar for True, else the callable.
std::function<void(double)> progress_of(nb::handle value);

/// Releases Python's lock during its life. A thread that needed the lock again while the
/// interpreter ends would abort the process: so the interpreter waits, before it ends, until the
/// threads that have released the lock here have it again, for 5 s at most; those that do not
/// come stop for ever instead. Raises SystemExit, which ends a thread, where the interpreter is
/// ending already.
class LockRelease {
 public:
  LockRelease();
  LockRelease(const LockRelease&) = delete;
  LockRelease& operator=(const LockRelease&) = delete;
  ~LockRelease();

 private:
  PyThreadState* state_;
};

/// Makes the interpreter wait, before it ends, until this thread has left the scope, in which it
/// calls code that may release Python's lock: numpy does while it copies. Raises SystemExit where
/// the interpreter is ending already. Requires Python's lock.
class EndDelay {
 public:
  EndDelay();
  EndDelay(const EndDelay&) = delete;
  EndDelay& operator=(const EndDelay&) = delete;
  ~EndDelay();
};

/// Whether the interpreter is ending, in which work of this thread has no purpose.
bool interpreter_ends();

/// Raises SystemExit then.
void check_interpreter();

/// Makes the interpreter wait as LockRelease needs it.
void bind_exit(nb::module_& module);

/// While work runs without Python's lock: ends it, through its budget, at Ctrl-C, at an
/// exception of the progress callback, and where the interpreter ends. Signals reach Python's main
/// thread only, so only the thread that the work was called from looks for them. Costs nothing
/// until the budget is asked: closed forms of inverse kinematics take less than a microsecond.
class Interruption {
 public:
  explicit Interruption(Budget& budget);
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;
  ~Interruption();

  /// Throws the exception that ended the work, SystemExit at the end of the interpreter. Requires
  /// Python's lock.
  void rethrow();

 private:
  bool signalled();
  void report(double fraction);

  Budget& budget_;
  const std::thread::id caller_ = std::this_thread::get_id();
  /// Questions of the caller's thread since the last look at the clock, and until the next: looking
  /// each time takes long.
  unsigned asked_ = 0, interval_ = 16;
  std::chrono::steady_clock::time_point last_look_{};
  std::chrono::steady_clock::time_point next_check_{};  ///< set when the clock is looked at first
  std::function<void(double)> progress_;
  std::atomic<bool> ended_ = false;
  std::optional<nb::python_error> error_;  ///< needs Python's lock
};

/// Returns work(), computed without Python's lock; `budget` is the one that the work uses.
template <class Work>
auto unlocked(Budget& budget, Work work) {
  Interruption interruption(budget);
  auto result = [&] {
    const LockRelease release;
    return work();
  }();
  interruption.rethrow();
  return result;
}

}  // namespace beeline::python
