#include "progress.h"

#include <fmt/format.h>

#include "streams.h"

#include <unistd.h>

namespace beeline::command {
namespace {

ProgressListener& listener() {
  static ProgressListener none = nullptr;
  return none;
}

}  // namespace

void listen_to_progress(ProgressListener receiver) { listener() = receiver; }

Progress::Progress() : terminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (percent_ >= 0) write_stderr("\r\033[K");
}

void Progress::show(double fraction) {
  if (listener() != nullptr) return listener()(fraction);
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
