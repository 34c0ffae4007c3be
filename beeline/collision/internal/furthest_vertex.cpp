#include <array>

#include <beeline/collision/internal/furthest_vertex.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "beeline/collision/internal/furthest_vertex.cpp"
#include <hwy/foreach_target.h>

#include <beeline/simd/lanes-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {
namespace {

/// The index of the vertex furthest in a direction; the vertices are triples of numbers.
std::size_t furthest(const double* vertices, std::size_t count, const double* direction) {
  const RegisterTag tag;
  const std::size_t width = hn::Lanes(tag);
  std::size_t best = 0, i = 0;
  const auto along = [&](std::size_t k) {
    const double* v = vertices + 3 * k;
    return direction[0] * v[0] + direction[1] * v[1] + direction[2] * v[2];
  };
  double most = along(0);
  if (count >= width) {
    const auto x = hn::Set(tag, direction[0]), y = hn::Set(tag, direction[1]),
               z = hn::Set(tag, direction[2]);
    auto largest = hn::Set(tag, most), first = hn::Zero(tag);
    for (; i + width <= count; i += width) {
      auto a = hn::Zero(tag), b = a, c = a;
      hn::LoadInterleaved3(tag, vertices + 3 * i, a, b, c);
      const auto dot = hn::MulAdd(x, a, hn::MulAdd(y, b, hn::Mul(z, c)));
      const auto is_more = hn::Gt(dot, largest);
      largest = hn::Max(dot, largest);
      first = hn::IfThenElse(is_more, hn::Set(tag, static_cast<double>(i)), first);
    }
    std::array<double, lane_count> values, firsts;
    hn::StoreU(largest, tag, values.data());
    hn::StoreU(first, tag, firsts.data());
    for (std::size_t k = 0; k < width; ++k) {
      if (!(values[k] > most)) continue;
      most = values[k];
      best = static_cast<std::size_t>(firsts[k]) + k;
    }
  }
  for (; i < count; ++i) {
    const double value = along(i);
    if (value > most) most = value, best = i;
  }
  return best;
}

}  // namespace
}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace beeline {

HWY_EXPORT(furthest);

namespace internal {

const Vector3& furthest_vertex(std::span<const Vector3> vertices, const Vector3& direction) {
  static_assert(sizeof(Vector3) == 3 * sizeof(double));
  return vertices[HWY_DYNAMIC_DISPATCH(furthest)(vertices.front().data(), vertices.size(),
                                                 direction.data())];
}

}  // namespace internal
}  // namespace beeline
#endif
