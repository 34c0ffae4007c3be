#pragma once

#include <cstddef>
#include <string>

#include <beeline/model/arm.h>

namespace beeline {

/// Which chain is cut out of a tree. Empty: the only end there is.
struct ChainEnds {
  std::string base;  ///< a link's name; default the root
  std::string tip;   ///< a link's name; default the only leaf
};

/// No serial arm has more joints: a longer description is refused as an accident.
constexpr std::size_t max_joints = 10000;

/// An arm from what a person types: a built-in name (`panda`, in any case), a joint string with
/// link lengths (`RRR:3.5,3.5,2`), or a file (`.urdf`, `.json`). Base and tip go with URDF files
/// only. Throws Error for a name that is none of these (with the nearest built-in one), FileError
/// for a file that cannot be read.
Arm read_arm(const std::string& text, const ChainEnds& ends = {});

}  // namespace beeline
