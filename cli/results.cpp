#include "results.h"

#include <filesystem>
#include <fmt/core.h>

#include <beeline/draw/arm_figure.h>
#include <beeline/draw/canvas.h>
#include <beeline/draw/timing_figure.h>
#include <beeline/error.h>
#include <beeline/read/file.h>
#include <beeline/record/trajectory_file.h>

using namespace beeline;

std::vector<Configuration> at_equal_times(const Trajectory& trajectory) {
  constexpr int steps = 1000;
  std::vector<Configuration> positions;
  const double begin = trajectory.times.front();
  const double duration = trajectory.times.back() - begin;
  for (int k = 0; k <= steps; ++k) {
    positions.push_back(sample(trajectory, begin + duration * k / steps));
  }
  return positions;
}

void ResultFiles::declare(CLI::App& verb) {
  verb.add_option("--out", out, "Write the joint trajectory to this file: .csv or .json");
  verb.add_option("--draw", draw, "Draw the motion to this file: .svg, .png or .pdf");
  verb.add_option("--plot", plot,
                  "Draw the joints and the tool over time, beside their limits, to this "
                  "file:\n.svg, .png or .pdf");
}

Trajectory read_recording(const std::string& path, const Arm& arm) {
  const Trajectory recorded = read_trajectory(path);
  try {
    return matched_to(arm, recorded);
  } catch (const Error& error) {
    throw FileError(path, 0, error.what());
  }
}

PoseList read_waypoints(const std::string& path, const Arm& arm, const TaskArgument& task,
                        const UnitArgument& unit) {
  PoseList list = read_poses(path, unit.angle_unit());
  for (std::size_t i = 0; i < list.poses.size(); ++i) {
    check_pose_form(arm, {list.poses[i], list.planar}, task,
                    fmt::format("{}:{}", path, list.lines[i]));
  }
  return list;
}

void print_deviation(const PathDeviation& straight, const UnitArgument& unit) {
  fmt::print("deviation     position     orientation\n");
  const auto row = [&unit](const char* label, const Deviation& deviation, const char* remark) {
    fmt::print("  {:<10}  {:.2e} m   {:.2e} {}{}\n", label, deviation.position,
               unit.shown(deviation.orientation), unit.name(), remark);
  };
  row("at samples", straight.sampled, "");
  row("measured", straight.measured, "   (between samples too)");
  row("proved", straight.bound, "   (at every moment, joints linear between samples)");
}

void add_deviation(OrderedJson& document, const std::optional<PathDeviation>& straight,
                   const UnitArgument& unit) {
  const std::pair<const char*, Deviation PathDeviation::*> kinds[] = {
      {"bound", &PathDeviation::bound},
      {"measured", &PathDeviation::measured},
      {"sampled", &PathDeviation::sampled}};
  for (const auto& [kind, member] : kinds) {
    const std::string key = std::string("deviation_") + kind;
    document[key] = straight ? json_number((*straight.*member).position) : nullptr;
  }
  for (const auto& [kind, member] : kinds) {
    const std::string key = std::string("orientation_") + kind;
    document[key] = straight ? json_number(unit.shown((*straight.*member).orientation)) : nullptr;
  }
}

namespace {

OrderedJson json_use(const LimitFraction& use) {
  if (use.joint.empty()) return nullptr;
  return {{"share", json_number(use.fraction)}, {"joint", use.joint}, {"time", use.time}};
}

void print_use(const char* what, const LimitFraction& use) {
  if (use.joint.empty()) return;
  fmt::print("{:<14}{} % of the limit at most, joint {} at {} s\n", what, shown(100 * use.fraction),
             use.joint, shown(use.time));
}

}  // namespace

void print_limits(const LimitUsage& limits) {
  print_use("velocity", limits.velocity);
  print_use("acceleration", limits.acceleration);
  print_use("jerk", limits.jerk);
}

OrderedJson json_limits(const LimitUsage& limits) {
  return {{"velocity", json_use(limits.velocity)},
          {"acceleration", json_use(limits.acceleration)},
          {"jerk", json_use(limits.jerk)}};
}

void refuse_overwriting(const std::string& output, const std::vector<std::string>& inputs) {
  for (const std::string& input : inputs) {
    std::error_code missing;
    const std::string file = input == "-" ? "/dev/stdin" : input;
    if (std::filesystem::equivalent(output, file, missing) && !missing) {
      throw Error("the output " + output + " is an input as well; choose another name");
    }
  }
}

void ResultFiles::check(const std::vector<std::string>& inputs) const {
  if (!out.empty()) trajectory_format(out);
  if (!draw.empty()) format_of(draw);
  if (!plot.empty()) format_of(plot);
  const auto apart = [](const char* options, const std::string& a, const std::string& b) {
    if (!a.empty() && a == b) throw Error(options + std::string(" name the same file: ") + a);
  };
  apart("--out and --draw", out, draw);
  apart("--out and --plot", out, plot);
  apart("--draw and --plot", draw, plot);
  for (const std::string& file : {out, draw, plot}) refuse_overwriting(file, inputs);
}

void ResultFiles::write(const Arm& arm, const Trajectory& trajectory,
                        const std::vector<Pose>& waypoints,
                        const std::optional<FollowedPath>& path) const {
  std::vector<NewFile> files;
  if (!out.empty()) files.push_back({out, trajectory_text(trajectory, trajectory_format(out))});
  if (!draw.empty()) {
    const Figure figure = motion_figure(arm, at_equal_times(trajectory), waypoints);
    files.push_back({draw, render(figure, format_of(draw))});
  }
  if (!plot.empty()) {
    const Drawing drawing = timing_figure(arm, trajectory, {.path = path});
    files.push_back({plot, render(drawing, format_of(plot))});
  }
  write_files(files);
}

void ResultFiles::print() const {
  if (!out.empty()) fmt::print("trajectory    {}\n", out);
  if (!draw.empty()) fmt::print("picture       {}\n", draw);
  if (!plot.empty()) fmt::print("plot          {}\n", plot);
}

void ResultFiles::add_to(OrderedJson& document) const {
  if (!out.empty()) document["out"] = out;
  if (!draw.empty()) document["draw"] = draw;
  if (!plot.empty()) document["plot"] = plot;
}
