#include <algorithm>

#include <beeline/kinematics/forward_kernel.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "beeline/kinematics/forward_kernel.cpp"
#include <hwy/foreach_target.h>

#include <beeline/kinematics/halves-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {
namespace {

constexpr std::size_t block = lane_count;  // links whose sines are taken together

/// Sines and cosines of the links from `first` on, eight of them; behind the last 0 and 1.
HWY_INLINE void sines(const Arm& arm, const double* q, std::size_t first, double* sine,
                      double* cosine) {
  const ChainAngles& angles = arm.chain_angles();
  const std::vector<Chain::Link>& links = arm.chain().links;
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
  const Lanes rest_c = Lanes::load(&angles.cos_offset[first]),
              rest_s = Lanes::load(&angles.sin_offset[first]);
  fma(s, rest_c, c * rest_s).store(sine);
  fnma(s, rest_s, c * rest_c).store(cosine);
}

/// From the frame through a block's links, in two halves side by side, which are then put together:
/// that takes half as long as one link after the other. `axes`, if kept, gets eight numbers for
/// each link: its joint's direction, and from the fifth on its place.
template <bool keep>
HWY_INLINE Columns go_through(const Arm& arm, const double* q, std::size_t first,
                              const Columns& frame, double* axes) {
  static const Chain::Link nothing;
  const std::vector<Chain::Link>& links = arm.chain().links;
  const std::size_t count = std::min(block, links.size() - first), half = (count + 1) / 2;
  double sine[block], cosine[block], z[block / 2][lane_count], p[block / 2][lane_count];
  sines(arm, q, first, sine, cosine);
  Halves halves = Halves::starting_with(frame);
  for (std::size_t i = 0; i < half; ++i) {
    const std::size_t j = half + i;
    const Chain::Link& a = links[first + i];
    const Chain::Link& b = j < count ? links[first + j] : nothing;
    const double slide_a = a.d_per_q * q[a.coordinate], slide_b = b.d_per_q * q[b.coordinate];
    halves.follow(a, sine[i], cosine[i], slide_a, b, sine[j % block], cosine[j % block], slide_b);
    if (keep) {
      halves.z.store(z[i]);
      halves.p.store(p[i]);
    }
  }
  const Columns middle = halves.first();
  for (std::size_t i = 0; keep && i < half; ++i) {
    Four::load(z[i]).store(axes + 8 * i);
    Four::load(p[i]).store(axes + 8 * i + 4);
  }
  for (std::size_t i = half; keep && i < count; ++i) {
    turned(middle, z[i - half] + 4).store(axes + 8 * i);
    moved(middle, p[i - half] + 4).store(axes + 8 * i + 4);
  }
  return halves.together();
}

/// The chain's frame behind the tool.
void forward(const Arm& arm, const double* q, double* world_T_tool) {
  Columns frame = Columns::load(arm.chain().base.data());
  for (std::size_t first = 0; first < arm.chain().links.size(); first += block) {
    frame = go_through<false>(arm, q, first, frame, nullptr);
  }
  times(frame, arm.chain().tool.data()).store(world_T_tool);
}

/// Columns of the Jacobian from their axes and the tool's place.
HWY_INLINE void write_columns(const Chain::Link* links, std::size_t count, const double* axes,
                              const Four& tool, double* columns) {
  for (std::size_t i = 0; i < count; ++i, axes += 8, columns += 6) {
    const Four z = Four::load(axes), turning = z.times(links[i].theta_per_q);
    const Four arm = tool.plus(-1, Four::load(axes + 4));
    cross(turning, arm).plus(links[i].d_per_q, z).store(columns);
    if (i + 1 < count) {
      turning.store(columns + 3);  // the fourth number is where the next column comes
    } else {
      turning.store_three(columns + 3);
    }
  }
}

void jacobian(const Arm& arm, const double* q, double* world_T_tool, double* columns) {
  const std::vector<Chain::Link>& links = arm.chain().links;
  const std::size_t count = links.size();
  double axes[8 * block];
  Columns frame = Columns::load(arm.chain().base.data());
  if (count <= block) {
    frame = times(go_through<true>(arm, q, 0, frame, axes), arm.chain().tool.data());
    frame.store(world_T_tool);
    return write_columns(links.data(), count, axes, frame.p, columns);
  }
  // Where the tool is must be known before the first column can be: a second round.
  forward(arm, q, world_T_tool);
  for (std::size_t first = 0; first < count; first += block) {
    frame = go_through<true>(arm, q, first, frame, axes);
    write_columns(&links[first], std::min(block, count - first), axes,
                  Four::load(world_T_tool + 12), columns + 6 * first);
  }
}

}  // namespace
}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace beeline {

HWY_EXPORT(forward);
HWY_EXPORT(jacobian);

void forward_kernel(const Arm& arm, const double* q, double* world_T_tool) {
  HWY_DYNAMIC_DISPATCH(forward)(arm, q, world_T_tool);
}

void jacobian_kernel(const Arm& arm, const double* q, double* world_T_tool, double* columns) {
  HWY_DYNAMIC_DISPATCH(jacobian)(arm, q, world_T_tool, columns);
}

}  // namespace beeline
#endif
