#include <algorithm>
#include <array>
#include <bit>

#include <beeline/io/text/arm.h>
#include <beeline/reach/internal/coordinates.h>
#include <beeline/reach/internal/positions.h>
#include <beeline/reach/internal/zip_archive.h>
#include <beeline/reach/npz_file.h>

namespace beeline {
namespace {

static_assert(std::endian::native == std::endian::little, "the arrays say little endian");

using Shape = std::vector<Eigen::Index>;

/// The front of numpy's format .npy, version 1.0, padded to a multiple of 64 bytes.
std::string npy_front(const std::string& type, const Shape& shape) {
  std::string text = "{'descr': '" + type + "', 'fortran_order': False, 'shape': (";
  for (const Eigen::Index n : shape) text += std::to_string(n) + ",";
  text += "), }";
  constexpr std::size_t before = 10, step = 64;
  const std::size_t size = (before + text.size() + 1 + step - 1) / step * step;
  text.resize(size - before - 1, ' ');
  text += '\n';
  std::string front = "\x93NUMPY\x01";
  front += '\0';
  front += static_cast<char>(text.size() & 0xff);
  front += static_cast<char>(text.size() >> 8);
  return front + text;
}

template <class Value>
std::string_view bytes_of(const std::vector<Value>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)};
}

/// Writes one array of the cells, block by block.
template <class Value>
void write_cells(internal::ZipArchive& archive, const ReachMap& map, const char* name,
                 const std::string& type, std::vector<Value> ReachCells::*values) {
  const ReachGrid& grid = map.grid();
  Shape shape;
  for (const ReachAxis& axis : grid.axes()) shape.push_back(axis.cells);
  if (grid.directions() > 1) shape.push_back(grid.directions());
  if (grid.rolls() > 1) shape.push_back(grid.rolls());
  archive.begin_member(std::string(name) + ".npy");
  archive.append(npy_front(type, shape));
  const Eigen::Index block = internal::positions_at_once(grid);
  for (Eigen::Index p = 0; p < grid.positions(); p += block) {
    const ReachCells cells = map.cells(p, std::min(grid.positions(), p + block));
    archive.append(bytes_of(cells.*values));
  }
  archive.end_member();
}

}  // namespace

void write_npz(const ReachMap& map, const std::string& path) {
  internal::check_complete(map);
  internal::ZipArchive archive(path);
  const char* counted = map.header().samples > 0 ? "samples" : "branches";
  write_cells(archive, map, counted, "|u1", &ReachCells::branches);
  write_cells(archive, map, "manipulability", "<f4", &ReachCells::manipulability);
  write_cells(archive, map, "margin", "<f4", &ReachCells::margin);
  for (const internal::Coordinates& axis : internal::coordinates_of(map.grid())) {
    const auto count = std::ssize(axis.values) / axis.columns;
    archive.begin_member(axis.name + std::string(".npy"));
    archive.append(npy_front("<f8", axis.columns > 1 ? Shape{count, axis.columns} : Shape{count}));
    archive.append(bytes_of(axis.values));
    archive.end_member();
  }
  const std::string arm = arm_to_json(map.arm());
  archive.begin_member("arm.npy");
  archive.append(npy_front("|S" + std::to_string(arm.size()), {}));
  archive.append(arm);
  archive.end_member();
  archive.commit();
}

}  // namespace beeline
