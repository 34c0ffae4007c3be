#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include <beeline/draw/arm_figure.h>
#include <beeline/draw/internal/annotation.h>
#include <beeline/draw/internal/arm_drawing.h>
#include <beeline/draw/internal/page.h>
#include <beeline/draw/internal/paper_shapes.h>
#include <beeline/draw/internal/text.h>
#include <beeline/draw/internal/trail.h>
#include <beeline/model/catalog.h>

#include <tests/draw/page.h>
#include <tests/random_arm.h>
#include <tests/refusal.h>
#include <tests/typical_arms.h>

namespace beeline {
using namespace internal;
namespace {

using testing::box_of;
using testing::expect_within_page;
using testing::Random;

Figure figure_of(Drawing drawing, const View& view = top_view()) {
  Figure figure;
  figure.columns = {{Panel{.drawing = std::move(drawing), .view = view}}};
  return figure;
}

Drawing dots_at(std::vector<Vector3> points) {
  Drawing drawing;
  drawing.add(Layer::mark, Dots{std::move(points)});
  return drawing;
}

/// Where the figure's only Dots of a colour that nothing else has are on paper.
std::vector<PaperPoint> places(const Figure& figure, const Colour& colour) {
  std::vector<PaperPoint> found;
  for (const PaperMark& mark : compose(figure).marks) {
    const auto* stroke = std::get_if<PaperStroke>(&mark);
    if (stroke == nullptr || stroke->line.red != colour.red) continue;
    for (std::size_t i = 0; i < stroke->path.points.size(); i += 2) {
      found.push_back(stroke->path.points[i]);
    }
  }
  return found;
}

TEST(Compose, ClipsNothingOfBuiltInArms) {
  Random random;
  for (const std::string& name : testing::typical_arms) {
    const Arm arm = built_in(name);
    for (int trial = 0; trial < 8; ++trial) {
      const Configuration q = random.configuration(arm);
      expect_within_page(
          compose(arm_figure(arm, q, {.frames = trial % 2 == 0, .jacobian = trial % 3 == 0})),
          name);
    }
  }
}

TEST(Compose, ClipsNothingOfRandomArmsMotionsAndViews) {
  Random random;
  for (int trial = 0; trial < 60; ++trial) {
    const Arm arm = testing::random_arm(random, random.integer(1, 9), 5);
    Trajectory motion = at_rest(arm, random.configuration(arm));
    motion.velocities.clear();
    motion.accelerations.clear();
    for (int k = 1; k < 5; ++k) {
      motion.times.push_back(k);
      motion.positions.push_back(random.configuration(arm));
    }
    ArmFigureOptions options;
    options.frames = random.integer(0, 1) == 1;
    options.jacobian = random.integer(0, 1) == 1;
    options.azimuth = random.uniform(-3, 3);
    options.elevation = random.uniform(-1.5, 1.5);
    expect_within_page(compose(motion_figure(arm, motion, {random.pose(3)}, options)), "motion");
  }
}

TEST(Compose, ClipsNothingAtAnyScale) {
  Random random;
  for (double size = 1e-6; size < 1e7; size *= 10) {
    std::vector<Vector3> points;
    for (int k = 0; k < 20; ++k) points.push_back(random.vector(size));
    for (const View& view : {top_view(), front_view(), side_view(), oblique_view(0.3, 0.4)}) {
      Drawing drawing = dots_at(points);
      drawing.add(Layer::note, Label{points[0], "a label"});
      drawing.floor = 0;
      const Picture picture = compose(figure_of(drawing, view));
      expect_within_page(picture, "size " + std::to_string(size));
      EXPECT_LT(picture.width, 700) << size;
      EXPECT_LT(picture.height, 700) << size;
    }
  }
}

TEST(Compose, DrawsWhatIsAllInOnePlace) {
  for (const Vector3& place : {Vector3(0, 0, 0), Vector3(1e4, -1e4, 3), Vector3(1e-3, 0, 1e11)}) {
    for (const View& view : {top_view(), oblique_view(0.3, 0.4)}) {
      const Figure figure = figure_of(dots_at({place, place}), view);
      expect_within_page(compose(figure), "one place");
    }
  }
  expect_within_page(compose(figure_of(Drawing{})), "nothing");
}

TEST(Compose, KeepsTheAspect) {
  Random random;
  for (int trial = 0; trial < 200; ++trial) {
    Drawing drawing = dots_at({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    std::get<Dots>(drawing.items[0].shape).colour = {0.123, 0, 0};
    std::vector<Vector3> others;
    for (int k = 0; k < 5; ++k) {
      others.emplace_back(random.uniform(-9, 9), random.uniform(-1, 1), random.uniform(-1, 1));
    }
    drawing.add(Layer::mark, Dots{others});
    const std::vector<PaperPoint> at = places(figure_of(drawing), {0.123, 0, 0});
    ASSERT_EQ(at.size(), 3u);
    const PaperPoint x = at[1] - at[0], y = at[2] - at[0];
    EXPECT_NEAR(x.y(), 0, 1e-9);
    EXPECT_NEAR(y.x(), 0, 1e-9);
    EXPECT_GT(x.x(), 0);
    EXPECT_NEAR(-y.y() / x.x(), 1, 1e-9);  // up is up, and as long
  }
}

TEST(Compose, DrawsPanelsAtOneScale) {
  Figure figure;
  for (const double size : {1.0, 3.0}) {
    Drawing drawing = dots_at({{0, 0, 0}, {size, 0, 0}});
    std::get<Dots>(drawing.items[0].shape).colour = {0.123, 0, 0};
    figure.columns.push_back({Panel{.drawing = drawing}});
  }
  const std::vector<PaperPoint> at = places(figure, {0.123, 0, 0});
  ASSERT_EQ(at.size(), 4u);
  EXPECT_NEAR((at[3] - at[2]).norm() / (at[1] - at[0]).norm(), 3, 1e-9);
  EXPECT_NEAR(at[0].y(), at[2].y(), 1e-9);  // side by side: the same height for the same y
}

TEST(Compose, KeepsNamesApart) {
  // The names of the chapter's figures cover neither each other nor a number of the rulers.
  for (const std::string& number : chapter_figures()) {
    std::vector<PaperBox> boxes;
    for (const PaperMark& mark : compose(chapter_figure(number)).marks) {
      if (std::holds_alternative<PaperText>(mark)) boxes.push_back(box_of(mark));
    }
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        const PaperPoint common =
            boxes[i].high.cwiseMin(boxes[k].high) - boxes[i].low.cwiseMax(boxes[k].low);
        EXPECT_FALSE(common.x() > 0.5 && common.y() > 3) << number;
      }
    }
  }
}

TEST(Compose, StandsLongAndBrokenText) {
  const std::string words = [] {
    std::string text;
    for (int k = 0; k < 20'000; ++k) text += "word ";
    return text;
  }();
  for (const std::string& text :
       {std::string(100'000, 'w'), words, std::string("\xff\xfe\x80 \xed\xa0\x80 \x01"),
        std::string("\xC3"), std::string("two\nlines"), std::string("\n\n"), std::string()}) {
    Figure figure = figure_of(dots_at({{0, 0, 0}, {1, 1, 0}}));
    figure.title = text;
    figure.columns[0][0].caption = text;
    expect_within_page(compose(figure), text.substr(0, 20));
  }
}

TEST(Compose, RefusesWhatCannotBeDrawn) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_REFUSED(compose(figure_of(dots_at({{0, nan, 0}}))), "dot at (0, nan, 0)");
  EXPECT_REFUSED(compose(figure_of(dots_at({{0, 0, -inf}}))), "must be finite");
  EXPECT_REFUSED(compose(figure_of(dots_at({{1e13, 0, 0}}))), "within 1e12 m");
  Drawing drawing;
  drawing.add(Layer::note, Label{{nan, 0, 0}, "a"});
  EXPECT_REFUSED(compose(figure_of(drawing)), "label");
  EXPECT_REFUSED(compose(Figure{}), "at least one panel");
  Figure empty_column;
  empty_column.columns.emplace_back();
  EXPECT_REFUSED(compose(empty_column), "column has no panel");
  Figure zoomed = figure_of(dots_at({{0, 0, 0}}));
  zoomed.columns[0][0].zoom = 0;
  EXPECT_REFUSED(compose(zoomed), "zoom 0");
  Figure paper = figure_of(dots_at({{0, 0, 0}}));
  paper.width = nan;
  EXPECT_REFUSED(compose(paper), "page of nan");
  EXPECT_REFUSED(oblique_view(nan, 0), "azimuth nan");
  EXPECT_REFUSED(oblique_view(0, inf), "elevation inf");
  EXPECT_REFUSED(motion_figure(built_in("rrr"), {}), "without samples");
  EXPECT_REFUSED(arm_figure(built_in("rrr"), Configuration::Zero(4)), "3 joint values");
}

TEST(Compose, FillsThePage) {
  Figure figure = figure_of(dots_at({{0, 0, 0}, {3, 1, 0}}));
  figure.columns[0][0].caption = "two dots";
  for (const double height : {200.0, 300.0, 470.0}) {
    figure.width = 400;
    figure.height = height;
    figure.fill = true;
    const Picture picture = compose(figure);
    EXPECT_NEAR(picture.width, 400 + 2 * page_margin, 1);
    EXPECT_NEAR(picture.height, height + 2 * page_margin, 1);
    expect_within_page(picture, "filled");
  }
}

TEST(Text, IsBrokenWithoutAShortLastLine) {
  Random random;
  for (int trial = 0; trial < 200; ++trial) {
    std::string text;
    const int words = random.integer(2, 30);
    for (int w = 0; w < words; ++w) {
      text +=
          (w == 0 ? "" : " ") + std::string(static_cast<std::size_t>(random.integer(1, 9)), 'n');
    }
    const double width = random.uniform(80, 300);
    const std::vector<std::string> loose = wrapped(text, 9, width), even = balanced(text, 9, width);
    ASSERT_EQ(even.size(), loose.size());
    double widest = 0, total = 0;
    std::string joined;
    for (const std::string& line : even) {
      widest = std::max(widest, text_size(line, 9).x());
      total += text_size(line, 9).x();
      joined += (joined.empty() ? "" : " ") + line;
    }
    if (even.size() >= 12) continue;  // cut off
    EXPECT_EQ(joined, text);
    EXPECT_LE(widest, width);
    // No line could be shorter by more than the longest word.
    EXPECT_LT(widest, total / static_cast<double>(even.size()) + text_size("nnnnnnnnnn", 9).x());
    EXPECT_GT(wrapped(text, 9, widest - 0.6).size(), even.size() == 1 ? 0 : even.size());
  }
}

}  // namespace
}  // namespace beeline
