#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <beeline/io/text/internal/byte_blocks.h>
#include <beeline/pose/so3.h>

namespace beeline::internal {

/// The endings of the mesh files that are read.
const std::vector<std::string>& mesh_endings();

/// Reads the corners of the triangles of a mesh file, in its unit, in any order and possibly
/// repeated: STL, binary or ASCII, or OBJ, by the ending of the path. Of OBJ files the vertices
/// that no face uses do not count. Throws FileError for another ending, a file larger than 1 GiB or
/// with more than 5,000,000 different corners, one that is cut off, malformed or without triangles,
/// and a coordinate that is not a finite number.
std::vector<Vector3> read_mesh(const std::string& path);
/// The same from the bytes of a file.
std::vector<Vector3> mesh_from_text(std::string_view bytes, const std::string& path);

/// The bound of different corners of triangles in a file, or of vertices.
constexpr std::size_t max_mesh_corners = 5'000'000;

/// The readers of the formats.
std::vector<Vector3> mesh_from_stl(ByteBlocks& bytes);
std::vector<Vector3> mesh_from_obj(ByteBlocks& bytes);

/// Reads the next number of a line, after blanks, and removes it from the line. Throws FileError.
double take_number(std::string_view& line, const ByteBlocks& bytes);

/// Removes the next word from a line, up to a blank, and returns it; empty at the end of the line.
std::string_view take_word(std::string_view& line);

}  // namespace beeline::internal
