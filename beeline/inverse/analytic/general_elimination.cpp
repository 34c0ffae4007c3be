#include <algorithm>

#include <beeline/inverse/analytic/general_elimination.h>

namespace beeline {
namespace {

struct Line {
  Vector3 point;
  Vector3 direction;
};

/// The axes at q = 0 in the frame of joint 1, lengths in units.
std::array<Line, 6> axes_at_rest(const Chain& chain, double unit) {
  std::array<Line, 6> axes;
  Pose pose = Pose::Identity();
  for (std::size_t i = 0; i < 6; ++i) {
    pose = pose * link_transform(chain.links[i], 0);
    axes[i] = {pose.translation() / unit, pose.linear().col(2)};
  }
  return axes;
}

/// Quarter turns, exactly.
Pose turn_about(const Line& axis, int quarters) {
  const Rotation h = hat(axis.direction);
  Pose pose = Pose::Identity();
  if (quarters == 1) pose.linear() += h + h * h;
  if (quarters == 2) pose.linear() += 2 * h * h;
  pose.translation() = axis.point - pose.linear() * axis.point;
  return pose;
}

Line moved(const Pose& motion, const Line& line) {
  return {motion * line.point, motion.linear() * line.direction};
}

using Features = Eigen::Matrix<double, 14, 1>;

Features features(const Line& line) {
  const Vector3 &p = line.point, &l = line.direction;
  Features f;
  f << l, p, p.dot(p), p.dot(l), p.cross(l), p.dot(p) * l - 2 * p.dot(l) * p;
  return f;
}

// From values at 0, 1 and 2 quarter turns to coefficients of ...
const Eigen::Matrix3d to_circle{{0.5, 0, 0.5}, {0.5, 0, -0.5}, {-0.5, 1, -0.5}};  // 1, cos, sin
const Eigen::Matrix3d to_halves{{1, 0, 0}, {-1, 2, -1}, {0, 0, 1}};               // vv, uv, uu

}  // namespace

SixLinks six_links(const Chain& chain) {
  SixLinks six;
  six.unit = 0;
  for (const Chain::Link& link : chain.links) six.unit += link.translation.norm();
  if (!(six.unit > 0)) six.unit = 1;
  for (std::size_t i = 0; i < 6; ++i) {
    const Chain::Link& link = chain.links[i];
    six.cos_alpha[i] = link.cos_alpha;
    six.sin_alpha[i] = link.sin_alpha;
    for (int k = 0; k < 3; ++k) six.step[i][k] = link.translation[k] / six.unit;
    six.rest[i] = link.theta_offset;
  }
  return six;
}

GeneralElimination general_elimination(const Chain& chain, int which) {
  const int start = 2 - which / 2 % 3;  // of the three joints on the left, in the loop's order
  constexpr int roles[6][3] = {{0, 1, 2}, {1, 0, 2}, {2, 0, 1}, {0, 2, 1}, {1, 2, 0}, {2, 1, 0}};
  const int* role = roles[which / 6];
  GeneralElimination e;
  e.reversed = which % 2 == 1;
  const auto joint = [&](int position) { return e.reversed ? 5 - position : position; };
  e.hidden = joint(start + role[0]);
  e.first = joint(start + role[1]);
  e.second = joint(start + role[2]);
  e.last = joint(start + 3);

  std::array<Line, 6> axes = axes_at_rest(chain, six_links(chain).unit);
  if (e.reversed) std::reverse(axes.begin(), axes.end());
  const auto s = static_cast<std::size_t>(start);
  const Vector3 origin = (axes[s].point + axes[s + 1].point + axes[s + 2].point) / 3;
  for (Line& axis : axes) axis.point -= origin;
  Eigen::Map<Vector3>(e.origin) = origin;

  Eigen::Matrix<double, 14, 27> values;
  int turns[3];
  for (turns[0] = 0; turns[0] < 3; ++turns[0]) {
    for (turns[1] = 0; turns[1] < 3; ++turns[1]) {
      for (turns[2] = 0; turns[2] < 3; ++turns[2]) {
        const Pose motion = turn_about(axes[s], turns[0]) * turn_about(axes[s + 1], turns[1]) *
                            turn_about(axes[s + 2], turns[2]);
        values.col(9 * turns[role[0]] + 3 * turns[role[1]] + turns[role[2]]) =
            features(moved(motion, axes[s + 3]));
      }
    }
  }
  for (int column = 0; column < 27; ++column) {
    Features sum = Features::Zero();
    for (int value = 0; value < 27; ++value) {
      sum += to_circle(column / 9, value / 9) * to_halves(column / 3 % 3, value / 3 % 3) *
             to_halves(column % 3, value % 3) * values.col(value);
    }
    for (int row = 0; row < 14; ++row) e.left[row][column] = sum[row];
  }

  e.u = joint(start == 0 ? 5 : 0);
  e.v = joint(start == 0 ? 4 : start == 1 ? 5 : 1);
  for (int k = 0; k < 16; ++k) {
    const int i = std::min(k, 8) / 3, j = std::min(k, 8) % 3;
    Pose before = Pose::Identity();
    Line line = axes[s + 3];
    if (start == 0) {
      line = moved(turn_about(axes[5], i).inverse() * turn_about(axes[4], j).inverse(), line);
    } else {
      before = turn_about(axes[0], i).inverse();
      if (start == 1) line = moved(turn_about(axes[5], j).inverse(), line);
      if (start == 2) before = turn_about(axes[1], j).inverse() * before;
    }
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) e.before[3 * a + b][k] = before.linear()(a, b);
      e.before[9 + a][k] = before.translation()[a];
      e.line[a][k] = line.point[a];
      e.line[3 + a][k] = line.direction[a];
    }
  }
  return e;
}

}  // namespace beeline
