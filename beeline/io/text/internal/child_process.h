#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace beeline::internal {

/// Bounds of what a child process uses beyond its parent.
struct ChildLimits {
  std::uint64_t memory = 0;   ///< bytes of address space
  std::uint64_t seconds = 0;  ///< of the processor, and of the clock on the wall
};

/// Runs `work` in a copy of this process and returns what it returns; nothing if the copy crashes,
/// exceeds the limits, or writes a part of it. `work` must not start threads. Throws Error with the
/// message of an exception of `work` (FileError: its fault()), and if no process can be created.
std::optional<std::string> in_child_process(const std::function<std::string()>& work,
                                            const ChildLimits& limits);

}  // namespace beeline::internal
