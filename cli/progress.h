#pragma once

/// A percentage on stderr for long work, when stderr is a terminal: nothing in a pipe.
class Progress {
 public:
  Progress();
  ~Progress();  ///< wipes the line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(double share);

 private:
  bool terminal_;
  int shown_ = -1;
};
