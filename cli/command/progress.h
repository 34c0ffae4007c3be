#pragma once

#include <mutex>

#include <beeline/budget.h>

namespace beeline::command {

/// Receives the fraction that is computed, from any thread.
using ProgressListener = void (*)(double fraction);

/// From now on every Progress goes to the listener instead of the terminal.
void listen_to_progress(ProgressListener listener);

/// Shows the progress of a long computation in percent on stderr, if that is a terminal, or gives
/// it to the listener.
class Progress {
 public:
  Progress();
  ~Progress();  ///< erases the line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(double fraction);  ///< from any thread
  /// Returns the budget of a computation that shows its progress here.
  Budget of(Budget budget);

 private:
  std::mutex showing_;
  bool terminal_;
  int percent_ = -1;  ///< shown now; -1: none
};

}  // namespace beeline::command
