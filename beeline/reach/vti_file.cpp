#include <array>
#include <bit>
#include <functional>

#include <beeline/io/text/file.h>
#include <beeline/io/text/numbers.h>
#include <beeline/reach/internal/positions.h>
#include <beeline/reach/surface.h>

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

std::string header_of(const std::array<ReachAxis, 3>& axes, std::uint64_t bytes) {
  std::string extent, origin, spacing;
  for (const ReachAxis& axis : axes) {
    const char* between = extent.empty() ? "" : " ";
    extent += between + ("0 " + std::to_string(axis.cells));
    origin += between + exact(axis.lower);
    spacing += between + exact(axis.step);
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
  internal::check_complete(map);
  const std::array<ReachAxis, 3> axes = map.grid().cartesian_axes();
  const Eigen::Index nx = axes[0].cells, ny = axes[1].cells, nz = axes[2].cells;
  constexpr double most = 1e9;
  const double cells = static_cast<double>(nx) * static_cast<double>(ny) * static_cast<double>(nz);
  if (!(cells <= most)) {
    throw Error("the image would have " + number(cells) +
                " cells, at most 1e9 are possible: a coarser map has fewer");
  }
  // The positions have z the fastest, an image x.
  std::array<std::vector<float>, 4> images;
  for (std::vector<float>& image : images) image.resize(static_cast<std::size_t>(nx * ny * nz));
  Eigen::Index next = 0;
  internal::for_each_block(axes, [&](const std::vector<Vector3>& centres) {
    const ReachPositions best = internal::positions_at(map, centres);
    for (std::size_t k = 0; k < images.size(); ++k) {
      Eigen::Index p = next;
      for (const float value : columns()[k].values(best)) {
        const Eigen::Index x = p / (ny * nz), y = p / nz % ny, z = p % nz;
        images[k][static_cast<std::size_t>((z * ny + y) * nx + x)] = value;
        ++p;
      }
    }
    next += std::ssize(centres);
  });
  const std::uint64_t size = images[0].size() * sizeof(float);
  OutputFile file(path);
  file.append(header_of(axes, size));
  for (const std::vector<float>& image : images) {
    file.append(bytes_of(&size, 1));
    file.append(bytes_of(image.data(), image.size()));
  }
  file.append("\n</AppendedData>\n</VTKFile>\n");
  file.commit();
}

}  // namespace beeline
