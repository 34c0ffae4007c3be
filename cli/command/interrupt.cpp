#include "interrupt.h"

#include <atomic>
#include <csignal>

namespace {

std::atomic<bool> caught = false;
static_assert(std::atomic<bool>::is_always_lock_free);  // as a signal handler needs

}  // namespace

void catch_interrupt() {
  struct sigaction action {};
  struct sigaction before {};
  // A program in the background of a shell ignores interrupts.
  if (sigaction(SIGINT, nullptr, &before) == 0 && before.sa_handler == SIG_IGN) return;
  action.sa_handler = [](int) { caught = true; };
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  sigaction(SIGINT, &action, nullptr);
}

bool interrupted() { return caught; }
