#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include <beeline/inverse/analytic/six_loop.h>

namespace beeline {
namespace {

constexpr double special = 1e-10;  // sine of an angle, or distance over size

bool parallel(const JointAxis& a, const JointAxis& b) {
  return a.direction.cross(b.direction).norm() < special;
}

/// The point where two axes meet, unless they are parallel or pass each other.
std::optional<Vector3> meeting_point(const JointAxis& a, const JointAxis& b, double size) {
  const Vector3 normal = a.direction.cross(b.direction);
  const double sine = normal.norm();
  constexpr double flat = 1e-3;  // the point would be known too badly
  if (sine < flat) return std::nullopt;
  const Vector3 way = b.point - a.point;
  if (std::abs(way.dot(normal)) > special * size * sine) return std::nullopt;
  const double along = way.cross(b.direction).dot(normal) / (sine * sine);
  return a.point + along * a.direction;
}

/// Where three axes meet that are linked one to the next.
std::optional<Vector3> meeting_point(const JointAxis& a, const JointAxis& b, const JointAxis& c,
                                     double size) {
  const auto one = meeting_point(a, b, size), other = meeting_point(b, c, size);
  if (!one || !other || (*one - *other).norm() > special * size) return std::nullopt;
  return one;
}

double size_of(const std::vector<JointAxis>& axes, const Pose& tool) {
  double size = tool.translation().norm();
  for (std::size_t i = 1; i < axes.size(); ++i) size += (axes[i].point - axes[i - 1].point).norm();
  return size > 0 ? size : 1;
}

/// Whether lambda_1 v_1 + lambda_2 v_2 = 0 has a solution for two vectors of the plane, of which
/// the second is a length; it prefers the second equation, where both vectors vanish.
bool dependent(const Eigen::Vector2d& v1, const Eigen::Vector2d& v2, double size, double* weight,
               int& other) {
  if (v1.norm() < special) {
    weight[0] = 1, weight[1] = 0, other = 1;
    return true;
  }
  if (std::abs(v1[0] * v2[1] - v1[1] * v2[0]) > special * size * v1.norm()) return false;
  weight[0] = -v1.dot(v2) / v1.squaredNorm(), weight[1] = 1, other = 0;
  return true;
}

/// The same for a slide, which is in the first equation by the factor `along` (never, where only
/// directions count), and by its square in the second.
bool dependent(const SixLoop& loop, double along, double* weight, int& other) {
  weight[0] = 1, weight[1] = 0, other = 1;
  return loop.family == SixLoop::Family::parallel || std::abs(along) < special;
}

/// Finds what makes one of the two equations free of an unknown, whatever the goal.
void decouple(SixLoop& loop) {
  const auto matrix = [](const Rigid& k) {
    return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(&k.rotation[0][0]);
  };
  const auto vector = [](const Rigid& k) { return Eigen::Map<const Vector3>(k.translation); };
  if (loop.family == SixLoop::Family::parallel && (loop.slides[0] || loop.slides[2])) {
    loop.weight[0] = 1, loop.weight[1] = 0, loop.second = 1;  // the angle between axes, which stays
    loop.first = loop.slides[0] ? SixLoop::First::w : SixLoop::First::u;
    return;
  }
  if (loop.goal_place != 1) {  // K_e is the arm's: axis e against axis d
    const Vector3 z = matrix(loop.before[1]).col(2), t = vector(loop.before[1]);
    if (loop.slides[0]
            ? dependent(loop, z.z(), loop.weight, loop.second)
            : dependent(-z.head<2>(), t.head<2>(), loop.size, loop.weight, loop.second)) {
      loop.first = SixLoop::First::w;
      return;
    }
  }
  if (loop.goal_place != 2) {  // K_f is the arm's: axis f against axis e
    const Vector3 z = matrix(loop.before[2]).row(2);
    const Vector3 m = matrix(loop.before[2]).transpose() * vector(loop.before[2]);
    if (loop.slides[2] ? dependent(loop, z.z(), loop.weight, loop.second)
                       : dependent(z.head<2>(), m.head<2>(), loop.size, loop.weight, loop.second)) {
      loop.first = SixLoop::First::u;
    }
  }
}

/// The loop cut before joint `d`, whose fourth to sixth joints are a, b, c.
SixLoop cut(const Chain& chain, SixLoop::Family family, int d, double size) {
  SixLoop loop;
  loop.family = family;
  loop.size = size;
  loop.tool = rigid(chain.tool);
  loop.base = rigid(chain.base);
  for (int i = 0; i < 6; ++i) {
    const int joint = (d + i) % 6;
    const std::size_t k = static_cast<std::size_t>(i);
    const Chain::Link& link = chain.links[joint];
    const bool slides = link.theta_per_q == 0;
    loop.order[k] = joint;
    Pose before = constant_transform(link);
    if (slides) before = before * Eigen::AngleAxisd(link.theta_offset, Vector3::UnitZ());
    // The goal takes the place of what is before joint 1: there its angle goes into the base.
    if (slides && joint == 0) {
      loop.base = rigid(chain.base * Eigen::AngleAxisd(link.theta_offset, Vector3::UnitZ()));
    }
    loop.before[k] = rigid(before);
    loop.sign[k] = slides ? link.d_per_q : link.theta_per_q;
    loop.rest[k] = slides ? 0 : link.theta_offset;
    if (i < 3) loop.slides[k] = slides;
    if (joint == 0) loop.goal_place = i;
    if (i < 4) continue;
    loop.sin_alpha[i - 4] = link.sin_alpha;
    loop.cos_alpha[i - 4] = link.cos_alpha;
    loop.height += link.translation.z();
  }
  decouple(loop);
  return loop;
}

/// Less is better: two equations that need no polynomial, then constants that are the arm's alone.
int effort(const SixLoop& loop) {
  const bool wraps = loop.goal_place == 1 || loop.goal_place == 2;
  return (loop.first == SixLoop::First::neither ? 2 : 0) + (wraps ? 1 : 0);
}

/// A loop with slides needs the polynomial of one of them only, which a turn's equation closes.
bool solvable(const SixLoop& loop) {
  if (loop.slides[1]) return false;
  if (loop.first != SixLoop::First::neither) return true;
  return !(loop.slides[0] && loop.slides[2]);
}

}  // namespace

Rigid rigid(const Pose& pose) {
  Rigid plain{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) plain.rotation[i][j] = pose(i, j);
    plain.translation[i] = pose(i, 3);
  }
  return plain;
}

std::optional<SixLoop> six_loop(const Chain& chain) {
  const std::vector<JointAxis> axes = axes_of(chain);
  const double size = size_of(axes, chain.tool);
  std::optional<SixLoop> best;
  const auto consider = [&best](const SixLoop& loop) {
    if (solvable(loop) && (!best || effort(loop) < effort(*best))) best = loop;
  };
  for (std::size_t a = 0; a < 4; ++a) {
    const auto turns = [&chain](std::size_t i) { return chain.links[i].theta_per_q != 0; };
    if (!turns(a) || !turns(a + 1) || !turns(a + 2)) continue;
    std::vector<JointAxis> placed = axes;
    const int d = static_cast<int>(a + 3) % 6;
    if (const auto point = meeting_point(axes[a], axes[a + 1], axes[a + 2], size)) {
      for (std::size_t i = a; i < a + 3; ++i) placed[i].point = *point;
      consider(cut(chain_through(chain, placed), SixLoop::Family::meeting, d, size));
    }
    if (parallel(axes[a], axes[a + 1]) && parallel(axes[a + 1], axes[a + 2])) {
      for (std::size_t i = a + 1; i < a + 3; ++i) {
        if (placed[i].direction.dot(placed[a].direction) < 0) placed[i].direction *= -1;
      }
      consider(cut(chain_through(chain, placed), SixLoop::Family::parallel, d, size));
    }
  }
  return best;
}

std::string description(const SixLoop& loop, int missing) {
  const auto number = [&](std::size_t i) {
    const int k = loop.order[i];
    return std::to_string(missing >= 0 && k >= missing ? k + 2 : k + 1);
  };
  return std::string(loop.family == SixLoop::Family::meeting ? "three axes meet"
                                                             : "three parallel axes") +
         " (joints " + number(3) + ", " + number(4) + ", " + number(5) + ")";
}

}  // namespace beeline
