#include "progress.h"

#include <cstdio>
#include <fmt/core.h>

#include <unistd.h>

Progress::Progress() : terminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (shown_ >= 0) fmt::print(stderr, "\r\033[K");
}

void Progress::show(double share) {
  const int percent = static_cast<int>(100 * share);
  if (!terminal_ || percent == shown_) return;
  shown_ = percent;
  fmt::print(stderr, "\r{:3d} %", percent);
  std::fflush(stderr);
}
