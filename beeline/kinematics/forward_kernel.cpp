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
  sine_cosine(fma(value, Lanes::load(&angles.turn[first]), Lanes::load(&angles.rest[first])), s, c);
  s.store(sine);
  c.store(cosine);
}

/// The chain's frame behind the tool. A block's links are gone through in two halves side by side,
/// which are then put together: that takes half as long as one after the other.
void forward(const Arm& arm, const double* q, double* world_T_tool) {
  static const Chain::Link nothing;
  const std::vector<Chain::Link>& links = arm.chain().links;
  Columns frame = Columns::load(arm.chain().base.data());
  for (std::size_t first = 0; first < links.size(); first += block) {
    double sine[block], cosine[block];
    sines(arm, q, first, sine, cosine);
    const std::size_t count = std::min(block, links.size() - first), half = (count + 1) / 2;
    Halves halves = Halves::starting_with(frame);
    for (std::size_t i = 0; i < half; ++i) {
      const std::size_t j = half + i;
      const Chain::Link& a = links[first + i];
      const Chain::Link& b = j < count ? links[first + j] : nothing;
      const double slide_a = a.travel * q[a.coordinate], slide_b = b.travel * q[b.coordinate];
      halves.follow(a, sine[i], cosine[i], slide_a, b, sine[j % block], cosine[j % block], slide_b);
    }
    frame = halves.together();
  }
  times(frame, arm.chain().tool.data()).store(world_T_tool);
}

/// The joints one after the other: each one's frame is needed. What they are, a place and a
/// direction each, waits in the columns until it is known where the tool is.
void jacobian(const Arm& arm, const double* q, double* world_T_tool, double* columns) {
  const std::vector<Chain::Link>& links = arm.chain().links;
  Columns frame = Columns::load(arm.chain().base.data());
  for (std::size_t first = 0; first < links.size(); first += block) {
    double sine[block], cosine[block];
    sines(arm, q, first, sine, cosine);
    const std::size_t count = std::min(block, links.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      const Chain::Link& link = links[first + i];
      frame = behind(frame, link, sine[i], cosine[i], link.travel * q[first + i]);
      double* column = columns + 6 * (first + i);
      frame.p.store(column);
      if (first + i + 1 < links.size()) {
        frame.z.store(column + 3);  // the fourth number goes where the next column comes
      } else {
        frame.z.store_three(column + 3);
      }
    }
  }
  const Columns tool = times(frame, arm.chain().tool.data());
  tool.store(world_T_tool);
  for (std::size_t i = 0; i < links.size(); ++i) {
    double* column = columns + 6 * i;
    const double* pose = world_T_tool;
    const double turn = links[i].turn, travel = links[i].travel;
    const double z[3] = {column[3], column[4], column[5]};
    const double w[3] = {turn * z[0], turn * z[1], turn * z[2]};
    const double r[3] = {pose[12] - column[0], pose[13] - column[1], pose[14] - column[2]};
    column[0] = w[1] * r[2] - w[2] * r[1] + travel * z[0];
    column[1] = w[2] * r[0] - w[0] * r[2] + travel * z[1];
    column[2] = w[0] * r[1] - w[1] * r[0] + travel * z[2];
    column[3] = w[0];
    column[4] = w[1];
    column[5] = w[2];
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
