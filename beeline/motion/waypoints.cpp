#include <string>

#include <beeline/error.h>
#include <beeline/motion/waypoints.h>

namespace beeline {

std::vector<Pose> checked_waypoints(std::span<const Pose> waypoints) {
  constexpr double rounding = 1e-6;
  constexpr double farthest = 1e100;  // beyond, squares overflow
  if (waypoints.empty()) throw Error("a line needs at least one waypoint");
  std::vector<Pose> checked(waypoints.begin(), waypoints.end());
  for (std::size_t w = 0; w < checked.size(); ++w) {
    const std::string what = "waypoint " + std::to_string(w + 1);
    const Rotation r = checked[w].linear();
    if (!checked[w].matrix().allFinite()) {
      throw Error(what + " has a number that is not finite");
    }
    if (checked[w].translation().cwiseAbs().maxCoeff() > farthest) {
      throw Error(what + " is farther away than 1e100 m");
    }
    if (!(r * r.transpose()).isIdentity(rounding) || r.determinant() < 0) {
      throw Error(what + " is no rigid motion: its rotation must be orthonormal and right-handed");
    }
    checked[w].linear() = Eigen::Quaterniond(r).normalized().toRotationMatrix();
  }
  return checked;
}

}  // namespace beeline
