// Compiled once for each instruction set (Highway's foreach_target.h), so there is no #pragma once.
#if defined(BEELINE_KINEMATICS_HALF_PRODUCTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BEELINE_KINEMATICS_HALF_PRODUCTS_INL_H
#undef BEELINE_KINEMATICS_HALF_PRODUCTS_INL_H
#else
#define BEELINE_KINEMATICS_HALF_PRODUCTS_INL_H
#endif

#include <beeline/kinematics/chain_one-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {

/// Maps a vector from the frame to the world, by its rotation.
HWY_INLINE PaddedVector3 rotated(const Columns& frame, const double* v) {
  return frame.x.times(v[0]).plus(v[1], frame.y).plus(v[2], frame.z);
}

/// Maps a point from the frame to the world.
HWY_INLINE PaddedVector3 transformed(const Columns& frame, const double* v) {
  return frame.p.plus(1, rotated(frame, v));
}

/// The frame times a pose, whose four columns are `stride` numbers apart.
HWY_INLINE Columns times(const Columns& frame, const double* pose, int stride = 4) {
  return {rotated(frame, pose), rotated(frame, pose + stride), rotated(frame, pose + 2 * stride),
          transformed(frame, pose + 3 * stride)};
}

/// The products of the link transforms of two halves of a chain, computed together: every column
/// has four numbers of the first half, then four of the second.
struct HalfProducts {
  Lanes x, y, z, p;

  /// `first` in the four lanes of the first half, `second` in the others.
  static HWY_INLINE Lanes each(double first, double second) {
    Lanes r;
    constexpr int width = lane_count / register_count;
    for (int i = 0; i < register_count; ++i) {
      r.part[i] = hn::Set(RegisterTag(), i * width < 4 ? first : second);
      if (width > 4) {
        r.part[i] =
            hn::IfThenElse(hn::FirstN(RegisterTag(), 4), r.part[i], hn::Set(RegisterTag(), second));
      }
    }
    return r;
  }

  static HWY_INLINE Lanes both(const PaddedVector3& first, const PaddedVector3& second) {
    Lanes r;
#if HWY_MAX_BYTES >= 64
    r.part[0] = hn::Combine(RegisterTag(), second.part[0], first.part[0]);
#else
    constexpr int parts = register_count / 2;
    for (int i = 0; i < parts; ++i) r.part[i] = first.part[i], r.part[parts + i] = second.part[i];
#endif
    return r;
  }

  /// The first half starts at the frame, the second at the identity.
  static HWY_INLINE HalfProducts starting_with(const Columns& frame) {
    alignas(64) static constexpr double identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    return {both(frame.x, PaddedVector3::load(identity)),
            both(frame.y, PaddedVector3::load(identity + 4)),
            both(frame.z, PaddedVector3::load(identity + 8)),
            both(frame.p, PaddedVector3::load(identity + 12))};
  }

  /// Multiplies the first half by the transform of link a and the second by the transform of link
  /// b.
  HWY_INLINE void append(const internal::Chain::Link& a, double sine_a, double cosine_a, double d_a,
                         const internal::Chain::Link& b, double sine_b, double cosine_b,
                         double d_b) {
    const double *step = a.translation.data(), *other = b.translation.data();
    const Lanes s = each(sine_a, sine_b), c = each(cosine_a, cosine_b);
    const Lanes sa = each(a.sin_alpha, b.sin_alpha), ca = each(a.cos_alpha, b.cos_alpha);
    const Lanes sx = each(step[0], other[0]), sy = each(step[1], other[1]),
                sz = each(step[2], other[2]);
    p = p + fma(x, sx, fma(y, sy, z * sz));
    const Lanes x_before = x, y_before = y;
    x = fma(s * ca, y, fma(c, x, (s * sa) * z));
    y = fma(c * ca, y, fnma(s, x_before, (c * sa) * z));
    z = fnma(sa, y_before, ca * z);
    p = fma(each(d_a, d_b), z, p);
  }

  HWY_INLINE Columns first() const { return {first_of(x), first_of(y), first_of(z), first_of(p)}; }

  /// The product of both halves.
  HWY_INLINE Columns product() const {
    double all[4 * lane_count];
    x.store(all);
    y.store(all + lane_count);
    z.store(all + 2 * lane_count);
    p.store(all + 3 * lane_count);
    return times(first(), all + 4, lane_count);
  }

 private:
  static HWY_INLINE PaddedVector3 first_of(const Lanes& both) {
    PaddedVector3 r;
#if HWY_MAX_BYTES >= 64
    r.part[0] = hn::LowerHalf(both.part[0]);
#else
    for (int i = 0; i < register_count / 2; ++i) r.part[i] = both.part[i];
#endif
    return r;
  }
};

}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
