#pragma once

#include <mutex>

/// Shows the progress of a long computation in percent on stderr, if that is a terminal.
class Progress {
 public:
  Progress();
  ~Progress();  ///< erases the line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(double fraction);  ///< from any thread

 private:
  std::mutex showing_;
  bool terminal_;
  int percent_ = -1;  ///< shown now; -1: none
};
