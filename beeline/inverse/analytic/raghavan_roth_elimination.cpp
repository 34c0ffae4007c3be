#include <algorithm>
#include <array>

#include <beeline/inverse/analytic/raghavan_roth_elimination.h>

namespace beeline::internal {
namespace {

struct Line {
  Vector3 point;
  Vector3 direction;
};

/// The axes at q = 0 in frame 0, with lengths in units.
std::array<Line, 6> axes_at_zero(const Chain& chain, double unit) {
  std::array<Line, 6> axes;
  Pose pose = Pose::Identity();
  for (std::size_t i = 0; i < 6; ++i) {
    pose = pose * link_transform(chain.links[i], 0);
    axes[i] = {pose.translation() / unit, pose.linear().col(2)};
  }
  return axes;
}

/// The rotation by a number of quarter turns, without rounding of sine and cosine.
Pose rotation_about(const Line& axis, int quarters) {
  const Rotation h = hat(axis.direction);
  Pose pose = Pose::Identity();
  if (quarters == 1) pose.linear() += h + h * h;
  if (quarters == 2) pose.linear() += 2 * h * h;
  pose.translation() = axis.point - pose.linear() * axis.point;
  return pose;
}

Line transformed(const Pose& motion, const Line& line) {
  return {motion * line.point, motion.linear() * line.direction};
}

/// Returns the 14 numbers of a line, see Elimination.
using Features = Eigen::Matrix<double, 14, 1>;

Features features(const Line& line) {
  const Vector3 &p = line.point, &l = line.direction;
  Features f;
  f << l, p, p.dot(p), p.dot(l), p.cross(l), p.dot(p) * l - 2 * p.dot(l) * p;
  return f;
}

// From values at 0, 1 and 2 quarter turns to coefficients.
const Eigen::Matrix3d to_circle{{0.5, 0, 0.5}, {0.5, 0, -0.5}, {-0.5, 1, -0.5}};  // 1, cos, sin
const Eigen::Matrix3d to_halves{{1, 0, 0}, {-1, 2, -1}, {0, 0, 1}};               // vv, uv, uu

/// How a loop is split. index % 2 is the direction, index / 2 % 3 the first joint of the left side
/// (2, 1 or 0 in the loop's order), and index / 6 the roles of its joints.
struct Split {
  int start;        ///< position of joint a in the loop; b and c follow, then d
  const int* role;  ///< positions of hidden, first and second among a, b, c
};

Split split(int index) {
  static constexpr int roles[6][3] = {{0, 1, 2}, {1, 0, 2}, {2, 0, 1},
                                      {0, 2, 1}, {1, 2, 0}, {2, 1, 0}};
  return {2 - index / 2 % 3, roles[index / 6]};
}

/// Fills in Elimination::left by interpolation from quarter turns.
void fill_left(const std::array<Line, 6>& axes, const Split& split, Elimination& e) {
  const int s = split.start;
  Eigen::Matrix<double, 14, 27> values;
  int quarters[3];
  for (quarters[0] = 0; quarters[0] < 3; ++quarters[0]) {
    for (quarters[1] = 0; quarters[1] < 3; ++quarters[1]) {
      for (quarters[2] = 0; quarters[2] < 3; ++quarters[2]) {
        const Pose motion = rotation_about(axes[s], quarters[0]) *
                            rotation_about(axes[s + 1], quarters[1]) *
                            rotation_about(axes[s + 2], quarters[2]);
        const int column =
            9 * quarters[split.role[0]] + 3 * quarters[split.role[1]] + quarters[split.role[2]];
        values.col(column) = features(transformed(motion, axes[s + 3]));
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
}

/// Fills in Elimination::before and line.
void fill_right(const std::array<Line, 6>& axes, int start, Elimination& e) {
  for (int k = 0; k < 16; ++k) {
    const int i = std::min(k, 8) / 3, j = std::min(k, 8) % 3;
    Pose before = Pose::Identity();
    Line line = axes[start + 3];
    if (start == 0) {
      line = transformed(
          rotation_about(axes[5], i).inverse() * rotation_about(axes[4], j).inverse(), line);
    } else {
      before = rotation_about(axes[0], i).inverse();
      if (start == 1) line = transformed(rotation_about(axes[5], j).inverse(), line);
      if (start == 2) before = rotation_about(axes[1], j).inverse() * before;
    }
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) e.before[3 * a + b][k] = before.linear()(a, b);
      e.before[9 + a][k] = before.translation()[a];
      e.line[a][k] = line.point[a];
      e.line[3 + a][k] = line.direction[a];
    }
  }
}

}  // namespace

RevoluteLinks revolute_links(const Chain& chain) {
  RevoluteLinks links;
  links.unit = 0;
  for (const Chain::Link& link : chain.links) links.unit += link.translation.norm();
  if (!(links.unit > 0)) links.unit = 1;
  for (int i = 0; i < 6; ++i) {
    const Chain::Link& link = chain.links[i];
    links.cos_alpha[i] = link.cos_alpha;
    links.sin_alpha[i] = link.sin_alpha;
    for (int k = 0; k < 3; ++k) links.translation[i][k] = link.translation[k] / links.unit;
    links.theta_offset[i] = link.theta_offset;
  }
  return links;
}

Elimination make_elimination(const Chain& chain, int index) {
  const auto [start, role] = split(index);
  Elimination e;
  e.index = index;
  e.reversed = index % 2 == 1;
  const auto joint = [&](int position) { return e.reversed ? 5 - position : position; };
  e.hidden = joint(start + role[0]);
  e.first = joint(start + role[1]);
  e.second = joint(start + role[2]);
  e.last = joint(start + 3);
  e.u = joint(start == 0 ? 5 : 0);
  e.v = joint(start == 0 ? 4 : start == 1 ? 5 : 1);

  std::array<Line, 6> axes = axes_at_zero(chain, revolute_links(chain).unit);
  if (e.reversed) std::reverse(axes.begin(), axes.end());
  const Vector3 origin = (axes[start].point + axes[start + 1].point + axes[start + 2].point) / 3;
  for (Line& axis : axes) axis.point -= origin;
  Eigen::Map<Vector3>(e.origin) = origin;
  fill_left(axes, split(index), e);
  fill_right(axes, start, e);
  return e;
}

}  // namespace beeline::internal
