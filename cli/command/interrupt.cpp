#include "interrupt.h"

#include <atomic>
#include <csignal>

namespace beeline::command {
namespace {

std::atomic<bool> caught = false;
static_assert(std::atomic<bool>::is_always_lock_free);  // as a signal handler needs

void catch_signal(int signal) {
  struct sigaction action {};
  action.sa_handler = [](int) { caught = true; };
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  sigaction(signal, &action, nullptr);
}

}  // namespace

void catch_interrupt() {
  struct sigaction before {};
  // A program in the background of a shell ignores interrupts.
  if (sigaction(SIGINT, nullptr, &before) == 0 && before.sa_handler == SIG_IGN) return;
  catch_signal(SIGINT);
}

void catch_termination() { catch_signal(SIGTERM); }

bool interrupted() { return caught; }

}  // namespace beeline::command
