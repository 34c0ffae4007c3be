#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <beeline/certificate/internal/path_checks.h>
#include <beeline/certificate/internal/tool_error.h>
#include <beeline/kinematics/internal/mask.h>
#include <beeline/pose/so3.h>

namespace beeline::internal {
namespace {

using Eigen::Matrix3d;

template <class A, class B>
auto product(const Jet<A>& a, const Jet<B>& b) {
  using Result = Eigen::Matrix<double, A::RowsAtCompileTime, B::ColsAtCompileTime>;
  return Jet<Result>{a.value * b.value, a.first * b.value + a.value * b.first,
                     a.second * b.value + 2 * a.first * b.first + a.value * b.second};
}

Jet<Matrix3d> transposed(const Jet<Matrix3d>& m) {
  return {m.value.transpose(), m.first.transpose(), m.second.transpose()};
}

Jet<Matrix3d> rotation(const PoseMotion& motion) {
  const Matrix3d r = motion.pose.linear(), w = hat(motion.velocity.tail<3>());
  return {r, w * r, (hat(motion.acceleration.tail<3>()) + w * w) * r};
}

/// The Bernstein coefficients of the quintic with these values and derivatives at 0 and 1.
template <class Value>
std::array<Value, 6> bernstein(const Jet<Value>& a, const Jet<Value>& b) {
  return {a.value,
          a.value + a.first / 5,
          a.value + 2 * a.first / 5 + a.second / 20,
          b.value - 2 * b.first / 5 + b.second / 20,
          b.value - b.first / 5,
          b.value};
}

template <class Jet, class Function>
Jet each(const Jet& jet, const Function& function) {
  return {function(jet.value), function(jet.first), function(jet.second)};
}

bool planar_rotation(const Arm& arm, const Segment& segment, const Task& task) {
  return task.frame == Frame::base && task.rows[5] && all_rotate_about_z(arm, segment);
}

}  // namespace

ToolErrorRows::ToolErrorRows(const Arm& arm, const Segment& segment, const Task& task)
    : task_(task) {
  rotating_rows_ = task.frame == Frame::tool && task.positions() % 3 != 0;
  const int orientations = task.orientations();
  if (orientations == 3 || (orientations > 0 && planar_rotation(arm, segment, task))) {
    orientation_ = Orientation::whole;
  } else if (orientations > 0) {
    orientation_ = orientations == 2 ? Orientation::axis : Orientation::rotation_row;
    for (int i = 0; i < 3; ++i) {
      if (task.rows[static_cast<std::size_t>(3 + i)] == (orientations == 1)) row_ = i;
    }
  }
  const auto* line = std::get_if<Line>(&segment);
  if (line == nullptr) return;
  line_ = extent_of(*line, task);
  if (line_->by_position() && !rotating_rows_) direction_ = line_->translation / line_->length;
}

ToolError ToolErrorRows::at(const PoseMotion& tool, const PoseMotion& path) const {
  ToolError error;
  const Jet<Matrix3d> r = rotation(tool), p = rotation(path);
  if (task_.positions() > 0) {
    Jet<Vector3> distance{tool.pose.translation() - path.pose.translation(),
                          (tool.velocity - path.velocity).head<3>(),
                          (tool.acceleration - path.acceleration).head<3>()};
    if (rotating_rows_) distance = product(transposed(r), distance);
    error.position =
        each(distance, [&](const Vector3& v) -> Vector3 { return masked_position(task_, v); });
    if (task_.positions() == 3) error.position = distance;
  }
  const Jet<Matrix3d> difference{r.value - p.value, r.first - p.first, r.second - p.second};
  const bool tool_axes = task_.frame == Frame::tool;
  switch (orientation_) {
    case Orientation::none:
      break;
    case Orientation::whole:
      error.orientation = difference;
      break;
    case Orientation::axis:
      error.orientation = each(difference, [&](const Matrix3d& m) {
        Matrix3d kept = Matrix3d::Zero();
        kept.col(0) = tool_axes ? Vector3(m.col(row_)) : Vector3(m.row(row_));
        return kept;
      });
      break;
    case Orientation::rotation_row:
      error.orientation = each(tool_axes ? product(transposed(r), p) : product(p, transposed(r)),
                               [&](const Matrix3d& m) {
                                 Matrix3d kept = Matrix3d::Zero();
                                 const int j = (row_ + 1) % 3, k = (row_ + 2) % 3;
                                 kept(0, 0) = (m(k, j) - m(j, k)) / 2;
                                 return kept;
                               });
      break;
  }
  return error;
}

Deviation ToolErrorRows::remainder(const TaylorBound& distance, const TaylorBound& tool,
                                   const TaylorBound& path, double factor) const {
  constexpr std::size_t sixth = 6;
  Deviation result;
  if (task_.positions() > 0) {
    result.position = factor * (rotating_rows_ ? (tool * distance).c[sixth] : distance.c[sixth]);
  }
  if (orientation_ == Orientation::rotation_row) {
    result.orientation = factor * (tool * path).c[sixth];
  } else if (orientation_ != Orientation::none) {
    result.orientation = factor * (tool.c[sixth] + path.c[sixth]);
  }
  return result;
}

/// `chord` bounds |R - P| / sqrt(2) in the Frobenius norm, |R e - P e|, or the row of the
/// antisymmetric part.
double ToolErrorRows::orientation_bound(double chord, double angle) const {
  switch (orientation_) {
    case Orientation::none:
      return 0;
    case Orientation::whole:
      return chord < 2 ? 2 * std::asin(chord / 2) : std::numbers::pi;
    case Orientation::axis: {
      // The rotation vector's part across e is |R e - P e| f / (2 sin(f / 2)), where f is the whole
      // angle.
      const double half = std::min(angle, std::numbers::pi) / 2;
      return std::min(std::numbers::pi, half > 0 ? chord * half / std::sin(half) : chord);
    }
    case Orientation::rotation_row:
      // The row of the rotation vector is the row of the antisymmetric part times f / sin f.
      if (!(angle < std::numbers::pi)) return std::numbers::pi;
      return std::min(std::numbers::pi, angle > 0 ? chord * angle / std::sin(angle) : chord);
  }
  return std::numbers::pi;
}

/// Adds the difference between the pose at s(u) and at the parameter of the nearest point to the
/// bound of the deviation from the pose at s(u). `along` bounds the error along a line by
/// position.
Deviation ToolErrorRows::at_nearest(const Deviation& at_s, double along, const Range& range) const {
  Deviation result = at_s;
  const bool whole = orientation_ == Orientation::whole;
  if (line_->by_position()) {
    // The nearest parameter is s(u) + along / length if that is in [0, 1].
    double shift = along;
    if (rotating_rows_) {
      shift = 2 * at_s.position < range.row_length
                  ? 2 * at_s.position / range.row_length * line_->length
                  : line_->length;
    } else {
      const double room = std::min(range.s_min, 1 - range.s_max) * line_->length;
      result.position = std::hypot(at_s.position, std::max(0.0, along - room));
    }
    const double fraction = std::min(1.0, shift / line_->length);
    result.orientation += (whole ? 1 : std::numbers::pi / 2) * line_->angle * fraction;
  } else if (line_->by_rotation() && task_.positions() > 0) {
    result.position +=
        line_->length * (whole ? std::min(1.0, 2 * at_s.orientation / line_->angle) : 1);
  }
  return result;
}

Deviation ToolErrorRows::bound(const ToolError& a, const ToolError& b, const Deviation& remainder,
                               const Range& range) const {
  double across = 0, along = 0;
  for (const Vector3& v : bernstein(a.position, b.position)) {
    const double component = v.dot(direction_);
    across = std::max(across, (v - component * direction_).norm());
    along = std::max(along, std::abs(component));
  }
  double chord = 0;
  for (const Matrix3d& m : bernstein(a.orientation, b.orientation)) {
    chord =
        std::max(chord, m.norm() / (orientation_ == Orientation::whole ? std::numbers::sqrt2 : 1));
  }
  Deviation at_s{across + remainder.position,
                 orientation_bound(chord + remainder.orientation, range.angle)};
  if (line_) at_s = at_nearest(at_s, along + remainder.position, range);
  if (orientation_ == Orientation::none) at_s.orientation = 0;
  return {at_s.position, std::min(at_s.orientation, std::numbers::pi)};
}

double ToolErrorRows::along_tolerance(const Deviation& tolerance) const {
  if (!projects()) return Limits::none;
  const double rotation = line_->angle / line_->length;  // radians per metre
  return rotation > 0 ? std::min(tolerance.position, tolerance.orientation / rotation)
                      : tolerance.position;
}

LineProjection ToolErrorRows::projection(const Polynomial& s, const ToolError& a,
                                         const ToolError& b, double error) const {
  const double length = line_->length;
  const auto along = [&](const Vector3& v) { return v.dot(direction_) / length; };
  const Jet<Vector3>&p = a.position, &q = b.position;
  LineProjection projection{quintic_between(along(p.value), along(q.value), along(p.first),
                                            along(q.first), along(p.second), along(q.second)),
                            error / length};
  for (std::size_t k = 0; k < Polynomial::terms; ++k) projection.s.c[k] += s.c[k];
  return projection;
}

}  // namespace beeline::internal
