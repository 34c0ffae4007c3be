#include <gtest/gtest.h>
#include <numbers>

#include <beeline/draw/internal/outline.h>

#include <tests/random.h>

namespace beeline {
using namespace internal;
namespace {

using testing::Random;

std::vector<PaperPoint> random_points(Random& random) {
  std::vector<PaperPoint> points;
  const int count = random.integer(1, 30);
  const bool on_grid = random.integer(0, 2) == 0, in_line = random.integer(0, 4) == 0;
  for (int i = 0; i < count; ++i) {
    PaperPoint p(random.uniform(-9, 9), in_line ? 0.0 : random.uniform(-9, 9));
    if (on_grid) p = p.array().round();
    points.push_back(p);
  }
  return points;
}

/// The maximum of n . x over points.
double furthest(const std::vector<PaperPoint>& points, const PaperPoint& n) {
  double most = -1e300;
  for (const PaperPoint& p : points) most = std::max(most, n.dot(p));
  return most;
}

PaperPoint random_normal(Random& random) {
  const double angle = random.uniform(0, 2 * std::numbers::pi);
  return {std::cos(angle), std::sin(angle)};
}

TEST(Outline, IsTheHullOfThePointsGrownByTheRadius) {
  Random random;
  for (int i = 0; i < testing::cases(3000); ++i) {
    const std::vector<PaperPoint> points = random_points(random);
    const double radius = random.integer(0, 1) * random.uniform(0, 5);
    const std::vector<PaperPoint> outline = outline_of(points, radius);
    for (int k = 0; k < 20; ++k) {
      const PaperPoint n = random_normal(random);
      const double exact = furthest(points, n) + radius, drawn = furthest(outline, n);
      EXPECT_LE(drawn, exact + 1e-12);
      EXPECT_GE(drawn, exact - 0.004 * radius - 1e-12);
    }
  }
}

TEST(Outline, IsClippedToTheRectangle) {
  Random random;
  const PaperBox box{{-4, -3}, {5, 6}};
  const auto is_inside = [&](const PaperPoint& p) {
    return (p.array() >= box.low.array() - 1e-9).all() &&
           (p.array() <= box.high.array() + 1e-9).all();
  };
  int cut = 0;
  for (int i = 0; i < testing::cases(3000); ++i) {
    const auto outline = outline_of(random_points(random), random.uniform(0, 3));
    const auto inside = clipped(outline, box);
    const PaperPath edges = clipped_edges(outline, box);
    EXPECT_TRUE(std::all_of(inside.begin(), inside.end(), is_inside));
    EXPECT_TRUE(std::all_of(edges.points.begin(), edges.points.end(), is_inside));
    EXPECT_EQ(edges.points.size() % 2, 0U);
    // A corner that is inside is kept, and the corners that are made are on the outline's hull.
    for (const PaperPoint& corner : outline) {
      if (!is_inside(corner)) continue;
      EXPECT_NE(std::find(inside.begin(), inside.end(), corner), inside.end());
    }
    for (const PaperPoint& corner : inside) {
      const PaperPoint n = random_normal(random);
      EXPECT_LE(n.dot(corner), furthest(outline, n) + 1e-9);
    }
    cut += inside == outline ? 0 : 1;
  }
  EXPECT_GT(cut, testing::cases(3000) / 3);
}

}  // namespace
}  // namespace beeline
