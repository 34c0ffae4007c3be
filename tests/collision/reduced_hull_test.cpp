#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include <beeline/collision/internal/reduced_hull.h>

#include <tests/random.h>

namespace beeline::internal {
namespace {

using beeline::testing::Random;
using Points = std::vector<Vector3>;

double highest(const Points& points, const Vector3& direction) {
  double most = -INFINITY;
  for (const Vector3& point : points) most = std::max(most, direction.dot(point));
  return most;
}

/// The largest distance, found in random directions, of a point beyond a plane that touches the
/// grown hull.
double beyond(const Points& points, const ReducedHull& hull, Random& random) {
  double most = -INFINITY;
  for (int i = 0; i < 300; ++i) {
    const Vector3 direction = random.direction();
    most = std::max(most, highest(points, direction) - highest(hull.vertices, direction));
  }
  return most - hull.growth;
}

bool has(const Points& points, const Vector3& point) {
  return std::find(points.begin(), points.end(), point) != points.end();
}

double size_of(const Points& points) {
  Vector3 extent;
  for (int i = 0; i < 3; ++i) {
    extent[i] = highest(points, Vector3::Unit(i)) + highest(points, -Vector3::Unit(i));
  }
  return extent.maxCoeff();
}

/// A cloud of one of several forms: in a ball, on a sphere, on the surface of a cylinder, on an
/// ellipsoid, on a grid with repeated points, or on a plate.
Points cloud(Random& random, int form, int count) {
  const double size = std::pow(10, random.uniform(-3, 1));
  const Rotation turned = random.rotation();
  const Vector3 centre = random.vector(size);
  Points points;
  for (int i = 0; i < count; ++i) {
    Vector3 p = random.direction();
    if (form == 0) p *= random.uniform(0, 1);
    if (form == 2) p = {std::cos(9.0 * i), std::sin(9.0 * i), random.uniform(-1, 1)};
    if (form == 3) p = p.cwiseProduct(Vector3(1, 0.3, 0.05));
    if (form == 4) p = (4 * p).array().round() / 4;
    if (form == 5) p.z() = 0;
    points.push_back(size * (turned * p) + centre);
  }
  return points;
}

TEST(ReducedHull, ContainsEveryPoint) {
  Random random;
  for (int i = 0; i < beeline::testing::cases(90); ++i) {
    const Points points = cloud(random, i % 6, random.integer(1, 1500));
    const double size = size_of(points);
    const ReducedHull hull = reduced_hull(points);
    EXPECT_LE(beyond(points, hull, random), 1e-12 * size) << i;
    EXPECT_LE(hull.vertices.size(), 2000u);
    EXPECT_LE(hull.growth, std::min(1e-4, 1e-3 * size) + 1e-12);
    for (const Vector3& vertex : hull.vertices) ASSERT_TRUE(has(points, vertex));
  }
}

/// For a polytope with few vertices every plane through three of them that has all on one side is
/// checked: exactly those bound it.
TEST(ReducedHull, ContainsEveryPointByAllFacets) {
  Random random;
  for (int i = 0; i < beeline::testing::cases(30); ++i) {
    Points corners, points;
    for (int k = random.integer(4, 12); k > 0; --k) corners.push_back(random.vector());
    for (int k = 0; k < 300; ++k) {
      Vector3 mean = Vector3::Zero();
      double total = 0;
      for (const Vector3& corner : corners) {
        const double weight = std::pow(random.uniform(0, 1), 8);
        mean += weight * corner;
        total += weight;
      }
      points.push_back(mean / total);
    }
    points.insert(points.end(), corners.begin(), corners.end());
    const ReducedHull hull = reduced_hull(points);
    const Points& v = hull.vertices;
    int facets = 0;
    for (std::size_t a = 0; a < v.size(); ++a) {
      for (std::size_t b = 0; b < v.size(); ++b) {
        for (std::size_t c = 0; c < v.size(); ++c) {
          const Vector3 normal = (v[b] - v[a]).cross(v[c] - v[a]);
          if (normal.norm() < 1e-6 || highest(v, normal) > normal.dot(v[a]) + 1e-12) continue;
          ++facets;
          const double outside = (highest(points, normal) - normal.dot(v[a])) / normal.norm();
          ASSERT_LE(outside, hull.growth + 1e-9);
        }
      }
    }
    EXPECT_GE(facets, 12) << "each of four facets in three orders";
    EXPECT_LT(hull.growth, 1e-12) << "all corners are extreme";
  }
}

TEST(ReducedHull, KeepsCornersAndNothingInside) {
  Random random;
  for (int i = 0; i < beeline::testing::cases(30); ++i) {
    const Vector3 size{random.uniform(0, 1), random.uniform(0, 1), i % 3 == 0 ? 0.0 : 1.0};
    Points points;
    for (int k = 0; k < 5000; ++k) {
      points.push_back(size.cwiseProduct(random.vector()));
    }
    for (int corner = 0; corner < 8; ++corner) {
      const Vector3 signs{corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0,
                          corner & 4 ? 1.0 : -1.0};
      points.push_back(size.cwiseProduct(signs));
    }
    const ReducedHull hull = reduced_hull(points);
    EXPECT_LT(hull.growth, 1e-12);
    for (const Vector3& vertex : hull.vertices) {
      EXPECT_EQ(vertex.cwiseAbs(), size) << "a corner of the box";
    }
  }
}

TEST(ReducedHull, OfTheSamePointsInAnyOrderIsTheSame) {
  Random random;
  for (int i = 0; i < beeline::testing::cases(12); ++i) {
    Points points = cloud(random, i % 6, 600);
    const ReducedHull hull = reduced_hull(points);
    for (std::size_t k = points.size() - 1; k > 0; --k) {
      std::swap(points[k],
                points[static_cast<std::size_t>(random.integer(0, static_cast<int>(k)))]);
    }
    points.insert(points.end(), points.begin(), points.begin() + 100);
    const ReducedHull again = reduced_hull(points);
    EXPECT_EQ(again.vertices, hull.vertices);
    EXPECT_EQ(again.growth, hull.growth);
  }
}

TEST(ReducedHull, OfPointsInOnePlaceOrOnALine) {
  Random random;
  const Vector3 place = random.vector(), along = random.direction();
  EXPECT_EQ(reduced_hull(Points(5000, place)).vertices, Points{place});
  Points line;
  for (int i = 0; i <= 1000; ++i) line.push_back(place + i * along);
  const ReducedHull hull = reduced_hull(line);
  EXPECT_LT(hull.growth, 1e-9);
  EXPECT_TRUE(has(hull.vertices, line.front()) && has(hull.vertices, line.back()));
}

/// A finely divided sphere needs more vertices than are kept: the growth says by how much.
TEST(ReducedHull, OfManyVerticesIsGrownByWhatItLacks) {
  Random random;
  Points points;
  for (int i = 0; i < beeline::testing::example_size(25'000); ++i)
    points.push_back(random.direction());
  const ReducedHull hull = reduced_hull(points);
  EXPECT_LE(hull.vertices.size(), 2000u);
  EXPECT_LE(beyond(points, hull, random), 1e-12);
  EXPECT_LT(hull.growth, 0.02);
}

}  // namespace
}  // namespace beeline::internal
