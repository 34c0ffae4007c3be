#include "interruption.h"

#include "value.h"

namespace beeline::python {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds between_checks{10};

// Work that asks more rarely looks at the clock each time, other work each fourth time.
constexpr std::chrono::microseconds often{10};

// The end of the interpreter.
constexpr std::chrono::seconds longest_wait{5};
std::atomic<int> released = 0;               // threads in the life of a LockRelease or EndDelay
std::atomic<std::thread::id> ending_thread;  // the one that ends the interpreter, once it does
std::atomic<bool> ended = false;             // no other thread gets Python's lock again

/// Ends all work and waits until its threads have Python's lock again. The work ends with
/// SystemExit, so a thread cannot go on for long.
void end_work() {
  ending_thread = std::this_thread::get_id();
  // Threads that do not end hold references to the end: these are no leaks.
  const nb::object threads = nb::module_::import_("threading").attr("active_count")();
  if (nb::cast<int>(threads) > 1) nb::set_leak_warnings(false);
  const nb::gil_scoped_release release;
  const Clock::time_point deadline = Clock::now() + longest_wait;
  while (released > 0 && Clock::now() < deadline) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ended = true;
}

/// Stops a thread that Python ends, by unwinding its stack, as it came for the lock too late: in
/// Python code that a function of this module called. nanobind's catch (...) has caught that, and
/// without an exception; to return would abort the process.
void stop_unwound_thread(const std::exception_ptr& error, void*) {
  while (!error) std::this_thread::sleep_for(std::chrono::hours(1));
  std::rethrow_exception(error);
}

}  // namespace

bool interpreter_ends() {
  const std::thread::id ending = ending_thread.load(std::memory_order_relaxed);
  return ending != std::thread::id() && ending != std::this_thread::get_id();
}

void check_interpreter() {
  if (!interpreter_ends()) return;
  PyErr_SetNone(PyExc_SystemExit);
  throw nb::python_error();
}

LockRelease::LockRelease() {
  check_interpreter();
  ++released;
  state_ = PyEval_SaveThread();
}

LockRelease::~LockRelease() {
  while (ended && interpreter_ends()) std::this_thread::sleep_for(std::chrono::hours(1));
  PyEval_RestoreThread(state_);
  --released;
}

EndDelay::EndDelay() {
  check_interpreter();
  ++released;
}

EndDelay::~EndDelay() { --released; }

void bind_exit(nb::module_& module) {
  nb::register_exception_translator(&stop_unwound_thread);
  module.def("_end_work", &end_work, nb::sig("def _end_work() -> None"));
  module.def(
      "_after_fork", [] { released = 0; }, nb::sig("def _after_fork() -> None"));
  nb::module_::import_("atexit").attr("register")(module.attr("_end_work"));
  const nb::module_ os = nb::module_::import_("os");
  if (nb::hasattr(os, "register_at_fork")) {
    os.attr("register_at_fork")(nb::arg("after_in_child") = module.attr("_after_fork"));
  }
}

std::shared_ptr<nb::object> shared_object(nb::object object) {
  return {new nb::object(std::move(object)), [](nb::object* held) {
            nb::gil_scoped_acquire lock;
            delete held;
          }};
}

std::function<void(double)> progress_of(nb::handle value) {
  if (value.is_none() || value.ptr() == Py_False) return {};
  nb::object callable = nb::borrow(value);
  if (value.ptr() == Py_True) {
    callable = nb::module_::import_("beeline._progress").attr("ProgressBar")();
  }
  if (!PyCallable_Check(callable.ptr())) raise_type("progress", "a callable or a bool", value);
  return [held = shared_object(std::move(callable))](double fraction) { (*held)(fraction); };
}

Interruption::Interruption(Budget& budget) : budget_(budget) {
  budget.cancelled = [this] { return signalled(); };
  if (!budget.progress) return;
  progress_ = std::move(budget.progress);
  budget.progress = [this](double fraction) { report(fraction); };
}

Interruption::~Interruption() {
  budget_.cancelled = {};
  budget_.progress = std::move(progress_);
}

/// Returns whether a signal has raised an exception, such as KeyboardInterrupt.
bool Interruption::signalled() {
  if (interpreter_ends()) return true;
  if (std::this_thread::get_id() != caller_ || ++asked_ < interval_) return ended_;
  const Clock::time_point now = Clock::now();
  interval_ = now - last_look_ < asked_ * often ? 4 : 1;
  last_look_ = now;
  asked_ = 0;
  if (now < next_check_) return ended_;
  const bool first = next_check_ == Clock::time_point();
  next_check_ = now + between_checks;
  if (first) return ended_;
  nb::gil_scoped_acquire lock;
  if (!error_ && PyErr_CheckSignals() != 0) {
    error_.emplace();
    ended_ = true;
  }
  return ended_;
}

void Interruption::report(double fraction) {
  if (interpreter_ends()) return;
  nb::gil_scoped_acquire lock;
  if (error_) return;
  try {
    progress_(fraction);
  } catch (nb::python_error& raised) {
    error_.emplace(std::move(raised));
    ended_ = true;
  }
}

void Interruption::rethrow() {
  check_interpreter();
  if (error_) throw std::move(*error_);
}

}  // namespace beeline::python
