#include "interruption.h"

#include <atomic>
#include <chrono>
#include <memory>
#include <thread>

#include "value.h"

namespace beeline::python {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds between_checks{20};

}  // namespace

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

struct Interruption::State {
  const std::thread::id caller = std::this_thread::get_id();
  Clock::time_point next_check = Clock::now() + between_checks;
  unsigned asked = 0;  ///< by the caller's thread; looking at the clock each time takes long
  std::function<void(double)> progress;
  std::atomic<bool> ended = false;
  std::optional<nb::python_error> error;  ///< needs Python's lock

  /// Returns whether a signal has raised an exception, such as KeyboardInterrupt.
  bool signalled() {
    if (std::this_thread::get_id() != caller || ++asked % 16 != 0) return ended;
    if (Clock::now() < next_check) return ended;
    next_check = Clock::now() + between_checks;
    nb::gil_scoped_acquire lock;
    if (!error && PyErr_CheckSignals() != 0) {
      error.emplace();
      ended = true;
    }
    return ended;
  }

  void report(double fraction) {
    nb::gil_scoped_acquire lock;
    if (error) return;
    try {
      progress(fraction);
    } catch (nb::python_error& raised) {
      error.emplace(std::move(raised));
      ended = true;
    }
  }
};

Interruption::Interruption(Budget& budget) : budget_(budget), state_(std::make_unique<State>()) {
  State* state = state_.get();
  budget.cancelled = [state] { return state->signalled(); };
  if (!budget.progress) return;
  state->progress = std::move(budget.progress);
  budget.progress = [state](double fraction) { state->report(fraction); };
}

Interruption::~Interruption() {
  budget_.cancelled = {};
  budget_.progress = std::move(state_->progress);
}

void Interruption::rethrow() {
  if (state_->error) throw std::move(*state_->error);
}

}  // namespace beeline::python
