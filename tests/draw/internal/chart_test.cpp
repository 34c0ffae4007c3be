#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include <beeline/draw/figure.h>
#include <beeline/draw/internal/paper_shapes.h>
#include <beeline/draw/internal/sheet.h>

#include <tests/draw/page.h>
#include <tests/random.h>
#include <tests/refusal.h>

namespace beeline {
using namespace internal;
namespace {

using testing::box_of;
using testing::expect_within_page;
using testing::Random;

Sheet sheet_of(std::vector<Curve> curves) {
  Chart chart{.heading = "a", .x_name = "x", .left_name = "y", .right_name = "z"};
  chart.curves = std::move(curves);
  return {.title = "title", .columns = {{.charts = {chart}}}};
}

double off(const PaperPoint& p, const std::vector<PaperPoint>& line) {
  double least = (p - line.front()).norm();
  for (std::size_t i = 1; i < line.size(); ++i) {
    const PaperPoint way = line[i] - line[i - 1];
    const double square = way.squaredNorm();
    const double t = square > 0 ? std::clamp((p - line[i - 1]).dot(way) / square, 0.0, 1.0) : 0;
    least = std::min(least, (p - line[i - 1] - t * way).norm());
  }
  return least;
}

TEST(Scale, HasAFewRoundTicksWithinAnyRange) {
  Random random;
  for (int trial = 0; trial < 2000; ++trial) {
    const double size = std::pow(10, random.uniform(-12, 14));
    const double low = random.uniform(-1, 1) * size;
    const double high = low + std::pow(10, random.uniform(-6, 0)) * size;
    Scale scale = spanning(low, high, 1e-15);
    set_upright_ticks(scale, 76, 13);
    EXPECT_LE(scale.low, low);
    EXPECT_GE(scale.high, high);
    const std::vector<double> values = ticks(scale);
    EXPECT_GE(values.size(), 2u) << low << " " << high;
    EXPECT_LE(values.size(), 6u) << low << " " << high;
    for (std::size_t i = 1; i < values.size(); ++i) {
      EXPECT_NE(tick_text(scale, values[i]), tick_text(scale, values[i - 1]));
    }
    set_level_ticks(scale, 380, 34);
    EXPECT_GT(scale.step / (scale.high - scale.low) * 380, widest_tick(scale)) << low;
  }
}

TEST(Scale, WritesPowersForWhatIsHugeOrTiny) {
  Scale scale = spanning(0, 3e9, 1);
  EXPECT_EQ(scale.exponent, 9);
  EXPECT_EQ(tick_text(scale, 2e9), "2");
  EXPECT_EQ(with_power("m", scale.exponent), "10⁹ m");
  EXPECT_EQ(with_power("m", -12), "10⁻¹² m");
  EXPECT_EQ(with_power("m", 0), "m");
  EXPECT_EQ(spanning(1.7e9, 1.7e9 + 5, 0).exponent, 0);  // seconds since 1970
}

TEST(Thinned, KeepsTheLookTheEndsAndTheExtremes) {
  Random random;
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<PaperPoint> points;
    const int count = random.integer(1, 3000);
    double y = 0;
    for (int k = 0; k < count; ++k) {
      y = random.integer(0, 30) == 0 ? random.uniform(0, 76) : y;
      points.emplace_back(380.0 * k / count, y);
    }
    const std::vector<PaperPoint> few = thinned(points);
    EXPECT_LE(few.size(), points.size());
    EXPECT_EQ(few.front(), points.front());
    EXPECT_EQ(few.back(), points.back());
    for (const PaperPoint& p : points) EXPECT_LT(off(p, few), 0.7);  // a strip and the tolerance
    const auto less = [](const PaperPoint& a, const PaperPoint& b) { return a.y() < b.y(); };
    EXPECT_NEAR(std::max_element(few.begin(), few.end(), less)->y(),
                std::max_element(points.begin(), points.end(), less)->y(), 0.1);
  }
  EXPECT_TRUE(thinned({}).empty());
  std::vector<PaperPoint> line;
  for (int k = 0; k < 100'000; ++k) line.emplace_back(k * 1e-3, k * 2e-3);
  EXPECT_EQ(thinned(line).size(), 2u);
}

TEST(Sheet, ClipsNothingAtAnySize) {
  Random random;
  for (double size = 1e-12; size < 1e140; size *= 1e3) {
    Curve curve{.name = "one", .x = {}, .y = {}};
    Curve other{.name = "two", .x = {}, .y = {}, .right = true};
    for (int k = 0; k < 40; ++k) {
      curve.x.push_back(k * size);
      curve.y.push_back(random.uniform(-size, size));
      other.x.push_back(k * size);
      other.y.push_back(1 / size);
    }
    Sheet sheet = sheet_of({curve, other});
    Chart& chart = sheet.columns[0].charts[0];
    chart.reference_lines = {{"limit", 2 * size}, {"far", 100 * size}, {"right", 1 / size, true}};
    chart.markers = {{0, "1"}, {20 * size, "a very long name"}, {39 * size, "3"}};
    const Picture picture = compose(sheet);
    expect_within_page(picture, std::to_string(std::log10(size)));
    EXPECT_LT(picture.width, 600);
    EXPECT_LT(picture.height, 200);
  }
}

TEST(Sheet, LeavesLevelsFarAwayOffTheScaleAndSaysSo) {
  for (const double level : {3.0, -3.0, 50.0, -50.0}) {
    Sheet sheet = sheet_of({{.x = {0, 1}, .y = {0, 1}}});
    sheet.columns[0].charts[0].reference_lines = {{"limit", level}};
    const Picture picture = compose(sheet);
    bool told = false, drawn = false;
    for (const PaperMark& mark : picture.marks) {
      if (const auto* text = std::get_if<PaperText>(&mark)) {
        told = told || text->text == "limit (off scale)";
      } else {
        const PaperBox box = box_of(mark);
        drawn = drawn || (!std::get<PaperStroke>(mark).dashes.empty() && box.size().x() > 300);
      }
    }
    EXPECT_EQ(drawn, std::abs(level) < 6);
    EXPECT_EQ(told, !drawn);
  }
}

TEST(Sheet, StandsLongTextAndOddData) {
  const std::string words(10'000, 'w');
  Sheet sheet = sheet_of({{.name = words, .x = {1}, .y = {2}}, {}, {.x = {1, 1}, .y = {2, 2}}});
  sheet.title = sheet.columns[0].charts[0].heading = words;
  sheet.columns[0].charts[0].left_name = sheet.columns[0].charts[0].x_name = words;
  sheet.legend = sheet.columns[0].charts[0].curves;
  expect_within_page(compose(sheet), "long");
  expect_within_page(compose(sheet_of({})), "empty");
}

TEST(Sheet, RefusesWhatCannotBeDrawn) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  for (const double value : {nan, inf, -inf, 1e200}) {
    EXPECT_REFUSED(compose(sheet_of({{.x = {0, 1, 2}, .y = {0, value, 1}}})),
                   "must be finite and within 1e150");
    EXPECT_REFUSED(compose(sheet_of({{.x = {0, value, 2}, .y = {0, 1, 1}}})),
                   "must be finite and within 1e150");
  }
  EXPECT_REFUSED(compose(sheet_of({{.x = {0, 1}, .y = {0}}})), "2 x values and 1 y values");
  EXPECT_REFUSED(compose(Sheet{}), "at least one column");
  Sheet empty = sheet_of({});
  empty.columns[0].charts.clear();
  EXPECT_REFUSED(compose(empty), "no chart");
}

}  // namespace
}  // namespace beeline
