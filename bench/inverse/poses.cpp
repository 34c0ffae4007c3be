#include "poses.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include <beeline/error.h>

namespace beeline::bench {
namespace {

using Row = std::vector<double>;

Row row_of(const ConfigurationRef& q) { return {q.begin(), q.end()}; }

Row row_of(const Pose& pose) {
  Row row;
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < 4; ++k) row.push_back(pose.matrix()(i, k));
  }
  return row;
}

template <class Items>
void write_rows(const std::filesystem::path& path, const Items& items) {
  std::ofstream out(path, std::ios::binary);
  for (const auto& item : items) {
    const Row row = row_of(item);
    out.write(reinterpret_cast<const char*>(row.data()),
              static_cast<std::streamsize>(row.size() * sizeof(double)));
  }
  if (!out.flush()) throw Error("cannot write " + path.string());
}

}  // namespace

// The standard library's distributions differ between systems; the engine does not.
double uniform(Engine& engine, double lower, double upper) {
  return lower + (upper - lower) * std::ldexp(static_cast<double>(engine() >> 11), -53);
}

Configuration random_configuration(const Screws& screws, Engine& engine) {
  Configuration q(screws.joints);
  for (int i = 0; i < screws.joints; ++i) {
    const auto k = static_cast<std::size_t>(i);
    q[i] = i < screws.free ? uniform(engine, screws.lower[k], screws.upper[k]) : screws.last;
  }
  return q;
}

Poses random_poses(const Screws& screws, int count, std::uint64_t seed) {
  constexpr double reach_of_tracking = 0.1;
  Engine engine(seed);
  Poses poses;
  for (int n = 0; n < count; ++n) {
    const Configuration q = random_configuration(screws, engine);
    Configuration near = q;
    for (int i = 0; i < screws.free; ++i) {
      const auto k = static_cast<std::size_t>(i);
      near[i] += uniform(engine, -reach_of_tracking, reach_of_tracking);
      near[i] = std::clamp(near[i], screws.lower[k], screws.upper[k]);
    }
    poses.q.push_back(q);
    poses.near.push_back(near);
    poses.world_T_tool.push_back(forward(screws, q));
  }
  return poses;
}

Configuration middle(const Screws& screws) {
  Configuration q(screws.joints);
  for (int i = 0; i < screws.joints; ++i) {
    const auto k = static_cast<std::size_t>(i);
    q[i] = i < screws.free ? (screws.lower[k] + screws.upper[k]) / 2 : screws.last;
  }
  return q;
}

void write_poses(const std::filesystem::path& folder, const BenchArm& arm, const Screws& screws,
                 const Poses& poses) {
  std::filesystem::create_directories(folder);
  nlohmann::json joints = nlohmann::json::array();
  for (std::size_t i = 0; i < static_cast<std::size_t>(screws.joints); ++i) {
    joints.push_back({{"slides", screws.slides[i]},
                      {"axis", row_of(screws.axis[i])},
                      {"point", row_of(screws.point[i])},
                      {"lower", screws.lower[i]},
                      {"upper", screws.upper[i]}});
  }
  nlohmann::json description{{"name", arm.name}, {"joints", joints}, {"home", row_of(screws.home)}};
  if (arm.last) description["last"] = *arm.last;
  std::ofstream out(folder / "arm.json");
  out << description.dump(1) << '\n';
  if (!out.flush()) throw Error("cannot write " + (folder / "arm.json").string());
  write_rows(folder / "pose.f64", poses.world_T_tool);
  write_rows(folder / "q.f64", poses.q);
  write_rows(folder / "near.f64", poses.near);
}

}  // namespace beeline::bench
