#include <algorithm>

#include <beeline/internal/fingerprint.h>
#include <beeline/io/text/arm.h>
#include <beeline/io/text/json.h>
#include <beeline/reach/internal/branches.h>
#include <beeline/reach/internal/map_header.h>
#include <beeline/reach/internal/orientation_names.h>

namespace beeline::internal {
namespace {

constexpr const char* format_name = "beeline reach map";
/// A map of a scene has the second version, so that older programs do not take it for one without.
constexpr double version = 1, version_in_scene = 2;

constexpr const char* box_name = "box";
constexpr const char* cylinder_name = "cylinder";

/// Describes the values of a map for readers of the file.
std::string answers_of(const ReachMapHeader& header) {
  if (header.samples > 0) {
    return "by sampling: some of the sampled configurations has the tool in the cell";
  }
  if (header.grid.cylindrical()) {
    return "the inverse kinematics at the centre of each cell, at azimuth 0, with the first joint "
           "(and, with rolls, a last one that rolls the tool) free";
  }
  return "the inverse kinematics at the centre of each cell";
}

/// The fingerprint of the arm's JSON: differs where two files are of different arms.
std::string hash_of(const std::string& text) {
  Fingerprint fingerprint;
  fingerprint.add(std::string_view(text));
  return fingerprint.text();
}

std::vector<double> list_of(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

Vector3 vector_of(const std::vector<double>& list) { return {list[0], list[1], list[2]}; }

/// The coordinates of the cells along an axis of a map, as files have them: m and rad.
struct Coordinates {
  const char* name;
  std::vector<double> values;
  Eigen::Index columns = 1;  ///< numbers of each; 3 of directions
};

/// value(0) to value(count - 1).
std::vector<double> values(Eigen::Index count, const auto& value) {
  std::vector<double> all;
  for (Eigen::Index i = 0; i < count; ++i) all.push_back(value(i));
  return all;
}

std::vector<double> centres_of(const ReachAxis& axis) {
  return values(axis.cells, [&](Eigen::Index i) { return axis.centre(i); });
}

/// Returns the coordinates of the positions, then of the directions and their fractions, the
/// headings and the rolls, as far as the grid has them.
std::vector<Coordinates> coordinates_of(const ReachGrid& grid) {
  const auto& axes = grid.axes();
  const bool round = grid.cylindrical();
  std::vector<Coordinates> all{{round ? "radius" : "x", centres_of(axes[0])},
                               {round ? "height" : "y", centres_of(axes[1])},
                               {round ? "azimuth" : "z", centres_of(axes[2])}};
  const ReachOrientations orientations = grid.orientations();
  if (orientations == ReachOrientations::headings) {
    all.push_back(
        {"headings", values(grid.directions(), [&](Eigen::Index d) { return grid.heading(d); })});
  }
  if (orientations == ReachOrientations::rolls) {
    all.push_back({"rolls", values(grid.rolls(), [&](Eigen::Index r) { return grid.roll(r); })});
  }
  if (orientations == ReachOrientations::rolls || orientations == ReachOrientations::directions) {
    Coordinates directions{.name = "directions", .values = {}, .columns = 3};
    Coordinates fractions{.name = "fractions", .values = {}};
    for (Eigen::Index d = 0; d < grid.directions(); ++d) {
      for (const double c : grid.direction_grid().direction(d)) directions.values.push_back(c);
      fractions.values.push_back(grid.fraction(d));
    }
    all.push_back(std::move(directions));
    all.push_back(std::move(fractions));
  }
  return all;
}

/// The coordinates of the cells along each axis of the datasets.
void write_coordinates(Hdf5File& file, const ReachGrid& grid) {
  for (const Coordinates& axis : coordinates_of(grid)) {
    const auto columns = static_cast<unsigned long long>(axis.columns);
    Hdf5Shape shape{axis.values.size() / columns};
    if (columns > 1) shape.push_back(columns);
    file.create(axis.name, Hdf5Type::float64, shape)
        .write(Hdf5Shape(shape.size(), 0), shape, axis.values.data());
  }
}

ReachOrientations orientations_of(const Hdf5File& file, const std::string& path) {
  const std::string found = file.read_text("orientations");
  const std::vector<std::string> names = orientation_names.all();
  const auto place = std::find(names.begin(), names.end(), found);
  if (place != names.end()) return static_cast<ReachOrientations>(place - names.begin());
  throw FileError(path, 0,
                  "has orientations \"" + found.substr(0, 40) + "\"; known are " + listed(names));
}

ReachGridOptions read_options(const Hdf5File& file, const std::string& path) {
  ReachGridOptions options{.resolution = file.read_numbers("resolution", 1)[0],
                           .lower = vector_of(file.read_numbers("lower", 3)),
                           .upper = vector_of(file.read_numbers("upper", 3))};
  const std::string positions = file.read_text("positions");
  if (positions == cylinder_name) {
    options.azimuths = file.read_numbers("azimuth_spacing", 1)[0];
  } else if (positions != box_name) {
    throw FileError(path, 0,
                    "has positions \"" + positions.substr(0, 40) + "\"; known are " +
                        listed({box_name, cylinder_name}));
  }
  const ReachOrientations orientations = orientations_of(file, path);
  if (orientations == ReachOrientations::fixed) {
    const std::vector<double> rows = file.read_numbers("orientation", 9);
    Rotation rotation;
    for (int k = 0; k < 9; ++k) rotation(k / 3, k % 3) = rows[static_cast<std::size_t>(k)];
    options.orientation = rotation;
    return options;
  }
  if (orientations == ReachOrientations::any) {
    options.any_orientation = true;
    return options;
  }
  options.directions = file.read_numbers("direction_spacing", 1)[0];
  if (orientations == ReachOrientations::rolls) {
    options.rolls = file.read_numbers("roll_spacing", 1)[0];
  }
  return options;
}

std::string json_of(const ReachScene& scene) {
  return Json{{"digest", scene.digest}, {"clearance", scene.clearance}, {"files", scene.files}}
      .text();
}

ReachScene scene_from(const std::string& text, const std::string& path) {
  const JsonDocument document(text, path);
  const Json& root = document.root();
  ReachScene scene{.digest = document.text(document.need(root, "digest")),
                   .clearance = document.number(document.need(root, "clearance"))};
  for (const Json& file : document.items(document.need(root, "files"))) {
    scene.files.push_back(document.text(file));
  }
  return scene;
}

/// Names a scene in an error: "cell.json (digest 0123456789abcdef)".
std::string named(const std::optional<ReachScene>& scene) {
  if (!scene) return "none";
  return (scene->files.empty() ? "of its own" : listed(scene->files)) + " (digest " +
         scene->digest + ")";
}

std::string digest_of(const std::optional<ReachScene>& scene) { return scene ? scene->digest : ""; }

/// The arm as JSON without the frames of its controller, which a map does not depend on.
std::string kinematics_of(const Arm& arm) {
  return arm_to_json({arm.name(), arm.joints(), arm.tool(), arm.base()});
}

}  // namespace

void write_header(Hdf5File& file, const ReachMapHeader& header) {
  const ReachGridOptions options = header.grid.options();
  const std::string arm = arm_to_json(header.arm);
  file.write_text("format", format_name);
  file.write_numbers("version", {header.scene ? version_in_scene : version});
  file.write_text("arm", arm);
  file.write_text("arm_name", header.arm.name());
  file.write_text("arm_hash", hash_of(arm));
  file.write_text("frame", "cells are poses world_T_tool; metres and radians");
  file.write_text("answers", answers_of(header));
  file.write_text("positions", header.grid.cylindrical() ? cylinder_name : box_name);
  file.write_numbers("resolution", {*options.resolution});
  file.write_numbers("lower", list_of(*options.lower));
  file.write_numbers("upper", list_of(*options.upper));
  file.write_text("orientations", name(header.grid.orientations()));
  if (options.orientation) {
    std::vector<double> rows;
    for (int k = 0; k < 9; ++k) rows.push_back((*options.orientation)(k / 3, k % 3));
    file.write_numbers("orientation", rows);
  }
  if (options.azimuths) file.write_numbers("azimuth_spacing", {*options.azimuths});
  if (options.directions) file.write_numbers("direction_spacing", {*options.directions});
  if (options.rolls) file.write_numbers("roll_spacing", {*options.rolls});
  file.write_numbers("redundant_values", {static_cast<double>(header.redundant_values)});
  file.write_numbers("samples", {static_cast<double>(header.samples)});
  if (header.scene) file.write_text("scene", json_of(*header.scene));
  write_coordinates(file, header.grid);
}

ReachMapHeader read_header(const Hdf5File& file, const std::string& path) {
  if (file.read_text("format") != format_name) throw FileError(path, 0, "is no reach map");
  const double number_of_version = file.read_numbers("version", 1)[0];
  if (number_of_version != version && number_of_version != version_in_scene) {
    throw FileError(path, 0,
                    "is a reach map of version " + number(number_of_version) +
                        "; this program reads versions " + number(version) + " and " +
                        number(version_in_scene));
  }
  const std::string text = file.read_text("arm");
  if (file.read_text("arm_hash") != hash_of(text)) {
    throw FileError(path, 0, "is damaged: its arm does not have the hash arm_hash");
  }
  const double values = file.read_numbers("redundant_values", 1)[0];
  if (!(values >= 1 && values <= 1000)) {
    throw FileError(path, 0, "is damaged: redundant_values is " + number(values));
  }
  const double samples = file.read_numbers("samples", 1)[0];
  if (!(samples >= 0 && samples <= static_cast<double>(max_samples))) {
    throw FileError(path, 0, "is damaged: samples is " + number(samples));
  }
  const Arm arm = arm_from_json(text, path);
  try {
    ReachMapHeader header{arm, ReachGrid(arm, read_options(file, path)), static_cast<int>(values),
                          static_cast<std::int64_t>(samples)};
    if (number_of_version == version_in_scene) {
      header.scene = scene_from(file.read_text("scene"), path);
    }
    if (header.grid.cylindrical()) {  // refuses what has no map
      (void)free_joints(arm, header.grid, header.scene.has_value());
    }
    return header;
  } catch (const FileError&) {
    throw;
  } catch (const Error& error) {
    throw FileError(path, 0, error.what());
  }
}

void check_same_map(const std::string& path, const ReachMapHeader& header,
                    const ReachMapHeader& expected) {
  const ReachGridOptions a = header.grid.options(), b = expected.grid.options();
  const auto refuse = [&path](const std::string& what) {
    throw FileError(path, 0, "is of another map: its " + what);
  };
  if (kinematics_of(header.arm) != kinematics_of(expected.arm)) {
    refuse("arm is " + header.arm.name() + ", not " + expected.arm.name() +
           (header.arm.name() == expected.arm.name() ? " as it is described now" : ""));
  }
  if (a.resolution != b.resolution) {
    refuse("resolution is " + number(*a.resolution) + " m, not " + number(*b.resolution));
  }
  if (a.lower != b.lower || a.upper != b.upper) refuse("box is another one");
  if (a.azimuths != b.azimuths) refuse("azimuths are others");
  if (header.samples != expected.samples) {
    refuse("samples are " + std::to_string(header.samples) + ", not " +
           std::to_string(expected.samples));
  }
  if (header.grid.orientations() != expected.grid.orientations() || a.directions != b.directions ||
      a.rolls != b.rolls) {
    refuse("orientations are others");
  }
  constexpr double rounding = 1e-12;
  if (a.orientation && !a.orientation->isApprox(*b.orientation, rounding)) {
    refuse("orientation is another one");
  }
  if (digest_of(header.scene) != digest_of(expected.scene)) {
    refuse("scene is " + named(header.scene) + ", not " + named(expected.scene));
  }
  if (header.redundant_values != expected.redundant_values) {
    refuse("redundant_values are " + std::to_string(header.redundant_values) + ", not " +
           std::to_string(expected.redundant_values));
  }
}

}  // namespace beeline::internal
