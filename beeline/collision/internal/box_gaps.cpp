#include <algorithm>
#include <limits>

#include <beeline/collision/internal/box_gaps.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "beeline/collision/internal/box_gaps.cpp"
#include <hwy/foreach_target.h>

#include <beeline/simd/lanes-inl.h>
#include <beeline/simd/vector-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {
namespace {

using Vector = VectorOf<Lanes>;

/// A number of each row. The rows begin at `starts`, counted from `column` of the first row.
HWY_INLINE Lanes gather(const double* column, const std::int64_t* starts) {
  constexpr int width = lane_count / register_count;
  const hn::RebindToSigned<RegisterTag> integers;
  Lanes r;
  for (int i = 0; i < register_count; ++i) {
    r.part[i] = hn::GatherIndex(RegisterTag(), column, hn::LoadU(integers, starts + i * width));
  }
  return r;
}

HWY_INLINE Vector gather_vector(const double* column, const std::int64_t* starts) {
  return {gather(column, starts), gather(column + 1, starts), gather(column + 2, starts)};
}

HWY_INLINE Vector same(const Vector3& v) { return {Lanes(v.x()), Lanes(v.y()), Lanes(v.z())}; }

HWY_INLINE Vector clamped(const Vector& v, const Vector& limit) {
  return {min(max(v.x, -limit.x), limit.x), min(max(v.y, -limit.y), limit.y),
          min(max(v.z, -limit.z), limit.z)};
}

/// towards() of the capsule and boxes.
HWY_INLINE Vector towards_boxes(const internal::BoundingCapsule& capsule, const Vector& centre,
                                const Vector& half_extents) {
  const Vector middle = same(capsule.centre), axis = same(capsule.half_axis);
  const double length = capsule.half_axis.squaredNorm();
  const bool is_sphere = !(length > 0);
  const Lanes inverse(is_sphere ? 0 : 1 / length);
  const auto on_segment = [&](const Vector& to) HWY_ATTR {  // `to` is from the middle
    return min(max(dot(to, axis) * inverse, Lanes(-1)), Lanes(1)) * axis;
  };
  const Vector between = centre - middle;
  Vector point = on_segment(between);
  Vector on_box = between + clamped(point - between, half_extents);
  if (!is_sphere) {
    point = on_segment(on_box);
    on_box = between + clamped(point - between, half_extents);
  }
  return on_box - point;
}

/// highest_along() of the capsule in eight directions.
HWY_INLINE Lanes highest_in_lanes(const internal::MovingCapsule& capsule, const Vector& n) {
  const internal::BoundingCapsule& at = capsule.at_middle;
  const Lanes along = dot(n, same(at.half_axis)),
              sideways = dot(n, same(capsule.half_axis_velocity));
  const Lanes forwards = dot(n, same(capsule.velocity));
  const Lanes about_n = dot(n, same(capsule.angular));
  const Lanes tilt_squared =
      max(Lanes(0), fnma(about_n, about_n, Lanes(capsule.angular.squaredNorm())));
  const Lanes radius(at.radius);
  const Lanes ends = max(along + abs(forwards + sideways), abs(forwards - sideways) - along);
  const Lanes first_order =
      fma(radius, fma(Lanes(0.5), tilt_squared, Lanes(1)), ends) + Lanes(capsule.bounds.remainder);
  const Lanes largest = abs(along) + radius + Lanes(capsule.bounds.displacement);
  return dot(n, same(at.centre)) + min(first_order, largest);
}

void gaps_in_lanes(const internal::MovingCapsule& capsule, const double* rows,
                   const std::int64_t* starts, double* gaps) {
  using Rows = internal::BoxRows;
  const Vector centre = gather_vector(rows + Rows::centre, starts);
  const Vector half_extents = gather_vector(rows + Rows::half_extents, starts);
  const Vector towards = towards_boxes(capsule.at_middle, centre, half_extents);
  const Lanes square = dot(towards, towards);
  const Vector n = (Lanes(1) / sqrt(square)) * towards;
  const Vector absolute{abs(n.x), abs(n.y), abs(n.z)};
  const Lanes lowest = dot(n, centre) - dot(absolute, half_extents);
  const Lanes gap = lowest - highest_in_lanes(capsule, n) - gather(rows + Rows::rounding, starts);
  constexpr double nothing = -std::numeric_limits<double>::infinity();
  choose(square > Lanes(internal::least_square), gap, Lanes(nothing)).store(gaps);
}

}  // namespace
}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace beeline {

HWY_EXPORT(gaps_in_lanes);

namespace internal {

void box_gaps(const MovingCapsule& capsule, const BoxRows& boxes,
              std::span<const std::uint32_t> indices, std::array<double, boxes_at_once>& gaps) {
  std::array<std::int64_t, boxes_at_once> starts;
  for (std::size_t k = 0; k < boxes_at_once; ++k) {
    starts[k] = std::int64_t{BoxRows::width} * indices[std::min(k, indices.size() - 1)];
  }
  HWY_DYNAMIC_DISPATCH(gaps_in_lanes)(capsule, boxes.data(), starts.data(), gaps.data());
}

}  // namespace internal
}  // namespace beeline
#endif
