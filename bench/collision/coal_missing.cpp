// In place of coal_scene.cpp where the wheel of coal is not installed.
#include <limits>

#include "coal_scene.h"

namespace beeline::bench {

struct CoalScene::Bodies {};

bool has_coal() { return false; }

CoalScene::CoalScene(const Arm&, const std::vector<LinkShapes>&, const Scene&) {}
CoalScene::~CoalScene() = default;

bool CoalScene::collides(const Configuration&, double) { return false; }

CoalDistance CoalScene::least_distance(const Configuration&) {
  return {std::numeric_limits<double>::quiet_NaN(), {}};
}

double coal_distance(const Shape&, const Shape&) {
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace beeline::bench
