#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <beeline/io/text/internal/byte_blocks.h>
#include <beeline/io/text/internal/mesh_corners.h>
#include <beeline/pose/so3.h>

namespace beeline::internal {

/// The endings of the mesh files that are read.
const std::vector<std::string>& mesh_endings();

/// Whether a path ends in .dae, .gltf or .glb: Collada or glTF. Builds with BEELINE_ASSIMP read
/// them.
bool is_scene_mesh(const std::string& path);

/// The end of a message about such a file in a build that does not read them: what to do.
std::string scene_mesh_advice();

/// Reads the corners of the triangles of a mesh file, in its unit, in any order and possibly
/// repeated: STL, binary or ASCII, OBJ, or in builds with BEELINE_ASSIMP Collada or glTF, by the
/// ending of the path. Vertices that no face uses do not count. Collada files are in metres (their
/// `<unit>` applies) and their `<up_axis>` is ignored. Throws FileError for another ending, a file
/// larger than 1 GiB (Collada, glTF: 256 MiB) or with more than 5,000,000 different corners, one
/// that is cut off, malformed or without triangles, and a coordinate that is not a finite number.
/// `rounding` gets a bound of the errors of the corners, in the unit of the file: 0, or more for
/// Collada and glTF, which are read in single precision.
std::vector<Vector3> read_mesh(const std::string& path, double* rounding = nullptr);
/// The same from the bytes of a file.
std::vector<Vector3> mesh_from_text(std::string_view bytes, const std::string& path);

/// The readers of the formats.
std::vector<Vector3> mesh_from_stl(ByteBlocks& bytes);
std::vector<Vector3> mesh_from_obj(ByteBlocks& bytes);
std::vector<Vector3> mesh_from_scene_file(ByteBlocks& bytes, double& rounding);  ///< by assimp

/// Returns the number of the four bytes from a place, of which the first counts least.
std::uint32_t little_endian(std::string_view bytes, std::size_t at);

/// Reads the next number of a line, after blanks, and removes it from the line. Throws FileError.
double take_number(std::string_view& line, const ByteBlocks& bytes);

/// Removes the next word from a line, up to a blank, and returns it; empty at the end of the line.
std::string_view take_word(std::string_view& line);

}  // namespace beeline::internal
