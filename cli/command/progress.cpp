#include "progress.h"

#include <fmt/format.h>

#include "streams.h"

#include <unistd.h>

namespace beeline::command {

Progress::Progress() : terminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (percent_ >= 0) write_stderr("\r\033[K");
}

void Progress::show(double fraction) {
  const int percent = static_cast<int>(100 * fraction);
  const std::lock_guard lock(showing_);
  if (!terminal_ || percent == percent_) return;
  percent_ = percent;
  write_stderr(fmt::format("\r{:3d} %", percent));
}

Budget Progress::of(Budget budget) {
  budget.progress = [this](double fraction) { show(fraction); };
  return budget;
}

}  // namespace beeline::command
