#pragma once

#include <string>
#include <string_view>

namespace beeline::internal {

/// A comment of a file, without its sign, such as #.
struct Comment {
  std::string text;
  int line = 0;  ///< of the file, from 1
};

/// The beginning of Beeline's comments in a file that it writes, whose numbers are in rad, m and s.
/// The comments on the lines after it are Beeline's, too: they name commands, files and bodies.
inline constexpr std::string_view own_comment = "Beeline: ";

}  // namespace beeline::internal
