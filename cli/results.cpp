#include "results.h"

#include <fmt/core.h>

#include <beeline/draw/arm_figure.h>
#include <beeline/draw/canvas.h>
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
}

void ResultFiles::check_formats() const {
  if (!out.empty()) trajectory_format(out);
  if (!draw.empty()) format_of(draw);
}

void ResultFiles::write(const Arm& arm, const Trajectory& trajectory,
                        const std::vector<Pose>& waypoints) const {
  std::string picture;
  if (!draw.empty()) {
    picture = render(motion_figure(arm, at_equal_times(trajectory), waypoints), format_of(draw));
  }
  if (!out.empty()) write_trajectory(out, trajectory);
  if (!draw.empty()) write_file(draw, picture);
}

void ResultFiles::print() const {
  if (!out.empty()) fmt::print("trajectory    {}\n", out);
  if (!draw.empty()) fmt::print("picture       {}\n", draw);
}

void ResultFiles::add_to(OrderedJson& document) const {
  if (!out.empty()) document["out"] = out;
  if (!draw.empty()) document["draw"] = draw;
}
