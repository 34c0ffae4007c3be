// Compiled once for each instruction set (Highway's foreach_target.h), so there is no #pragma once.
#if defined(BEELINE_BATCH_PASSES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BEELINE_BATCH_PASSES_INL_H
#undef BEELINE_BATCH_PASSES_INL_H
#else
#define BEELINE_BATCH_PASSES_INL_H
#endif

#include <beeline/batch/plan.h>

#include <beeline/batch/sines-inl.h>
#include <beeline/batch/transpose-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {

// What is done to one register's configurations, a pass after the other. Rows are of Wide's width.

/// Sines and cosines of a few links; adds their angles' squares.
template <int count, class Real>
HWY_INLINE void take_some_sines(const typename BatchPlan<Real>::Link* link, const Real* q,
                                Real* sines, Real* cosines, Wide<Real>& squares) {
  using W = Wide<Real>;
  W r[count], sign[count];
  for (int i = 0; i < count; ++i) {
    W value = W::load(q + link[i].coordinate * W::width);
    if (link[i].turns && !link[i].plain) value = value * W(link[i].turn);
    squares = fma(value, value, squares);
    r[i] = without_half_turns(value, link[i], sign[i]);
  }
  sines_to_rows<count>(r, sign, sines, cosines);
}

/// All links' sines and cosines; false where an angle is too large for that, or is no number.
/// `between` is called for each link.
template <class Real, class Between>
HWY_INLINE bool take_sines(const BatchPlan<Real>& plan, const Real* q, Real* sines, Real* cosines,
                           const Between& between) {
  constexpr int width = Wide<Real>::width;
  constexpr int some = HWY_MAX_BYTES >= 64 ? 4 : 2;  // as many as there are registers for
  const int links = static_cast<int>(plan.links.size());
  const auto* link = plan.links.data();
  Wide<Real> squares = Real(0);
  int i = 0;
  for (; i + some <= links; i += some, sines += some * width, cosines += some * width) {
    take_some_sines<some>(link + i, q, sines, cosines, squares);
    for (int k = 0; k < some; ++k) between();
  }
  // The rest together: each group loads the numbers of the polynomials again.
  switch (links - i) {
    case 3:
      take_some_sines<3>(link + i, q, sines, cosines, squares);
      break;
    case 2:
      take_some_sines<2>(link + i, q, sines, cosines, squares);
      break;
    case 1:
      take_some_sines<1>(link + i, q, sines, cosines, squares);
  }
  for (; i < links; ++i) between();
  constexpr Real reach = SineNumbers<Real>::reach;
  return all_at_most(squares, reach * reach);
}

/// The far ones again.
template <class Real>
HWY_NOINLINE void take_far_sines(const BatchPlan<Real>& plan, const Real* q, Real* sines,
                                 Real* cosines) {
  constexpr int width = Wide<Real>::width;
  for (const auto& link : plan.links) {
    if (link.turns) sine_cosine_far(q + link.coordinate * width, link, sines, cosines);
    sines += width;
    cosines += width;
  }
}

/// Along the step, bent about x and turned about z.
template <class Real>
HWY_INLINE void move(WideFrame<Real>& frame, const typename BatchPlan<Real>::Move& by, bool turns,
                     Wide<Real> cosine, Wide<Real> sine) {
  using Bend = typename BatchPlan<Real>::Bend;
  if (by.steps[0]) frame.origin = fma(Wide<Real>(by.step[0]), frame.x, frame.origin);
  if (by.steps[1]) frame.origin = fma(Wide<Real>(by.step[1]), frame.y, frame.origin);
  if (by.steps[2]) frame.origin = fma(Wide<Real>(by.step[2]), frame.z, frame.origin);
  if (by.bend == Bend::quarter) return frame.bend_and_turn_z(cosine, sine);
  if (by.bend == Bend::other) {
    const Triple<Real> y = frame.y;
    const Wide<Real> c = by.cos_alpha, s = by.sin_alpha;
    frame.y = fma(s, frame.z, c * y);
    frame.z = fnma(s, y, c * frame.z);
  }
  if (turns) frame.turn_z(cosine, sine);
}

/// The numbers of a frame, as rows.
template <class Real>
HWY_INLINE void write_matrix(const WideFrame<Real>& frame, Real* rows) {
  constexpr int width = Wide<Real>::width;
  const Wide<Real> none = Real(0), one = Real(1);
  frame.x.store(rows);
  none.store(rows + 3 * width);
  frame.y.store(rows + 4 * width);
  none.store(rows + 7 * width);
  frame.z.store(rows + 8 * width);
  none.store(rows + 11 * width);
  frame.origin.store(rows + 12 * width);
  one.store(rows + 15 * width);
}

/// Position and quaternion: of the four ways to it that which divides by the largest (Shepperd,
/// "Quaternion from rotation matrix", 1978).
template <class Real>
HWY_INLINE void write_quaternion(const WideFrame<Real>& frame, Real* rows) {
  using W = Wide<Real>;
  constexpr int width = W::width;
  const auto& [x, y, z, origin] = frame;
  const W one = Real(1);
  // Four times the products of the quaternion's numbers.
  const W up = one + z.z, down = one - z.z, sum = x.x + y.y, rest = x.x - y.y;
  const W wx = y.z - z.y, wy = z.x - x.z, wz = x.y - y.x;
  const W xy = x.y + y.x, xz = x.z + z.x, yz = y.z + z.y;
  const W other[3][4] = {
      {wx, down + rest, xy, xz}, {wy, xy, down - rest, yz}, {wz, xz, yz, up - sum}};
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
HWY_INLINE void write_pose(const WideFrame<Real>& frame, PoseLayout layout, Real* rows) {
  if (layout == PoseLayout::matrix) {
    write_matrix(frame, rows);
  } else {
    write_quaternion(frame, rows);
  }
}

/// The frame times a constant pose.
template <class Real>
HWY_INLINE WideFrame<Real> times(const WideFrame<Real>& frame,
                                 const typename BatchPlan<Real>::Columns& pose) {
  const auto along = [&](const Real* v) HWY_ATTR {
    return fma(Wide<Real>(v[2]), frame.z,
               fma(Wide<Real>(v[1]), frame.y, Wide<Real>(v[0]) * frame.x));
  };
  const Real* n = pose.number;
  return {along(n), along(n + 3), along(n + 6), frame.origin + along(n + 9)};
}

/// One link more. The turn of a slide is constant.
template <class Real>
HWY_INLINE void follow(WideFrame<Real>& frame, const typename BatchPlan<Real>::Link& link,
                       const Real* q, const Real* sine, const Real* cosine) {
  constexpr int width = Wide<Real>::width;
  if (link.turns) {
    move(frame, link.move, true, Wide<Real>::load(cosine), Wide<Real>::load(sine));
  } else {
    move<Real>(frame, link.move, true, link.cos_angle, link.sin_angle);
  }
  if (link.slides) {
    const Wide<Real> way = Wide<Real>(link.travel) * Wide<Real>::load(q + link.coordinate * width);
    frame.origin = fma(way, frame.z, frame.origin);
  }
}

template <class Real>
HWY_INLINE void move_to_tool(WideFrame<Real>& frame, const BatchPlan<Real>& plan) {
  move<Real>(frame, plan.tool, plan.turns_tool, plan.cos_tool, plan.sin_tool);
}

/// A column of the Jacobian.
template <class Real>
struct WideColumn {
  Triple<Real> linear, angular;
};

/// What a unit of its coordinate's speed does through this link, of whose six rows in `axes` three
/// are its place and three its direction.
template <class Real>
HWY_INLINE WideColumn<Real> column(const typename BatchPlan<Real>::Link& link, Frame in,
                                   const WideFrame<Real>& tool, const Real* axes) {
  const auto place = Triple<Real>::load(axes);
  const auto direction = Triple<Real>::load(axes + 3 * Wide<Real>::width);
  Triple<Real> angular = direction;
  if (!link.plain) angular = Wide<Real>(link.turn) * direction;
  Triple<Real> linear =
      in == Frame::space ? cross(place, angular) : cross(angular, tool.origin - place);
  if (link.slides) linear = fma(Wide<Real>(link.travel), direction, linear);
  if (in != Frame::tool) return {linear, angular};
  return {{dot(tool.x, linear), dot(tool.y, linear), dot(tool.z, linear)},
          {dot(tool.x, angular), dot(tool.y, angular), dot(tool.z, angular)}};
}

/// All of them as rows, six for each coordinate.
template <class Real>
HWY_INLINE void write_columns(const BatchPlan<Real>& plan, Frame in, const WideFrame<Real>& tool,
                              const Real* axes, Real* rows) {
  constexpr int width = Wide<Real>::width;
  std::fill(rows, rows + 6 * plan.dof * width, Real(0));
  for (const auto& link : plan.links) {
    const WideColumn<Real> c = column(link, in, tool, axes);
    axes += 6 * width;
    Real* to = rows + 6 * link.coordinate * width;
    (c.linear + Triple<Real>::load(to)).store(to);
    (c.angular + Triple<Real>::load(to + 3 * width)).store(to + 3 * width);
  }
}

/// All of them to where they go, without rows between. Requires that each link has its own
/// coordinate, in order.
template <class Real>
HWY_INLINE void store_columns(const BatchPlan<Real>& plan, Frame in, const WideFrame<Real>& tool,
                              const Real* axes, Real* to) {
  constexpr int width = Wide<Real>::width;
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

/// The tool's matrix likewise.
template <class Real>
HWY_INLINE void store_matrix(const WideFrame<Real>& frame, Real* to, Eigen::Index stride) {
  const Wide<Real> none = Real(0), one = Real(1);
  const auto& [x, y, z, origin] = frame;
  store_eight({x.x, x.y, x.z, none, y.x, y.y, y.z, none}, to, stride);
  store_eight({z.x, z.y, z.z, none, origin.x, origin.y, origin.z, one}, to + 8, stride);
}

/// sqrt(det(J J^T)): the volume of J's six rows, each without its part along those before it
/// (modified Gram-Schmidt). Unlike det(J J^T), whose rounding is under the root, that is exact to
/// rounding near singularities.
template <class Real>
HWY_INLINE Wide<Real> volume(int dof, Real* rows) {
  using W = Wide<Real>;
  constexpr int width = W::width;
  const auto at = [&](int row, int column) { return rows + (6 * column + row) * width; };
  const auto product = [&](int a, int b) HWY_ATTR {
    W sum = W::load(at(a, 0)) * W::load(at(b, 0));
    for (int k = 1; k < dof; ++k) sum = fma(W::load(at(a, k)), W::load(at(b, k)), sum);
    return sum;
  };
  W value = Real(1);
  for (int i = 0; i < 6; ++i) {
    const W square = product(i, i);
    value = value * sqrt(square);
    const W inverse = W(Real(1)) / max(square, W(std::numeric_limits<Real>::min()));
    for (int j = i + 1; j < 6; ++j) {
      const W share = product(i, j) * inverse;
      for (int k = 0; k < dof; ++k) {
        fnma(share, W::load(at(i, k)), W::load(at(j, k))).store(at(j, k));
      }
    }
  }
  return dof < 6 ? value * W(Real(0)) : value;
}

}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
