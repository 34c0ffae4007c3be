// Compiled once for each instruction set (Highway's foreach_target.h), so there is no #pragma once.
#if defined(BEELINE_KINEMATICS_CHAIN_ONE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BEELINE_KINEMATICS_CHAIN_ONE_INL_H
#undef BEELINE_KINEMATICS_CHAIN_ONE_INL_H
#else
#define BEELINE_KINEMATICS_CHAIN_ONE_INL_H
#endif

#include <beeline/model/chain.h>

#include <beeline/simd/trigonometry-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {

/// Four numbers of one configuration: a vector, and one to spare.
struct Four {
  using Tag = hn::CappedTag<double, 4>;
  static constexpr int width = static_cast<int>(hn::MaxLanes(Tag()));
  hn::Vec<Tag> part[4 / width];

  static HWY_INLINE Four load(const double* four) {
    Four r;
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
  HWY_INLINE Four times(double s) const {
    Four r;
    for (int i = 0; i < 4 / width; ++i) r.part[i] = hn::Mul(part[i], hn::Set(Tag(), s));
    return r;
  }
  /// This and s a.
  HWY_INLINE Four plus(double s, const Four& a) const {
    Four r;
    for (int i = 0; i < 4 / width; ++i) {
      r.part[i] = hn::MulAdd(hn::Set(Tag(), s), a.part[i], part[i]);
    }
    return r;
  }
};

/// The cross product of the first three numbers; the fourth is of no meaning.
HWY_INLINE Four cross(const Four& a, const Four& b) {
#if HWY_MAX_BYTES >= 32
  const Four::Tag tag;
  alignas(32) static constexpr int64_t onward[4] = {1, 2, 0, 3};
  const auto turned = [&](const Four& v) HWY_ATTR {
    return hn::TableLookupLanes(v.part[0], hn::SetTableIndices(tag, onward));
  };
  // a x b = turned(a turned(b) - turned(a) b)
  Four r;
  r.part[0] = hn::NegMulAdd(turned(a), b.part[0], hn::Mul(a.part[0], turned(b)));
  r.part[0] = turned(r);
  return r;
#else
  double u[4], v[4];
  a.store(u);
  b.store(v);
  const double w[4] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                       u[0] * v[1] - u[1] * v[0], 0};
  return Four::load(w);
#endif
}

/// A frame in the world: its axes and its origin. The fourth numbers make it a matrix.
struct Columns {
  Four x, y, z, p;

  static HWY_INLINE Columns load(const double* columns) {
    return {Four::load(columns), Four::load(columns + 4), Four::load(columns + 8),
            Four::load(columns + 12)};
  }
  HWY_INLINE void store(double* columns) const {
    x.store(columns);
    y.store(columns + 4);
    z.store(columns + 8);
    p.store(columns + 12);
  }
};

/// The frame behind one link more, at this sine and cosine of its angle and this way of its slide.
/// What waits for the link before is kept short: three operations in a row.
HWY_INLINE Columns behind(const Columns& before, const Chain::Link& link, double s, double c,
                          double slide) {
  const auto& [x, y, z, p] = before;
  const double* step = link.translation.data();
  Columns next;
  next.x = z.times(s * link.sin_alpha).plus(c, x).plus(s * link.cos_alpha, y);
  next.y = z.times(c * link.sin_alpha).plus(-s, x).plus(c * link.cos_alpha, y);
  next.z = z.times(link.cos_alpha).plus(-link.sin_alpha, y);
  next.p = p.plus(1, x.times(step[0]).plus(step[1], y).plus(step[2], z)).plus(slide, next.z);
  return next;
}

/// The last link's frame at one configuration: four columns of four (x, y, z, origin), the fourth
/// rows of no meaning. `angle`, `sine` and `cosine` have room for a multiple of eight links.
/// `axes` gets eight numbers for each link: its joint's direction, and from the fifth on its
/// origin.
HWY_INLINE void last_frame_of_one(const Chain& chain, const double* q, double* angle, double* sine,
                                  double* cosine, double* axes, double* frame) {
  const size_t links = chain.links.size();
  for (size_t i = 0; i < links; ++i) {
    const Chain::Link& link = chain.links[i];
    angle[i] = link.theta_offset + link.theta_per_q * q[link.coordinate];
  }
  for (size_t i = 0; i < links; i += lane_count) {
    Lanes s, c;
    sine_cosine(Lanes::load(angle + i), s, c);
    s.store(sine + i);
    c.store(cosine + i);
  }
  Columns at = Columns::load(chain.base.data());
  for (size_t i = 0; i < links; ++i, axes += 8) {
    const Chain::Link& link = chain.links[i];
    at = behind(at, link, sine[i], cosine[i], link.d_per_q * q[link.coordinate]);
    at.z.store(axes);
    at.p.store(axes + 4);
  }
  at.store(frame);
}

}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
