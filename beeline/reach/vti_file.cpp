#include <array>
#include <bit>
#include <functional>

#include <beeline/reach/internal/positions.h>
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

std::string header_of(const std::array<ReachAxis, 3>& axes, std::uint64_t bytes) {
  std::string extent, origin, spacing;
  for (const ReachAxis& axis : axes) {
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
  const std::array<ReachAxis, 3> axes = map.grid().cartesian_axes();
  const std::vector<Vector3> centres = internal::centres_of(axes);
  const ReachPositions best = internal::positions_at(map, centres);
  const std::uint64_t size = centres.size() * sizeof(float);
  internal::OutputFile file(path);
  file.append(header_of(axes, size));
  for (const Column& column : columns()) {
    // The positions have z the fastest, an image x.
    const std::vector<float> values = column.values(best);
    std::vector<float> image;
    image.reserve(values.size());
    for (Eigen::Index z = 0; z < axes[2].cells; ++z) {
      for (Eigen::Index y = 0; y < axes[1].cells; ++y) {
        for (Eigen::Index x = 0; x < axes[0].cells; ++x) {
          image.push_back(values[(x * axes[1].cells + y) * axes[2].cells + z]);
        }
      }
    }
    file.append(bytes_of(&size, 1));
    file.append(bytes_of(image.data(), image.size()));
  }
  file.append("\n</AppendedData>\n</VTKFile>\n");
  file.commit();
}

}  // namespace beeline
