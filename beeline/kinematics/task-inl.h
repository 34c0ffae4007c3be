// Compiled once for each instruction set (Highway's foreach_target.h), so there is no #pragma once.
#if defined(BEELINE_KINEMATICS_TASK_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BEELINE_KINEMATICS_TASK_INL_H
#undef BEELINE_KINEMATICS_TASK_INL_H
#else
#define BEELINE_KINEMATICS_TASK_INL_H
#endif

#include <beeline/kinematics/task.h>

#include <beeline/kinematics/chain-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {

HWY_INLINE Vector choose(LaneMask which, const Vector& yes, const Vector& no) {
  return {choose(which, yes.x, no.x), choose(which, yes.y, no.y), choose(which, yes.z, no.z)};
}

/// so3_log() of the rotation matrix with these rows, in lanes: accurate near zero and near pi. The
/// result is arbitrary in lanes that are not in the mask `wanted`.
HWY_INLINE Vector rotation_log(const Vector& r0, const Vector& r1, const Vector& r2,
                               unsigned wanted) {
  const Lanes trace = r0.x + r1.y + r2.z;
  const Vector twice{r2.y - r1.z, r0.z - r2.x, r1.x - r0.y};
  const Vector v = Lanes(0.5) * twice;  // the axis, of length sin(angle)
  const Lanes u = dot(v, v);
  // asin(s) / s in powers of s^2 for s < 1/4: the omitted terms are below 1e-14.
  const LaneMask small = (u < Lanes(0.0625)) & (trace > Lanes(1));
  Lanes p = fma(u, Lanes(12155.0 / 1245184), Lanes(6435.0 / 557056));
  p = fma(u, p, Lanes(143.0 / 10240));
  p = fma(u, p, Lanes(231.0 / 13312));
  p = fma(u, p, Lanes(63.0 / 2816));
  p = fma(u, p, Lanes(35.0 / 1152));
  p = fma(u, p, Lanes(5.0 / 112));
  p = fma(u, p, Lanes(3.0 / 40));
  p = fma(u, p, Lanes(1.0 / 6));
  const Vector near = fma(u * p, v, v);
  if ((bits(small) & wanted) == wanted) return near;

  // The quaternion by its largest component, times four times that component (Shepperd,
  // "Quaternion from rotation matrix", 1978).
  const Lanes one(1);
  const Vector sums{r2.y + r1.z, r0.z + r2.x, r1.x + r0.y};
  const LaneMask by_x = (r0.x >= r1.y) & (r0.x >= r2.z);
  const LaneMask by_y = r1.y >= r2.z;
  const LaneMask by_w = trace > Lanes(0);
  const Lanes one_less_trace = one - trace;
  Vector axis = choose(by_y, Vector{sums.z, fma(r1.y, Lanes(2), one_less_trace), sums.x},
                       Vector{sums.y, sums.x, fma(r2.z, Lanes(2), one_less_trace)});
  axis = choose(by_x, Vector{fma(r0.x, Lanes(2), one_less_trace), sums.z, sums.y}, axis);
  axis = choose(by_w, twice, axis);
  Lanes w = choose(by_x, twice.x, choose(by_y, twice.y, twice.z));
  w = choose(by_w, one + trace, w);
  const Lanes length = sqrt(dot(axis, axis));
  const Lanes per_length = Lanes(2) / length;
  const Lanes angle = with_sign(arc_tangent(length, abs(w)), w);
  return choose(small, near, (angle * per_length) * axis);
}

/// A task with fewer than six rows at eight configurations, in its own axes. The Newton step makes
/// its rows of the error zero. The other rows stay, and enter the derivatives of the former.
struct PartialTask {
  bool tool_axes = false, partial_position = false, partial_orientation = false;
  LanePose tool;
  Motion error;          ///< all six rows
  Lanes squared_factor;  ///< of [r]^2 in the inverse left Jacobian of SO(3), r = error.angular
  Lanes weight[6];       ///< 1 for the task's rows, 0 for the others
};

HWY_INLINE Motion weighted(const Lanes (&weight)[6], const Motion& a) {
  return {{a.linear.x * weight[0], a.linear.y * weight[1], a.linear.z * weight[2]},
          {a.angular.x * weight[3], a.angular.y * weight[4], a.angular.z * weight[5]}};
}

/// `world_T_tool` is the tool's pose, `error` in the world's axes.
HWY_INLINE PartialTask partial_task(const Task& task, const LanePose& world_T_tool,
                                    const Motion& error) {
  const auto& rows = task.rows;
  PartialTask part;
  part.tool_axes = task.frame == Frame::tool;
  part.partial_position = !(rows[0] && rows[1] && rows[2]);
  part.partial_orientation = !(rows[3] && rows[4] && rows[5]);
  part.tool = world_T_tool;
  for (int i = 0; i < 6; ++i) part.weight[i] = Lanes(rows[static_cast<size_t>(i)] ? 1 : 0);
  part.error = error;
  if (part.tool_axes) {
    part.error = {in_axes(part.tool, error.linear), in_axes(part.tool, error.angular)};
  }
  // (1 - t/2 cot(t/2)) / t^2, as in so3_left_jacobian_inverse(). Below 1e-2 the quotient cancels.
  const Lanes square = dot(part.error.angular, part.error.angular);
  const Lanes half = Lanes(0.5) * sqrt(square);
  Lanes sine, cosine;
  sine_cosine(half, sine, cosine);
  const LaneMask small = square < Lanes(1e-4);
  const Lanes quotient =
      (Lanes(1) - half * cosine / choose(small, Lanes(1), sine)) / choose(small, Lanes(1), square);
  part.squared_factor = choose(small, fma(square, Lanes(1.0 / 720), Lanes(1.0 / 12)), quotient);
  return part;
}

/// The derivative of the task's error, negated, for a velocity of the tool in the world's axes.
HWY_INLINE Motion in_task(const PartialTask& part, Motion column) {
  const Vector& r = part.error.angular;
  if (part.tool_axes) {
    column = {in_axes(part.tool, column.linear), in_axes(part.tool, column.angular)};
    if (part.partial_position) {
      column.linear = column.linear - cross(part.error.linear, column.angular);
    }
  }
  if (part.partial_orientation) {  // the logarithm's derivative; in the tool's axes its transpose
    const Vector product = cross(r, column.angular);
    const Lanes half(part.tool_axes ? -0.5 : 0.5);
    column.angular =
        fma(part.squared_factor, cross(r, product), fma(half, product, column.angular));
  }
  return weighted(part.weight, column);
}

}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
