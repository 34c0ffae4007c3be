#include <algorithm>

#include <beeline/kinematics/internal/forward_kernel.h>
#include <beeline/model/internal/chain.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "beeline/kinematics/internal/forward_kernel.cpp"
#include <hwy/foreach_target.h>

#include <beeline/kinematics/half_products-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {
namespace {

constexpr std::size_t block = lane_count;  // links whose sines are computed together

/// Sines and cosines of theta of eight links from `first` on; 0 and 1 after the last link.
HWY_INLINE void sines(const Arm& arm, const double* q, std::size_t first, double* sine,
                      double* cosine) {
  const internal::ChainAngles& angles = internal::chain_angles_of(arm);
  const std::vector<internal::Chain::Link>& links = internal::chain_of(arm).links;
  const std::size_t count = std::min(block, links.size() - first);
  Lanes value;
  if (angles.in_order) {
    value = Lanes::load_first(q + first, static_cast<int>(count));
  } else {
    double gathered[block] = {};
    for (std::size_t i = 0; i < count; ++i) gathered[i] = q[links[first + i].coordinate];
    value = Lanes::load(gathered);
  }
  Lanes s, c;
  sine_cosine(value * Lanes::load(&angles.theta_per_q[first]), s, c);
  const Lanes offset_c = Lanes::load(&angles.cos_offset[first]),
              offset_s = Lanes::load(&angles.sin_offset[first]);
  fma(s, offset_c, c * offset_s).store(sine);
  fnma(s, offset_s, c * offset_c).store(cosine);
}

/// Multiplies `frame` by a block's link transforms: computes the products of two halves of the
/// links in the lanes of one register, then their product, which takes half the time of a
/// sequential product. With `keep`, writes eight numbers to `axes` for each link: the direction of
/// its axis, and from the fifth on its origin.
template <bool keep>
HWY_INLINE Columns through_links(const Arm& arm, const double* q, std::size_t first,
                                 const Columns& frame, double* axes) {
  static const internal::Chain::Link identity;
  const std::vector<internal::Chain::Link>& links = internal::chain_of(arm).links;
  const std::size_t count = std::min(block, links.size() - first), half = (count + 1) / 2;
  double sine[block], cosine[block], z[block / 2][lane_count], p[block / 2][lane_count];
  sines(arm, q, first, sine, cosine);
  HalfProducts halves = HalfProducts::starting_with(frame);
  for (std::size_t i = 0; i < half; ++i) {
    const std::size_t j = half + i;
    const internal::Chain::Link& a = links[first + i];
    const internal::Chain::Link& b = j < count ? links[first + j] : identity;
    const double d_a = a.d_per_q * q[a.coordinate], d_b = b.d_per_q * q[b.coordinate];
    halves.append(a, sine[i], cosine[i], d_a, b, sine[j % block], cosine[j % block], d_b);
    if (keep) {
      halves.z.store(z[i]);
      halves.p.store(p[i]);
    }
  }
  const Columns middle = halves.first();
  for (std::size_t i = 0; keep && i < half; ++i) {
    PaddedVector3::load(z[i]).store(axes + 8 * i);
    PaddedVector3::load(p[i]).store(axes + 8 * i + 4);
  }
  for (std::size_t i = half; keep && i < count; ++i) {
    rotated(middle, z[i - half] + 4).store(axes + 8 * i);
    transformed(middle, p[i - half] + 4).store(axes + 8 * i + 4);
  }
  return halves.product();
}

void forward(const Arm& arm, const double* q, double* world_T_tool) {
  Columns frame = Columns::load(internal::chain_of(arm).base.data());
  for (std::size_t first = 0; first < internal::chain_of(arm).links.size(); first += block) {
    frame = through_links<false>(arm, q, first, frame, nullptr);
  }
  times(frame, internal::chain_of(arm).tool.data()).store(world_T_tool);
}

/// The Jacobian's columns [theta' z x (tool - p) + d' z; theta' z] of links with axis z and origin
/// p. This is joint_velocity() for one configuration in registers of four; chain-inl.h and batch/
/// have it for one configuration in each lane, which is another layout of the same numbers.
HWY_INLINE void write_columns(const internal::Chain::Link* links, std::size_t count,
                              const double* axes, const PaddedVector3& tool, double* columns) {
  for (std::size_t i = 0; i < count; ++i, axes += 8, columns += 6) {
    const PaddedVector3 z = PaddedVector3::load(axes), angular = z.times(links[i].theta_per_q);
    const PaddedVector3 arm = tool.plus(-1, PaddedVector3::load(axes + 4));
    cross(angular, arm).plus(links[i].d_per_q, z).store(columns);
    if (i + 1 < count) {
      angular.store(columns + 3);  // the next column overwrites the fourth number
    } else {
      angular.store_three(columns + 3);
    }
  }
}

void jacobian(const Arm& arm, const double* q, double* world_T_tool, double* columns) {
  const std::vector<internal::Chain::Link>& links = internal::chain_of(arm).links;
  const std::size_t count = links.size();
  double axes[8 * block];
  Columns frame = Columns::load(internal::chain_of(arm).base.data());
  if (count <= block) {
    frame = times(through_links<true>(arm, q, 0, frame, axes), internal::chain_of(arm).tool.data());
    frame.store(world_T_tool);
    return write_columns(links.data(), count, axes, frame.p, columns);
  }
  // The first column already needs the tool's position: a second pass over the links.
  forward(arm, q, world_T_tool);
  for (std::size_t first = 0; first < count; first += block) {
    frame = through_links<true>(arm, q, first, frame, axes);
    write_columns(&links[first], std::min(block, count - first), axes,
                  PaddedVector3::load(world_T_tool + 12), columns + 6 * first);
  }
}

}  // namespace
}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace beeline {
HWY_EXPORT(forward);
HWY_EXPORT(jacobian);
}  // namespace beeline

namespace beeline::internal {

void forward_kernel(const Arm& arm, const double* q, double* world_T_tool) {
  HWY_DYNAMIC_DISPATCH(forward)(arm, q, world_T_tool);
}

void jacobian_kernel(const Arm& arm, const double* q, double* world_T_tool, double* columns) {
  HWY_DYNAMIC_DISPATCH(jacobian)(arm, q, world_T_tool, columns);
}

}  // namespace beeline::internal
#endif
