#pragma once

#include <cstddef>
#include <string>

#include <beeline/error.h>
#include <beeline/model/arm.h>

namespace beeline {

/// Selects a chain of a tree of links.
struct ChainEnds {
  std::string base;  ///< name of a link; empty: the root
  std::string tip;   ///< name of a link; empty: the only leaf below the base
};

/// Readers refuse descriptions with more joints.
constexpr std::size_t max_joints = 10000;

/// Returns the arm that `text` names: a built-in arm (`panda`, in any case), a joint string with
/// link lengths
/// (`RRR:3.5,3.5,2`), or a file, whose format is given by its ending (`.urdf`, `.json`). `ends` is
/// for URDF files only.
/// Throws Error for a text that is none of these (it suggests the most similar built-in name), and
/// FileError for a file that cannot be read.
Arm read_arm(const std::string& text, const ChainEnds& ends = {});

}  // namespace beeline
