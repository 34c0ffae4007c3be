#include <algorithm>
#include <random>

#include <beeline/internal/random_fraction.h>
#include <beeline/path/joint_path.h>
#include <beeline/planning/internal/shortened_path.h>

namespace beeline::internal {
namespace {

constexpr double equal = 1e-9;       // distance of waypoints that are one
constexpr double worthwhile = 1e-3;  // fraction of the length that a shortcut saves at least

/// A place on a path: on the motion from waypoint `segment` to the next.
struct PlaceOnPath {
  std::size_t segment = 0;
  Configuration q;
};

/// The place at a distance along the path.
PlaceOnPath place_at(const std::vector<Configuration>& waypoints, double distance) {
  for (std::size_t k = 0; k + 2 < waypoints.size(); ++k) {
    const double length = (waypoints[k + 1] - waypoints[k]).norm();
    if (distance < length) {
      return {k, waypoints[k] + distance / length * (waypoints[k + 1] - waypoints[k])};
    }
    distance -= length;
  }
  const Configuration& from = waypoints[waypoints.size() - 2];
  const Configuration change = waypoints.back() - from;
  return {waypoints.size() - 2, from + std::min(1.0, distance / change.norm()) * change};
}

bool passes(FreeEdges& edges, EdgeTest test, const Configuration& a, const Configuration& b) {
  return test == EdgeTest::samples ? edges.seems_free(a, b) : edges.is_free(a, b);
}

/// From each waypoint goes on to the farthest one to which the straight motion passes the test.
void leave_out(FreeEdges& edges, EdgeTest test, std::vector<Configuration>& waypoints) {
  std::vector<Configuration> kept{waypoints.front()};
  for (std::size_t k = 0; k + 1 < waypoints.size();) {
    std::size_t next = waypoints.size() - 1;
    while (next > k + 1 && !passes(edges, test, waypoints[k], waypoints[next])) {
      next = k + (next - k) / 2;  // halving: a few motions for each waypoint
    }
    if ((waypoints[next] - kept.back()).norm() <= equal && kept.size() > 1) kept.pop_back();
    kept.push_back(waypoints[next]);
    k = next;
  }
  waypoints = std::move(kept);
}

}  // namespace

void shorten(FreeEdges& edges, EdgeTest test, std::uint64_t random_seed, int shortcuts,
             std::vector<Configuration>& waypoints) {
  leave_out(edges, test, waypoints);
  std::mt19937_64 engine(random_seed);
  double length = chord_length(waypoints).back();
  for (int i = 0; i < shortcuts && waypoints.size() > 2 && !edges.ended(); ++i) {
    double first = length * random_fraction(engine), second = length * random_fraction(engine);
    if (second < first) std::swap(first, second);
    const PlaceOnPath a = place_at(waypoints, first), b = place_at(waypoints, second);
    const double saved = second - first - (b.q - a.q).norm();
    if (a.segment == b.segment || saved < worthwhile * length) continue;
    if (!passes(edges, test, a.q, b.q)) continue;
    const auto at = [&](std::size_t k) {
      return waypoints.begin() + static_cast<std::ptrdiff_t>(k);
    };
    const auto after = waypoints.erase(at(a.segment + 1), at(b.segment + 1));
    waypoints.insert(after, {a.q, b.q});
    length -= saved;
  }
  leave_out(edges, test, waypoints);
}

}  // namespace beeline::internal
