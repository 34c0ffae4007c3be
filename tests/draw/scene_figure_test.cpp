#include <gtest/gtest.h>

#include <beeline/draw/arm_figure.h>
#include <beeline/draw/figure.h>
#include <beeline/draw/internal/scene_drawing.h>
#include <beeline/draw/timing_figure.h>
#include <beeline/model/catalog.h>

#include <tests/certificate/random_motion.h>
#include <tests/collision/random_model.h>
#include <tests/draw/page.h>
#include <tests/refusal.h>

namespace beeline {
using namespace internal;
namespace {

using testing::Random;

template <class Kind>
std::vector<Kind> kinds_of(const Drawing& drawing) {
  std::vector<Kind> found;
  for (const Item& item : drawing.items) {
    if (const auto* shape = std::get_if<Kind>(&item.shape)) found.push_back(*shape);
  }
  return found;
}

/// The points of a solid that are furthest along n.
double furthest(const Solid& solid, const Vector3& n) {
  double most = -1e300;
  for (const Vector3& p : solid.points) most = std::max(most, n.dot(p));
  return most + solid.radius;
}

TEST(SceneFigure, DrawsTheBodiesWithTheirExtents) {
  Random random;
  const Arm arm = built_in("panda");
  for (int i = 0; i < testing::cases(200); ++i) {
    const Shape shape = testing::random_shape(random, random.integer(0, 3), 0.3, 0.5);
    const CollisionModel model(arm, {{"tip", 7, {{Sphere{0.1}}}}},
                               {.obstacles = {{"body", {shape}}}});
    Drawing drawing;
    add_obstacles(drawing, model);
    const std::vector<Solid> solids = kinds_of<Solid>(drawing);
    ASSERT_EQ(solids.size(), 1U);
    EXPECT_EQ(kinds_of<Label>(drawing).size(), 1U);
    for (int k = 0; k < 20; ++k) {
      const Vector3 n = random.direction();
      // The point of the body far along n, whose projection is the furthest point.
      const double exact = n.dot(testing::projection(shape, shape.pose.translation() + 1e7 * n));
      EXPECT_NEAR(furthest(solids[0], n), exact, 0.005) << kind_name(shape);
    }
    // Faces are seen from outside.
    Vector3 middle = Vector3::Zero();
    for (const Vector3& p : solids[0].points) middle += p;
    middle /= static_cast<double>(solids[0].points.size());
    for (const auto& face : solids[0].faces) {
      const auto& points = solids[0].points;
      const Vector3 n =
          (points[face[1]] - points[face[0]]).cross(points[face[2]] - points[face[1]]);
      EXPECT_GE(n.dot(points[face[0]] - middle), -1e-12);
    }
  }
}

TEST(SceneFigure, ShowsTheNearestPairAndItsDistance) {
  Random random;
  const Arm arm = built_in("panda");
  for (int i = 0; i < testing::cases(60); ++i) {
    const CollisionModel model(arm, testing::random_link_shapes(random, arm, 0.1),
                               testing::random_scene(random, arm, random.integer(1, 20), 0.3, 1));
    const Configuration q = random.configuration(arm);
    const BodyDistance nearest = nearest_pair(model, q);
    Drawing drawing;
    add_nearest_pair(drawing, nearest);
    const std::vector<Polyline> lines = kinds_of<Polyline>(drawing);
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_EQ(lines[0].points, (std::vector<Vector3>{nearest.on_first, nearest.on_second}));
    const Figure figure = arm_figure(model, q);
    const std::string& caption = figure.columns[0][0].caption;
    EXPECT_NE(caption.find(nearest.names[0] + " and " + nearest.names[1]), std::string::npos);
    EXPECT_EQ(caption.find("overlap") != std::string::npos, nearest.lower <= 0) << caption;
    EXPECT_EQ(caption.find("required") != std::string::npos,
              nearest.lower > 0 && nearest.upper < nearest.clearance)
        << caption;
    testing::expect_within_page(compose(figure), "case " + std::to_string(i));
  }
}

TEST(SceneFigure, OfAMotionIsWithinItsPage) {
  Random random;
  for (const char* name : {"rrr", "panda"}) {
    const Arm arm = built_in(name);
    for (const double spread : {0.5, 3.0, 1e3}) {
      const CollisionModel model(arm, testing::random_link_shapes(random, arm, 0.1),
                                 testing::random_scene(random, arm, 20, spread, spread));
      const Trajectory motion = testing::random_motion(random, arm, Interpolation::cubic, 5, 0.3);
      testing::expect_within_page(compose(motion_figure(model, motion)), name);
      EXPECT_FALSE(motion_animation(model, motion).frames.empty());
      const TimedPair nearest = nearest_sample(model, motion).value();
      EXPECT_LE(nearest_pair(model, sample(motion, nearest.time).position).lower,
                nearest_pair(model, motion.positions.front()).lower + 1e-12);
      TimingFigureOptions options;
      options.clearance = clearance_over_time(model, motion);
      const Picture plain = timing_figure(arm, motion),
                    charted = timing_figure(arm, motion, options);
      testing::expect_within_page(charted, name);
      EXPECT_GT(charted.height, plain.height);
      const auto has = [](const Picture& picture, const std::string& text) {
        return std::any_of(picture.marks.begin(), picture.marks.end(), [&](const PaperMark& mark) {
          const auto* words = std::get_if<PaperText>(&mark);
          return words != nullptr && words->text == text;
        });
      };
      for (const char* text : {"clearance", "proved", "sampled"}) {
        EXPECT_TRUE(has(charted, text)) << text;
        EXPECT_FALSE(has(plain, text)) << text;
      }
    }
  }
}

/// A slide along x takes a cube from 0 to 1 and goes on to 2.
TEST(SceneFigure, OfAProgramHasThePartWhereItIsCarried) {
  Joint slide = composite_joint('P', "x").front();
  slide.limits = {.lower = -1, .upper = 3, .velocity = 1, .acceleration = 4};
  const Arm arm("slide", {slide});
  const Pose below = make_pose({0, 0, -0.5}, Rotation::Identity());
  const CollisionModel model(
      arm, {{"hand", 1, {{Box{Vector3::Constant(0.1)}}}}},
      {.obstacles = {{"part", {{Box{Vector3::Constant(0.2)}, below}}},
                     {"wall", {{Box{Vector3::Constant(0.3)}, make_pose({0, 1, 0})}}}}});
  Program program;
  for (const double x : {0.0, 1.0, 2.0}) {
    program.moves.push_back({.kind = MoveKind::joint, .q = Configuration{{x}}});
  }
  program.attachments = {{.part = "part", .after = 1, .until = 2}};
  const ProgramMotion motion = move_program(arm, Configuration{{-1}}, program);
  ASSERT_TRUE(motion) << motion.reason;
  std::vector<std::size_t> arrivals;
  for (const PlannedMove& move : motion.moves) arrivals.push_back(move.end);
  const auto scenes = program_scenes(model, motion.trajectory, program, arrivals);
  const auto part_at = [](const Drawing& drawing) {
    for (const Solid& solid : kinds_of<Solid>(drawing)) {
      const double size = furthest(solid, Vector3::UnitX()) + furthest(solid, -Vector3::UnitX());
      if (std::abs(size - 0.2) < 1e-9) return furthest(solid, Vector3::UnitX()) - 0.1;
    }
    return std::numeric_limits<double>::quiet_NaN();
  };
  const Animation animation = motion_animation(scenes, motion.trajectory);
  for (std::size_t i = 0; i < animation.frames.size(); ++i) {
    const double x = sample(motion.trajectory, animation.times[i]).position[0];
    EXPECT_NEAR(part_at(animation.frames[i]), std::clamp(x, 0.0, 1.0), 1e-9) << animation.times[i];
  }
  // What stands still is drawn once.
  const auto solids_of = [](const Drawing& drawing) { return kinds_of<Solid>(drawing).size(); };
  EXPECT_EQ(solids_of(animation.figure.columns[0][0].drawing), 1);
  for (const Drawing& frame : animation.frames) EXPECT_EQ(solids_of(frame), 2);  // hand and part
  const Figure figure = motion_figure(scenes, motion.trajectory);
  EXPECT_NEAR(part_at(figure.columns[0][0].drawing), 1, 1e-9);
  testing::expect_within_page(compose(figure), "program");
  EXPECT_REFUSED(motion_figure(std::span<const ProgramScene>(), motion.trajectory), "scene");
}

TEST(SceneFigure, HasThePairsThatCountOnlyOutsideTheLimits) {
  const Arm arm = with_limits(built_in("rrr"), {{"joint2", {.lower = -1, .upper = 1}},
                                                {"joint3", {.lower = -1, .upper = 1}}});
  const CollisionModel model(arm, {{"base", 0, {{Sphere{0.1}}}}, {"tip", 3, {{Sphere{0.1}}}}});
  ASSERT_EQ(model.pair_count(), 0);
  const Configuration inside{{0, 0.9, 0.9}}, at_base{{0, 2.56208, 1.86055}};
  const Trajectory motion{arm.joint_names(), {0, 1}, {inside, at_base}, {}, {}};
  const std::optional<TimedPair> nearest = nearest_sample(model, motion);
  ASSERT_TRUE(nearest);
  EXPECT_EQ(nearest->time, 1);
  EXPECT_FALSE(nearest_sample(model, {arm.joint_names(), {0}, {inside}, {}, {}}));
  const auto svg = [&](const Configuration& q) {
    return render(arm_figure(model, q), Format::svg);
  };
  EXPECT_NE(svg(at_base).find("tip and base overlap"), std::string::npos);
  EXPECT_EQ(svg(inside).find("tip and base"), std::string::npos);
  EXPECT_NE(render(motion_figure(model, motion), Format::svg).find("overlap"), std::string::npos);
}

TEST(SceneFigure, HasAPageOfTheSizeOfTheArmAmongFarAndHugeObstacles) {
  const Arm arm = built_in("panda");
  const std::vector<LinkShapes> links{{"tip", 7, {{Sphere{0.05}}}}};
  const Configuration q = display_configuration(arm);
  const auto scale = [&](const Scene& scene) {
    const Figure figure = arm_figure(CollisionModel(arm, links, scene), q);
    Vector3 low = Vector3::Constant(1e300), high = -low;
    for (const Solid& solid : kinds_of<Solid>(figure.columns[0][0].drawing)) {
      for (const Vector3& p : solid.framed) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
      }
    }
    return (high - low).maxCoeff();
  };
  const double alone = scale({});
  EXPECT_LE(scale({.obstacles = {{"hall", {{Box{{500, 500, 1}}, make_pose({0, 0, -1})}}}}}), 4);
  EXPECT_LE(scale({.obstacles = {{"earth", {{Sphere{6e5}, make_pose({0, 0, -6e5 - 0.1})}}}}}), 4);
  EXPECT_LE(scale({.obstacles = {{"floor", {{HalfSpace{}, make_pose({0, 0, -0.1})}}}}}), 4);
  EXPECT_EQ(scale({.obstacles = {{"far", {{Box{{1, 1, 1}}, make_pose({50, 0, 0})}}}}}), alone);
}

}  // namespace
}  // namespace beeline
