// Compiled once for each instruction set (Highway's foreach_target.h), so there is no #pragma once.
#if defined(BEELINE_KINEMATICS_CHAIN_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BEELINE_KINEMATICS_CHAIN_INL_H
#undef BEELINE_KINEMATICS_CHAIN_INL_H
#else
#define BEELINE_KINEMATICS_CHAIN_INL_H
#endif

#include <beeline/model/internal/chain.h>

#include <beeline/simd/geometry-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {

/// Maps vectors from the frame's axes to the world's, and back.
HWY_INLINE Vector from_axes(const LanePose& frame, const Vector& v) {
  return fma(v.x, frame.x, fma(v.y, frame.y, v.z * frame.z));
}
HWY_INLINE Vector in_axes(const LanePose& frame, const Vector& v) {
  return {dot(frame.x, v), dot(frame.y, v), dot(frame.z, v)};
}

/// Calls `visit` with the frame of each link in the world at eight configurations, from the first
/// link on, and returns the last. q has a row of eight values for each coordinate.
template <class Visit>
HWY_INLINE LanePose frames_along(const internal::Chain& chain, const double* q, Visit&& visit) {
  const double* base = chain.base.data();  // four columns of four
  LanePose frame{{base[0], base[1], base[2]},
                 {base[4], base[5], base[6]},
                 {base[8], base[9], base[10]},
                 {base[12], base[13], base[14]}};
  for (const internal::Chain::Link& link : chain.links) {
    const double* step = link.translation.data();
    const Lanes coordinate = Lanes::load(q + lane_count * link.coordinate);
    CosSine theta;
    sine_cosine(fma(coordinate, Lanes(link.theta_per_q), Lanes(link.theta_offset)), theta.s,
                theta.c);
    frame.origin = fma(Lanes(step[0]), frame.x, frame.origin);
    frame.origin = fma(Lanes(step[1]), frame.y, frame.origin);
    frame.origin = fma(Lanes(step[2]), frame.z, frame.origin);
    frame = rotated_x(frame, Lanes(link.cos_alpha), Lanes(link.sin_alpha));
    frame = translated_z(rotated_z(frame, theta), coordinate * Lanes(link.d_per_q));
    visit(frame);
  }
  return frame;
}

/// Returns the last link's frame in the world at eight configurations. q has a row of eight values
/// for each coordinate. Writes six rows to `axes` for each link: the direction of its axis, and its
/// origin.
HWY_INLINE LanePose last_frame(const internal::Chain& chain, const double* q, double* axes) {
  return frames_along(chain, q, [&](const LanePose& frame) HWY_ATTR {
    frame.z.store(axes);
    frame.origin.store(axes + 3 * lane_count);
    axes += 6 * lane_count;
  });
}

/// Linear and angular velocity.
struct Motion {
  Vector linear, angular;
};

/// The velocity of `point` for unit velocity of the link's coordinate; `axes` are the link's six
/// rows. This is joint_velocity() in lanes.
HWY_INLINE Motion link_motion(const internal::Chain::Link& link, const double* axes,
                              const Vector& point) {
  const Vector direction = Vector::load(axes);
  const Vector angular = Lanes(link.theta_per_q) * direction;
  const Vector arm = point - Vector::load(axes + 3 * lane_count);
  return {fma(Lanes(link.d_per_q), direction, cross(angular, arm)), angular};
}

}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
