// Compiled once for each instruction set (Highway's foreach_target.h), so there is no #pragma once.
#if defined(BEELINE_KINEMATICS_CHAIN_ONE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BEELINE_KINEMATICS_CHAIN_ONE_INL_H
#undef BEELINE_KINEMATICS_CHAIN_ONE_INL_H
#else
#define BEELINE_KINEMATICS_CHAIN_ONE_INL_H
#endif

#include <beeline/model/internal/chain.h>

#include <beeline/simd/trigonometry-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {

/// A 3-vector of one configuration, padded by an unused fourth number. VectorOf has one vector in
/// each lane instead; the two layouts share no operation.
struct PaddedVector3 {
  using Tag = hn::CappedTag<double, 4>;
  static constexpr int width = static_cast<int>(hn::MaxLanes(Tag()));
  hn::Vec<Tag> part[4 / width];

  static HWY_INLINE PaddedVector3 load(const double* four) {
    PaddedVector3 r;
    for (int i = 0; i < 4 / width; ++i) r.part[i] = hn::LoadU(Tag(), four + i * width);
    return r;
  }
  HWY_INLINE void store(double* four) const {
    for (int i = 0; i < 4 / width; ++i) hn::StoreU(part[i], Tag(), four + i * width);
  }
  HWY_INLINE void store_three(double* three) const {
    double four[4];
    store(four);
    for (int i = 0; i < 3; ++i) three[i] = four[i];
  }
  HWY_INLINE PaddedVector3 times(double s) const {
    PaddedVector3 r;
    for (int i = 0; i < 4 / width; ++i) r.part[i] = hn::Mul(part[i], hn::Set(Tag(), s));
    return r;
  }
  /// This + s a.
  HWY_INLINE PaddedVector3 plus(double s, const PaddedVector3& a) const {
    PaddedVector3 r;
    for (int i = 0; i < 4 / width; ++i) {
      r.part[i] = hn::MulAdd(hn::Set(Tag(), s), a.part[i], part[i]);
    }
    return r;
  }
};

/// The cross product of the first three numbers; the fourth has no meaning.
HWY_INLINE PaddedVector3 cross(const PaddedVector3& a, const PaddedVector3& b) {
#if HWY_MAX_BYTES >= 32
  const PaddedVector3::Tag tag;
  alignas(32) static constexpr int64_t next_axis[4] = {1, 2, 0, 3};
  const auto rotated = [&](const PaddedVector3& v) HWY_ATTR {
    return hn::TableLookupLanes(v.part[0], hn::SetTableIndices(tag, next_axis));
  };
  // a x b = rotated(a rotated(b) - rotated(a) b)
  PaddedVector3 r;
  r.part[0] = hn::NegMulAdd(rotated(a), b.part[0], hn::Mul(a.part[0], rotated(b)));
  r.part[0] = rotated(r);
  return r;
#else
  double u[4], v[4];
  a.store(u);
  b.store(v);
  const double w[4] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                       u[0] * v[1] - u[1] * v[0], 0};
  return PaddedVector3::load(w);
#endif
}

/// A frame in the world: its axes and its origin, the columns of the 4 x 4 matrix.
struct Columns {
  PaddedVector3 x, y, z, p;

  static HWY_INLINE Columns load(const double* columns) {
    return {PaddedVector3::load(columns), PaddedVector3::load(columns + 4),
            PaddedVector3::load(columns + 8), PaddedVector3::load(columns + 12)};
  }
  HWY_INLINE void store(double* columns) const {
    x.store(columns);
    y.store(columns + 4);
    z.store(columns + 8);
    p.store(columns + 12);
  }
};

/// Multiplies the frame by L_i, given sin(theta), cos(theta) and d. Written so that only three
/// operations in sequence depend on the previous link.
HWY_INLINE Columns times_link(const Columns& before, const internal::Chain::Link& link, double s,
                              double c, double d) {
  const auto& [x, y, z, p] = before;
  const double* step = link.translation.data();
  Columns next;
  next.x = z.times(s * link.sin_alpha).plus(c, x).plus(s * link.cos_alpha, y);
  next.y = z.times(c * link.sin_alpha).plus(-s, x).plus(c * link.cos_alpha, y);
  next.z = z.times(link.cos_alpha).plus(-link.sin_alpha, y);
  next.p = p.plus(1, x.times(step[0]).plus(step[1], y).plus(step[2], z)).plus(d, next.z);
  return next;
}

/// Computes the last link's frame at one configuration: four columns of four (x, y, z, origin). The
/// fourth rows of the axes have no meaning. `angle`, `sine` and `cosine` are buffers for a multiple
/// of eight links. Writes eight numbers to `axes` for each link: the direction of its axis, and
/// from the fifth on its origin.
HWY_INLINE void last_frame_of_one(const internal::Chain& chain, const double* q, double* angle,
                                  double* sine, double* cosine, double* axes, double* frame) {
  const size_t links = chain.links.size();
  for (size_t i = 0; i < links; ++i) {
    const internal::Chain::Link& link = chain.links[i];
    angle[i] = link.theta_offset + link.theta_per_q * q[link.coordinate];
  }
  for (size_t i = 0; i < links; i += lane_count) {
    Lanes s, c;
    sine_cosine(Lanes::load(angle + i), s, c);
    s.store(sine + i);
    c.store(cosine + i);
  }
  Columns current = Columns::load(chain.base.data());
  for (size_t i = 0; i < links; ++i, axes += 8) {
    const internal::Chain::Link& link = chain.links[i];
    current = times_link(current, link, sine[i], cosine[i], link.d_per_q * q[link.coordinate]);
    current.z.store(axes);
    current.p.store(axes + 4);
  }
  current.store(frame);
}

}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
