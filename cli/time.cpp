#include <algorithm>
#include <fmt/core.h>

#include <beeline/error.h>
#include <beeline/read/csv.h>
#include <beeline/read/file.h>
#include <beeline/read/name.h>
#include <beeline/timing/retime.h>

#include "results.h"
#include "verb.h"

using namespace beeline;

namespace {

struct Arguments {
  std::string path;
  ArmArgument arm;
  std::string law;
  RetimeOptions options;
  std::optional<double> tool_speed, rate;
  ResultFiles files;
  bool json = false;
};

/// A recording or, where a .csv file has no column t, a path: its samples count the seconds, which
/// are not asked for.
struct Way {
  Trajectory trajectory;
  bool has_times = true;
};

Trajectory counted(const CsvTable& table) {
  Trajectory path{table.columns, {}, {}, {}, {}};
  for (const std::vector<double>& row : table.rows) {
    path.times.push_back(static_cast<double>(path.times.size()));
    path.positions.push_back(
        Eigen::Map<const Configuration>(row.data(), static_cast<Eigen::Index>(row.size())));
  }
  return path;
}

Way read_way(const std::string& path, const Arm& arm) {
  Way way;
  if (extension(path) == "csv") {
    const CsvTable table = parse_csv(read_file(path), path);
    const auto& columns = table.columns;
    way.has_times = std::find(columns.begin(), columns.end(), "t") != columns.end();
    if (!way.has_times) way.trajectory = counted(table);
  }
  if (way.has_times) way.trajectory = read_recording(path, arm);
  try {
    way.trajectory = matched_to(arm, way.trajectory);
    check_moves(way.trajectory);
  } catch (const Error& error) {
    throw FileError(path, 0, error.what());
  }
  return way;
}

Exit time_path(const Arguments& arguments) {
  arguments.files.check({arguments.arm.text, arguments.path});
  RetimeOptions options = arguments.options;
  if (!arguments.law.empty()) options.profile = profile_named(arguments.law);
  if (arguments.rate) {
    options.rate = *arguments.rate;
    if (!(options.rate > 0)) throw Error("--rate must be above zero, not " + number(options.rate));
  }
  if (arguments.tool_speed) options.tool_speed = *arguments.tool_speed;
  const Arm arm = arguments.arm.read();
  const Way way = read_way(arguments.path, arm);
  const std::vector<double>& before = way.trajectory.times;
  const Retimed timed = retime(arm, way.trajectory, options);
  const bool found = timed.found();
  if (found) arguments.files.write(arm, timed.trajectory, {});
  const double duration = found ? timed.trajectory.times.back() : 0;
  const double duration_before = before.back() - before.front();
  if (arguments.json) {
    OrderedJson document{
        {"status", found ? "reached" : "outside_limits"},
        {"law", name(timed.profile)},
        {"samples", timed.trajectory.size()},
        {"duration", found ? OrderedJson(duration) : OrderedJson(nullptr)},
        {"duration_before", way.has_times ? OrderedJson(duration_before) : OrderedJson(nullptr)},
        {"stretches", timed.stretches},
        {"limits", json_limits(timed.limits)},
        {"tool_speed", json_number(timed.tool_speed)},
        {"reason", timed.reason}};
    if (found) arguments.files.add_to(document);
    print_json(document);
  } else if (found) {
    fmt::print("timed         {} samples of {} by law {}\n", timed.trajectory.size(), arm.name(),
               name(timed.profile));
    fmt::print("duration      {} s", shown(duration));
    if (way.has_times) fmt::print(", before {} s", shown(duration_before));
    fmt::print("{}\n", timed.stretches > 1
                           ? fmt::format(", with {} stops on the way", timed.stretches - 1)
                           : "");
    print_limits(timed.limits);
    fmt::print("tool speed    {} m/s at most\n", shown(timed.tool_speed));
    arguments.files.print();
  }
  if (!found) fmt::print(stderr, "beeline: {}\n", timed.reason);
  return found ? Exit::yes : Exit::no;
}

}  // namespace

Run declare_time(CLI::App& verb) {
  static Arguments arguments;
  verb.add_option("FILE", arguments.path,
                  "A trajectory or a path: .csv (column t may be missing) or .json")
      ->required();
  arguments.arm.declare(verb);
  verb.add_option("--law", arguments.law,
                  "fastest (jerk free), jerk, or one law for the whole way: trapezoidal (jerk "
                  "free),\nquintic, s-curve (default: jerk for an arm with limits of jerk, else "
                  "fastest)");
  verb.add_option("--speed-limit", arguments.options.speed_limit,
                  "Share of the velocity limits; accelerations go with its square, jerks its cube")
      ->capture_default_str();
  verb.add_option("--tool-speed", arguments.tool_speed, "The tool's largest speed, m/s");
  verb.add_option("--rate", arguments.rate,
                  "Samples a second (default: every sample of the file, and more between)");
  arguments.files.declare(verb);
  verb.add_flag("--json", arguments.json, "Print JSON");
  verb.footer(
      "Gives the way of a recording new times, from rest to rest: as quick as the limits allow,\n"
      "along the cubic spline through its samples. Where it stood still it stands still again.\n"
      "The file's values are radians and metres. Unknown velocity limits count as 1 rad/s, 1 m/s.\n"
      "Examples:\n"
      "  beeline time move.csv panda --out quick.csv\n"
      "  beeline time waypoints.csv panda --law fastest --tool-speed 0.5 --rate 100 --out m.csv");
  return [] { return time_path(arguments); };
}
