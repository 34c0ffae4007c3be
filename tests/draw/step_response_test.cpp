#include <cmath>
#include <gtest/gtest.h>

#include <beeline/control/joint.h>
#include <beeline/draw/timing_figure.h>
#include <beeline/model/catalog.h>

#include <tests/draw/page.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

/// The curves of a drawing in a colour, without the legend's.
std::vector<PaperPoint> curve_of(const Picture& picture, const Colour& colour) {
  std::vector<PaperPoint> longest;
  for (const PaperMark& mark : picture.marks) {
    const auto* stroke = std::get_if<PaperStroke>(&mark);
    if (stroke == nullptr || !(stroke->line == colour)) continue;
    if (stroke->path.points.size() > longest.size()) longest = stroke->path.points;
  }
  return longest;
}

TEST(StepResponse, OfAGainAbove1OvershootsAndBelow1DoesNot) {
  const Arm arm = built_in("rrr");
  const Configuration start = Configuration::Zero(3), goal = Eigen::Vector3d(1, -0.5, 0.3);
  std::vector<NamedMotion> motions;
  for (const double gain : {0.1, 0.5, 1.5}) {
    motions.push_back({"gain " + std::to_string(gain),
                       control_joints(arm, start, goal, {.kp = gain}).trajectory});
  }
  const Picture picture = step_response_figure(motions, goal, "gains");
  testing::expect_within_page(picture, "gains");
  // The highest curve on paper, whose y points down, belongs to the gain that overshoots.
  double highest[3];
  for (int k = 0; k < 3; ++k) {
    highest[k] = 1e9;
    for (const PaperPoint& p : curve_of(picture, distinct_colour(k))) {
      highest[k] = std::min(highest[k], p.y());
    }
  }
  EXPECT_NEAR(highest[0], highest[1], 1.5);  // both end at the goal
  EXPECT_LT(highest[2], highest[0] - 40);    // 50 % above it
}

TEST(StepResponse, RefusesWhatIsNoStep) {
  const Arm arm = built_in("rrr");
  const Configuration zero = Configuration::Zero(3);
  const NamedMotion still{"still", at_rest(arm, zero)};
  EXPECT_REFUSED(step_response_figure({still}, zero, ""), "goal is the start");
  EXPECT_REFUSED(step_response_figure({still}, Configuration::Zero(2), ""), "2 joint values");
  EXPECT_REFUSED(step_response_figure({{"", {}}}, zero, ""), "without samples");
}

}  // namespace
}  // namespace beeline
