#pragma once

#include <string>

namespace beeline::internal {

/// A comment of a file, without its sign, such as #.
struct Comment {
  std::string text;
  int line = 0;  ///< of the file, from 1
};

}  // namespace beeline::internal
