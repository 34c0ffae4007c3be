#include <array>
#include <bit>
#include <functional>

#include <beeline/reach/internal/slabs.h>
#include <beeline/reach/vti_file.h>
#include <beeline/read/internal/file_stream.h>
#include <beeline/read/internal/numbers.h>

namespace beeline {
namespace {

static_assert(std::endian::native == std::endian::little, "the file says little endian");

using Values = std::function<std::vector<float>(const ReachPositions&)>;

struct Column {
  const char* name;
  Values values;
};

const std::array<Column, 4>& columns() {
  static const std::array<Column, 4> all{
      {{"directions", [](const ReachPositions& best) { return best.directions; }},
       {"branches",
        [](const ReachPositions& best) {
          return std::vector<float>(best.branches.begin(), best.branches.end());
        }},
       {"manipulability", [](const ReachPositions& best) { return best.manipulability; }},
       {"margin", [](const ReachPositions& best) { return best.margin; }}}};
  return all;
}

std::string header_of(const ReachGrid& grid, std::uint64_t bytes) {
  std::string extent, origin, spacing;
  for (const ReachAxis& axis : grid.axes()) {
    const char* between = extent.empty() ? "" : " ";
    extent += between + ("0 " + std::to_string(axis.cells));
    origin += between + internal::exact(axis.lower);
    spacing += between + internal::exact(axis.step);
  }
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<ImageData WholeExtent=\"" +
      extent + "\" Origin=\"" + origin + "\" Spacing=\"" + spacing + "\">\n<Piece Extent=\"" +
      extent + "\">\n<CellData>\n";
  for (std::size_t k = 0; k < columns().size(); ++k) {
    text += "<DataArray type=\"Float32\" Name=\"" + std::string(columns()[k].name) +
            "\" format=\"appended\" offset=\"" + std::to_string(k * (sizeof bytes + bytes)) +
            "\"/>\n";
  }
  return text + "</CellData>\n</Piece>\n</ImageData>\n<AppendedData encoding=\"raw\">\n_";
}

std::string_view bytes_of(const auto* values, std::size_t count) {
  return {reinterpret_cast<const char*>(values), count * sizeof *values};
}

}  // namespace

void write_vti(const ReachMap& map, const std::string& path) {
  if (!map.complete()) throw FileError(map.path(), 0, "is incomplete: merge its parts first");
  const ReachGrid& grid = map.grid();
  const auto positions = static_cast<std::size_t>(grid.positions());
  // The map's positions have z the fastest, an image x.
  std::array<std::vector<float>, 4> images;
  for (std::vector<float>& image : images) image.resize(positions);
  const Eigen::Index nx = grid.axes()[0].cells, ny = grid.axes()[1].cells;
  const internal::Slabs slabs(grid);
  for (Eigen::Index s = 0; s < slabs.count(); ++s) {
    const Eigen::Index first = slabs.first(s), last = slabs.last(s);
    const ReachPositions best = reach_positions(grid, map.cells(first, last));
    for (std::size_t k = 0; k < images.size(); ++k) {
      const std::vector<float> values = columns()[k].values(best);
      for (Eigen::Index p = first; p < last; ++p) {
        const auto [x, y, z] = grid.indices(p);
        images[k][static_cast<std::size_t>((z * ny + y) * nx + x)] =
            values[static_cast<std::size_t>(p - first)];
      }
    }
  }
  const std::uint64_t size = positions * sizeof(float);
  internal::OutputFile file(path);
  file.append(header_of(grid, size));
  for (const std::vector<float>& image : images) {
    file.append(bytes_of(&size, 1));
    file.append(bytes_of(image.data(), positions));
  }
  file.append("\n</AppendedData>\n</VTKFile>\n");
  file.commit();
}

}  // namespace beeline
