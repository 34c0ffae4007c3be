#pragma once

#include <string>

#include <beeline/reach/internal/hdf5_file.h>
#include <beeline/reach/reach_map.h>

namespace beeline::internal {

/// Writes the header of a map as attributes of the root, and the coordinates of its cells.
void write_header(Hdf5File& file, const ReachMapHeader& header);

/// Reads it. Throws FileError for a file that is no reach map.
ReachMapHeader read_header(const Hdf5File& file, const std::string& path);

/// Throws FileError unless the header of the file is of the expected map, computed alike.
void check_same_map(const std::string& path, const ReachMapHeader& header,
                    const ReachMapHeader& expected);

}  // namespace beeline::internal
