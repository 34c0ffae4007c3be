#pragma once

#include <string>
#include <string_view>

#include <beeline/error.h>

namespace beeline::internal {

/// The text of an arm's file after xacro. A file whose ending is `.xacro` is expanded by the
/// program `xacrodoc` or, without it, `xacro`, that stands in a folder of PATH, with the arguments
/// of the thread's KeptExpansions. It runs without a shell, for at most a minute each time, and may
/// write 8 MiB. If xacrodoc fails, it runs again with the folders of the packages that `$(find
/// NAME)` and `package://NAME/` name in the file, and with the folder around the file's package
/// (package_folder.h). A file with another ending is its own text, because xacro executes
/// expressions of Python: the reader reports elements of xacro in it.
class ExpandedText {
 public:
  /// `text` must outlive this object. Throws FileError for a .xacro file where neither program is
  /// installed, and with the program's own message where it fails.
  ExpandedText(std::string_view text, const std::string& path);
  ExpandedText(const ExpandedText&) = delete;
  ExpandedText& operator=(const ExpandedText&) = delete;

  std::string_view text() const { return program_.empty() ? text_ : expanded_; }
  /// The program's name, as lines of errors are of the text that it wrote; empty: none.
  const std::string& program() const { return program_; }

 private:
  void expand(const std::string& path);

  std::string_view text_;
  std::string expanded_, program_;
};

/// Returns `line 12 of the text that xacro makes of it: `.
inline std::string line_of_program(int line, const std::string& program) {
  return "line " + std::to_string(line) + " of the text that " + program + " makes of it: ";
}

/// Returns what `read` returns. The lines of its FileErrors are of the expanded text: of one that a
/// program wrote, the errors about the file at `path` say so.
template <class Read>
auto with_lines_of(const ExpandedText& expanded, const std::string& path, const Read& read) {
  if (expanded.program().empty()) return read();
  try {
    return read();
  } catch (const FileError& error) {
    if (error.line() == 0 || error.path() != path) throw;
    throw FileError(error.path(), 0,
                    line_of_program(error.line(), expanded.program()) + error.fault());
  }
}

}  // namespace beeline::internal
