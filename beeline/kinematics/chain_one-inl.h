// Compiled once for each instruction set (Highway's foreach_target.h), so there is no #pragma once.
#if defined(BEELINE_KINEMATICS_CHAIN_ONE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BEELINE_KINEMATICS_CHAIN_ONE_INL_H
#undef BEELINE_KINEMATICS_CHAIN_ONE_INL_H
#else
#define BEELINE_KINEMATICS_CHAIN_ONE_INL_H
#endif

#include <beeline/kinematics/chain.h>

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

/// The last link's frame at one configuration: four columns of four (x, y, z, origin), the fourth
/// rows of no meaning. `angle`, `sine` and `cosine` have room for a multiple of eight links.
/// `axes` gets eight numbers for each link: its joint's direction, and from the fifth on its
/// origin.
HWY_INLINE void last_frame_of_one(const Chain& chain, const double* q, double* angle, double* sine,
                                  double* cosine, double* axes, double* frame) {
  const size_t links = chain.links.size();
  for (size_t i = 0; i < links; ++i) {
    const Chain::Link& link = chain.links[i];
    angle[i] = link.rest_angle + link.turn * q[link.coordinate];
  }
  for (size_t i = 0; i < links; i += lane_count) {
    Lanes s, c;
    sine_cosine(Lanes::load(angle + i), s, c);
    s.store(sine + i);
    c.store(cosine + i);
  }
  const double* base = chain.base.data();
  Four x = Four::load(base), y = Four::load(base + 4), z = Four::load(base + 8),
       p = Four::load(base + 12);
  for (size_t i = 0; i < links; ++i, axes += 8) {
    const Chain::Link& link = chain.links[i];
    const double* step = link.step.data();
    const double s = sine[i], c = cosine[i];
    // What waits for the link before is kept short: three operations in a row.
    p = p.plus(1, x.times(step[0]).plus(step[1], y).plus(step[2], z));
    const Four x_before = x, y_before = y;
    x = z.times(s * link.sin_alpha).plus(c, x).plus(s * link.cos_alpha, y);
    y = z.times(c * link.sin_alpha).plus(-s, x_before).plus(c * link.cos_alpha, y);
    z = z.times(link.cos_alpha).plus(-link.sin_alpha, y_before);
    p = p.plus(link.travel * q[link.coordinate], z);
    z.store(axes);
    p.store(axes + 4);
  }
  x.store(frame);
  y.store(frame + 4);
  z.store(frame + 8);
  p.store(frame + 12);
}

}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
