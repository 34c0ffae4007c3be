// Compiled once for each instruction set (Highway's foreach_target.h), so there is no #pragma once.
#if defined(BEELINE_BATCH_INTERNAL_FRAMES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BEELINE_BATCH_INTERNAL_FRAMES_INL_H
#undef BEELINE_BATCH_INTERNAL_FRAMES_INL_H
#else
#define BEELINE_BATCH_INTERNAL_FRAMES_INL_H
#endif

#include <beeline/batch/batch.h>

#include <beeline/batch/internal/sines-inl.h>
#include <beeline/batch/internal/transpose-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {

// The passes over one packet of configurations: sines of all links, frames, poses, Jacobian
// columns. Intermediate results are rows of Packet::width numbers.

/// Stores sines and cosines of all links. Returns false if an angle exceeds
/// SineCoefficients::largest_angle or is NaN. Calls `between` once for each link.
template <class Real, class Between>
HWY_INLINE bool store_sines(const BatchPlan<Real>& plan, const Real* q, Real* sines, Real* cosines,
                            const Between& between) {
  using W = Packet<Real>;
  W squares = Real(0);
  for (const auto& link : plan.links) {
    W value = W::load(q + link.coordinate * W::width), sign;
    if (link.rotates && !link.unit_rate) value = value * W(link.theta_per_q);
    squares = fma(value, value, squares);
    const W r = reduced_angle(value, link, sign);
    store_sine_cosine(r, sign, sines, cosines);
    sines += W::width;
    cosines += W::width;
    between();
  }
  constexpr Real largest = SineCoefficients<Real>::largest_angle;
  return all_at_most(squares, largest * largest);
}

/// Recomputes the sines and cosines of large angles.
template <class Real>
HWY_NOINLINE void store_far_sines(const BatchPlan<Real>& plan, const Real* q, Real* sines,
                                  Real* cosines) {
  constexpr int width = Packet<Real>::width;
  for (const auto& link : plan.links) {
    if (link.rotates) replace_far_sines(q + link.coordinate * width, link, sines, cosines);
    sines += width;
    cosines += width;
  }
}

/// Multiplies the frame by the constant and, if `rotates`, by Rot_z.
template <class Real>
HWY_INLINE void multiply(PacketFrame<Real>& frame, const typename BatchPlan<Real>::Constant& by,
                         bool rotates, Packet<Real> cosine, Packet<Real> sine) {
  using XRotation = typename BatchPlan<Real>::XRotation;
  const Real* t = by.translation;
  if (by.translates[0]) frame.origin = fma(Packet<Real>(t[0]), frame.x, frame.origin);
  if (by.translates[1]) frame.origin = fma(Packet<Real>(t[1]), frame.y, frame.origin);
  if (by.translates[2]) frame.origin = fma(Packet<Real>(t[2]), frame.z, frame.origin);
  if (by.rotation == XRotation::minus_quarter) {
    return frame.rotate_minus_quarter_x_then_z(cosine, sine);
  }
  if (by.rotation == XRotation::other) {
    const PacketVector<Real> y = frame.y;
    const Packet<Real> c = by.cos_alpha, s = by.sin_alpha;
    frame.y = fma(s, frame.z, c * y);
    frame.z = fnma(s, y, c * frame.z);
  }
  if (rotates) frame.rotate_z(cosine, sine);
}

/// Stores the 4 x 4 matrix as 16 rows.
template <class Real>
HWY_INLINE void write_matrix(const PacketFrame<Real>& frame, Real* rows) {
  constexpr int width = Packet<Real>::width;
  const Packet<Real> zero = Real(0), one = Real(1);
  frame.x.store(rows);
  zero.store(rows + 3 * width);
  frame.y.store(rows + 4 * width);
  zero.store(rows + 7 * width);
  frame.z.store(rows + 8 * width);
  zero.store(rows + 11 * width);
  frame.origin.store(rows + 12 * width);
  one.store(rows + 15 * width);
}

/// Stores position and quaternion as 7 rows, the quaternion by its largest component (Shepperd,
/// "Quaternion from rotation matrix", 1978).
template <class Real>
HWY_INLINE void write_quaternion(const PacketFrame<Real>& frame, Real* rows) {
  using W = Packet<Real>;
  constexpr int width = W::width;
  const auto& [x, y, z, origin] = frame;
  const W one = Real(1);
  // Four times the products of the quaternion's components.
  const W up = one + z.z, down = one - z.z, sum = x.x + y.y, difference = x.x - y.y;
  const W wx = y.z - z.y, wy = z.x - x.z, wz = x.y - y.x;
  const W xy = x.y + y.x, xz = x.z + z.x, yz = y.z + z.y;
  const W other[3][4] = {
      {wx, down + difference, xy, xz}, {wy, xy, down - difference, yz}, {wz, xz, yz, up - sum}};
  W q[4] = {up + sum, wx, wy, wz};
  W largest = q[0];
  for (int i = 0; i < 3; ++i) {
    const W square = other[i][i + 1], before = largest;
    for (int k = 0; k < 4; ++k) q[k] = where_greater(square, before, other[i][k], q[k]);
    largest = max(square, before);
  }
  const W size = W(Real(0.5)) / sqrt(largest);
  const W scale = where_greater(W(Real(0)), q[0], -size, size);
  origin.store(rows);
  for (int k = 0; k < 4; ++k) (q[k] * scale).store(rows + (3 + k) * width);
}

template <class Real>
HWY_INLINE void write_pose(const PacketFrame<Real>& frame, PoseLayout layout, Real* rows) {
  if (layout == PoseLayout::matrix) {
    write_matrix(frame, rows);
  } else {
    write_quaternion(frame, rows);
  }
}

/// The frame times a constant pose.
template <class Real>
HWY_INLINE PacketFrame<Real> times(const PacketFrame<Real>& frame,
                                   const typename BatchPlan<Real>::Columns& pose) {
  const auto along = [&](const Real* v) HWY_ATTR {
    return fma(Packet<Real>(v[2]), frame.z,
               fma(Packet<Real>(v[1]), frame.y, Packet<Real>(v[0]) * frame.x));
  };
  const Real* n = pose.number;
  return {along(n), along(n + 3), along(n + 6), frame.origin + along(n + 9)};
}

/// Multiplies the frame by the link's transform. The link's theta is constant if it does not
/// rotate.
template <class Real>
HWY_INLINE void multiply(PacketFrame<Real>& frame, const typename BatchPlan<Real>::Link& link,
                         const Real* q, const Real* sine, const Real* cosine) {
  constexpr int width = Packet<Real>::width;
  if (link.rotates) {
    multiply(frame, link.constant, true, Packet<Real>::load(cosine), Packet<Real>::load(sine));
  } else {
    multiply<Real>(frame, link.constant, true, link.cos_offset, link.sin_offset);
  }
  if (link.translates) {
    const Packet<Real> d =
        Packet<Real>(link.d_per_q) * Packet<Real>::load(q + link.coordinate * width);
    frame.origin = fma(d, frame.z, frame.origin);
  }
}

template <class Real>
HWY_INLINE void multiply_by_tool(PacketFrame<Real>& frame, const BatchPlan<Real>& plan) {
  multiply<Real>(frame, plan.tool, plan.rotates_tool, plan.cos_tool, plan.sin_tool);
}

/// A column of the Jacobian.
template <class Real>
struct PacketColumn {
  PacketVector<Real> linear, angular;
};

/// Computes joint_velocity() of the link in lanes, in the frame `in`. `axes` are the link's six
/// rows: the origin of its axis and its direction.
template <class Real>
HWY_INLINE PacketColumn<Real> column(const typename BatchPlan<Real>::Link& link, Frame in,
                                     const PacketFrame<Real>& tool, const Real* axes) {
  const auto origin = PacketVector<Real>::load(axes);
  const auto direction = PacketVector<Real>::load(axes + 3 * Packet<Real>::width);
  PacketVector<Real> angular = direction;
  if (!link.unit_rate) angular = Packet<Real>(link.theta_per_q) * direction;
  PacketVector<Real> linear =
      in == Frame::space ? cross(origin, angular) : cross(angular, tool.origin - origin);
  if (link.translates) linear = fma(Packet<Real>(link.d_per_q), direction, linear);
  if (in != Frame::tool) return {linear, angular};
  return {{dot(tool.x, linear), dot(tool.y, linear), dot(tool.z, linear)},
          {dot(tool.x, angular), dot(tool.y, angular), dot(tool.z, angular)}};
}

/// Stores the Jacobian as rows, six for each coordinate.
template <class Real>
HWY_INLINE void write_columns(const BatchPlan<Real>& plan, Frame in, const PacketFrame<Real>& tool,
                              const Real* axes, Real* rows) {
  constexpr int width = Packet<Real>::width;
  std::fill(rows, rows + 6 * plan.dof * width, Real(0));
  for (const auto& link : plan.links) {
    const PacketColumn<Real> c = column(link, in, tool, axes);
    axes += 6 * width;
    Real* to = rows + 6 * link.coordinate * width;
    (c.linear + PacketVector<Real>::load(to)).store(to);
    (c.angular + PacketVector<Real>::load(to + 3 * width)).store(to + 3 * width);
  }
}

/// Stores the Jacobian as columns in the caller's layout, without intermediate rows. Requires that
/// every link has its own coordinate, in order.
template <class Real>
HWY_INLINE void store_columns(const BatchPlan<Real>& plan, Frame in, const PacketFrame<Real>& tool,
                              const Real* axes, Real* to) {
  constexpr int width = Packet<Real>::width;
  const Eigen::Index stride = Eigen::Index(6) * plan.dof;
  const auto* link = plan.links.data();
  const auto* end = link + plan.links.size();
  for (; end - link >= 2; link += 2, axes += 12 * width, to += 12) {
    const auto [v, w] = column(link[0], in, tool, axes);
    store_four(v.x, v.y, v.z, w.x, to, stride);
    const auto [v2, w2] = column(link[1], in, tool, axes + 6 * width);
    store_four(w.y, w.z, v2.x, v2.y, to + 4, stride);
    store_four(v2.z, w2.x, w2.y, w2.z, to + 8, stride);
  }
  if (link == end) return;
  const auto [v, w] = column(*link, in, tool, axes);
  store_four(v.x, v.y, v.z, w.x, to, stride);
  store_four(v.z, w.x, w.y, w.z, to + 2, stride);
}

/// Stores the 4 x 4 matrix in the caller's layout.
template <class Real>
HWY_INLINE void store_matrix(const PacketFrame<Real>& frame, Real* to, Eigen::Index stride) {
  const Packet<Real> zero = Real(0), one = Real(1);
  const auto& [x, y, z, origin] = frame;
  store_four(x.x, x.y, x.z, zero, to, stride);
  store_four(y.x, y.y, y.z, zero, to + 4, stride);
  store_four(z.x, z.y, z.z, zero, to + 8, stride);
  store_four(origin.x, origin.y, origin.z, one, to + 12, stride);
}

/// Computes sqrt(det(J J^T)) as the volume that the rows of J span (x, y and theta of a planar arm,
/// or all six): the product of their norms after modified Gram-Schmidt orthogonalisation. Unlike
/// the root of a determinant, it keeps its digits near singularities.
template <class Real>
HWY_INLINE Packet<Real> volume(int dof, bool planar, Real* rows) {
  using W = Packet<Real>;
  constexpr int width = W::width;
  const int count = planar ? 3 : 6;
  const auto at = [&](int row, int column) {
    return rows + (6 * column + (planar && row == 2 ? 5 : row)) * width;
  };
  const auto product = [&](int a, int b) HWY_ATTR {
    W sum = W::load(at(a, 0)) * W::load(at(b, 0));
    for (int k = 1; k < dof; ++k) sum = fma(W::load(at(a, k)), W::load(at(b, k)), sum);
    return sum;
  };
  W value = Real(1);
  for (int i = 0; i < count; ++i) {
    const W square = product(i, i);
    value = value * sqrt(square);
    const W inverse = W(Real(1)) / max(square, W(std::numeric_limits<Real>::min()));
    for (int j = i + 1; j < count; ++j) {
      const W projection = product(i, j) * inverse;
      for (int k = 0; k < dof; ++k) {
        fnma(projection, W::load(at(i, k)), W::load(at(j, k))).store(at(j, k));
      }
    }
  }
  return dof < count ? value * W(Real(0)) : value;
}

}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
