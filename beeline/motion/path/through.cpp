#include <array>
#include <cmath>

#include <beeline/error.h>
#include <beeline/motion/path/spline.h>
#include <beeline/motion/path/through.h>

namespace beeline {
namespace {

constexpr std::array<std::string_view, 4> kinds{"line", "screw", "arc", "spline"};

}  // namespace

std::string name(PathKind kind) { return std::string(kinds[static_cast<std::size_t>(kind)]); }

PathKind path_kind_named(std::string_view name) {
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    if (name == kinds[i]) return static_cast<PathKind>(i);
  }
  throw unknown_name("path", name, {kinds.begin(), kinds.end()});
}

double span_of(const Line& line) {
  const Twist whole = pose_difference(line.to, line.from);
  return std::max(whole.head<3>().norm(), way_of_a_radian * whole.tail<3>().norm());
}

std::vector<Pose> checked_path(std::span<const Pose> given) {
  constexpr double rounding = 1e-6, nothing = 1e-12;
  if (given.size() < 2) throw Error("a path needs at least two poses");
  std::vector<Pose> poses(given.begin(), given.end());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const std::string what = "pose " + std::to_string(i + 1) + " of the path ";
    const Rotation r = poses[i].linear();
    if (!poses[i].matrix().allFinite() || !(r * r.transpose()).isIdentity(rounding) ||
        r.determinant() < 0) {
      throw Error(what +
                  "is no rigid motion: its numbers must be finite, its rotation orthonormal "
                  "and right-handed");
    }
    poses[i].linear() = Eigen::Quaterniond(r).normalized().toRotationMatrix();
    if (i > 0 && pose_difference(poses[i], poses[i - 1]).norm() <= nothing) {
      throw Error(what + "is the same as the one before it");
    }
  }
  return poses;
}

ToolPath path_through(std::span<const Pose> given, PathKind kind, const SplineEnds& ends) {
  const std::vector<Pose> poses = checked_path(given);
  if (kind == PathKind::spline) return spline_through(poses, ends);
  const std::size_t step = kind == PathKind::arc ? 2 : 1;
  if ((poses.size() - 1) % step != 0) {
    throw Error(
        "arcs need an odd number of poses: one to begin at, and for each arc one whose "
        "position it passes and one to end at");
  }
  ToolPath path;
  for (std::size_t i = 0; i + step < poses.size(); i += step) {
    const Pose &from = poses[i], &to = poses[i + step];
    if (kind == PathKind::line) path.pieces.emplace_back(Line{from, to});
    if (kind == PathKind::screw) path.pieces.emplace_back(ScrewLine{from, to});
    if (kind == PathKind::arc) {
      path.pieces.emplace_back(arc_through(from, poses[i + 1].translation(), to));
    }
    path.spans.push_back(std::max(length_of(path.pieces.back()), span_of({from, to})));
  }
  return path;
}

}  // namespace beeline
