#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <beeline/io/text/scene.h>

namespace beeline::internal {

/// A format of arm files; arm.cpp has the table of all.
struct ArmFormat {
  std::string_view ending;
  bool tree;  ///< files describe a tree of links, of which ChainEnds selects a chain
  Arm (*parse)(std::string_view text, const std::string& path, const ChainEnds& ends,
               std::vector<ReadWarning>* warnings);
  /// The shapes in the file, as arm_shapes_from_text() returns them without allowed pairs. `states`
  /// are the states of `options.srdf`. Throws Error for options that files of this format ignore.
  ArmShapes (*shapes)(std::string_view text, const std::string& path, const ChainEnds& ends,
                      const ShapeOptions& options, const std::vector<Srdf::State>& states);
};

/// The endings with dots, of all formats or of those that describe trees of links.
std::vector<std::string> known_endings(bool trees_only = false);

/// Throws Error for joints that are held, in a file that has none beside the chain.
void refuse_hold(const ShapeOptions& options);

/// Returns the format with the ending of the path; null for another ending.
const ArmFormat* arm_format_of(std::string_view path);

/// Returns the same for a file that has to be an arm. Throws FileError for another ending, and
/// Error for ends of a file that does not describe a tree of links.
const ArmFormat& arm_format_of_file(const std::string& path, const ChainEnds& ends);

}  // namespace beeline::internal
