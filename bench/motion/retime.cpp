// Usage: bench_retime < cases > answers
//
// Beeline's time-optimal scaling for retime.py, which compares it with TOPP-RA. Both streams are
// doubles in native byte order. A case is the numbers of joints, waypoints and grid
// points; the limits of velocity and of acceleration; the waypoints' parameters and the waypoints;
// the grid points' parameters (none: Beeline's own grid). The answer: the duration, the largest
// fraction of a limit on a ten times denser grid, the number of grid points and the shortest time
// of the scaling alone, microseconds.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <vector>

#include <beeline/path/joint_path.h>
#include <beeline/timing/time_scaling.h>

#include <tests/path/random_joint_path.h>

using namespace beeline;

namespace {

bool read(double* values, std::size_t count) {
  return std::fread(values, sizeof(double), count, stdin) == count;
}

Configuration read_one(Eigen::Index joints) {
  Configuration values(joints);
  read(values.data(), static_cast<std::size_t>(joints));
  return values;
}

std::vector<double> read_many(double count) {
  std::vector<double> values(static_cast<std::size_t>(count));
  read(values.data(), values.size());
  return values;
}

/// Returns the path at other grid points, which include its ends.
JointPath at_grid(const JointPath& path, const std::vector<double>& grid) {
  JointPath on_grid;
  std::size_t k = 0;
  for (const double s : grid) {
    while (k + 2 < path.size() && s >= path.s[k + 1]) ++k;
    const PathPoint point = path_point(path, k, (s - path.s[k]) / (path.s[k + 1] - path.s[k]));
    on_grid.s.push_back(s);
    on_grid.q.push_back(point.q);
    on_grid.dq.push_back(point.dq);
    on_grid.ddq.push_back(point.ddq);
  }
  return on_grid;
}

double best_microseconds(const JointPath& path, const PathLimits& limits) {
  double best = 1e9;
  for (int pass = 0; pass < 15; ++pass) {
    const auto begin = std::chrono::steady_clock::now();
    const TimeScaling scaling = time_scaling(path, limits, Profile::fastest);
    const std::chrono::duration<double, std::micro> passed =
        std::chrono::steady_clock::now() - begin;
    best = std::min(best, passed.count() + 0 * scaling.duration());
  }
  return best;
}

}  // namespace

int main() {
  double head[3];
  while (read(head, 3)) {
    const auto joints = static_cast<Eigen::Index>(head[0]);
    PathLimits limits;
    limits.velocity = read_one(joints);
    limits.acceleration = read_one(joints);
    limits.jerk = Configuration::Constant(joints, Limits::none);
    const std::vector<double> parameter = read_many(head[1]);
    std::vector<Configuration> waypoints;
    for (std::size_t k = 0; k < parameter.size(); ++k) waypoints.push_back(read_one(joints));
    const JointPath spline = joint_spline(waypoints, parameter);
    const std::vector<double> grid = read_many(head[2]);
    const JointPath path = grid.empty() ? refined(spline) : at_grid(spline, grid);
    const TimeScaling scaling = time_scaling(path, limits, Profile::fastest);
    const double answer[] = {
        scaling ? scaling.duration() : -1,
        scaling ? beeline::testing::largest_fraction(path, limits, scaling) : -1,
        static_cast<double>(path.size()), best_microseconds(path, limits)};
    std::fwrite(answer, sizeof(double), 4, stdout);
    std::fflush(stdout);
  }
}
