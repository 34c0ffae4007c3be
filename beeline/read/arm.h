#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <beeline/error.h>
#include <beeline/model/arm.h>

namespace beeline {

/// Selects a chain of a tree of links. It runs from the base up to a common ancestor and down to
/// the tip.
struct ChainEnds {
  std::string base = {};  ///< name of a link; empty: the root
  std::string tip = {};   ///< name of a link; empty: the leaf that read_urdf() selects
};

/// Returns the arm that `text` names: a built-in arm (`panda`, in any case), a joint string with
/// link lengths
/// (`RRR:3.5,3.5,2`), or a file, whose format is given by its ending (`.urdf`, `.json`). `ends` is
/// for URDF files only. Appends to `notes`, unless null, a sentence for what was selected among
/// several.
/// Throws Error for a text that is none of these (it suggests the most similar built-in name), and
/// FileError for a file that cannot be read.
Arm read_arm(const std::string& text, const ChainEnds& ends = {},
             std::vector<std::string>* notes = nullptr);

/// The same from the text of a file; the ending of `path` gives its format, and messages name it.
Arm arm_from_text(std::string_view text, const std::string& path, const ChainEnds& ends = {},
                  std::vector<std::string>* notes = nullptr);

}  // namespace beeline
