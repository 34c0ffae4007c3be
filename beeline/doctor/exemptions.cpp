#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string>

#include <beeline/collision/collision_model.h>
#include <beeline/doctor/diagnosis.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/internal/enum_names.h>
#include <beeline/inverse/numerical/bounds.h>

namespace beeline {
namespace {

constexpr double least_depth = 1e-6;  // m; less may be rounding
constexpr int starts = 5;             // of descents
constexpr int max_steps = 60;

/// A configuration with the distance of the two bodies there.
struct Approach {
  Configuration q;
  BodyDistance distance;
};

bool is_deeper(const Approach& a, const Approach& b) { return a.distance.lower < b.distance.lower; }

bool collides(const Approach& at) {
  return at.distance.lower < -least_depth && at.distance.upper < least_depth;
}

Approach approach(const CollisionModel& pair, Configuration q) {
  BodyDistance distance = nearest_pair(pair, q);
  return {std::move(q), std::move(distance)};
}

/// Descends along the gradient of the distance. Shorter steps follow one that leads away.
Approach descend(const CollisionModel& pair, Approach at, internal::BudgetMeter& budget) {
  const internal::Bounds limits = internal::bounds_of(pair.arm());
  double step = 0.2;  // of the largest coordinate, rad or m
  for (int i = 0; i < max_steps && step > 1e-4 && !budget.ended(); ++i) {
    const double steepest = at.distance.gradient.cwiseAbs().maxCoeff();
    if (!(steepest > 0)) break;
    const Configuration q = at.q - step / steepest * at.distance.gradient;
    Approach next = approach(pair, internal::clamped(limits, q));
    const bool is_nearer = is_deeper(next, at);
    step *= is_nearer ? 1.3 : 0.5;
    if (is_nearer) at = std::move(next);
  }
  return at;
}

/// Examines the two bodies of a model.
void examine(const CollisionModel& pair, int configurations, internal::BudgetMeter& budget,
             Exemption& found) {
  if (pair.pair_count() == 0) {
    if (pair.apart_count() > 0) found.status = ExemptionStatus::never_close;
    return;
  }
  std::mt19937_64 engine(20240229);
  std::vector<Approach> tried;
  for (int i = 0; i < configurations && !budget.ended(); ++i) {
    tried.push_back(approach(pair, random_configuration(pair.arm(), engine)));
  }
  const auto without_collision = [&budget] {
    return budget.complete() ? ExemptionStatus::no_collision
                             : internal::status_of<ExemptionStatus>(budget.ending());
  };
  found.status = without_collision();
  if (tried.empty()) return;
  const bool always = budget.complete() && std::all_of(tried.begin(), tried.end(), collides);
  const auto kept = std::min<std::ptrdiff_t>(starts, std::ssize(tried));
  std::partial_sort(tried.begin(), tried.begin() + kept, tried.end(), is_deeper);
  for (auto at = tried.begin(); at != tried.begin() + kept; ++at) {
    *at = descend(pair, std::move(*at), budget);
  }
  const Approach& deepest = *std::min_element(tried.begin(), tried.begin() + kept, is_deeper);
  found.status = without_collision();
  if (!collides(deepest)) return;
  found.status = always ? ExemptionStatus::always_collides : ExemptionStatus::collides;
  found.q = deepest.q;
  found.depth = -deepest.distance.lower;
}

template <class Body>
std::vector<Body> named(const std::vector<Body>& bodies, const NamedPair& names) {
  std::vector<Body> found;
  std::copy_if(bodies.begin(), bodies.end(), std::back_inserter(found),
               [&](const Body& body) { return body.name == names[0] || body.name == names[1]; });
  return found;
}

}  // namespace

std::string name(ExemptionStatus status) {
  constexpr internal::EnumNames<ExemptionStatus> names("exemption status");
  return names.of(status);
}

std::vector<Exemption> examine_exemptions(const Arm& arm, const std::vector<LinkShapes>& links,
                                          const Scene& scene, const std::vector<NamedPair>& pairs,
                                          const ExemptionOptions& options) {
  if (options.configurations < 1) {
    throw Error("", "configurations",
                " is " + std::to_string(options.configurations) + "; it must be 1 or more");
  }
  internal::BudgetMeter budget(options.budget);
  std::vector<Exemption> exemptions;
  std::set<NamedPair> examined;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const NamedPair& names = pairs[i];
    budget.report(static_cast<double>(i) / static_cast<double>(pairs.size()));
    const NamedPair in_order{std::min(names[0], names[1]), std::max(names[0], names[1])};
    if (!examined.insert(in_order).second) continue;
    const std::vector<LinkShapes> bodies = named(links, names);
    const Scene obstacles{.obstacles = named(scene.obstacles, names)};
    if (bodies.size() + obstacles.obstacles.size() != 2) continue;
    Exemption found{.names = names};
    if (!bodies.empty()) {
      // A small clearance, because bodies that only come close may be exempted.
      const CollisionOptions of_pair{.clearance = least_depth};
      const CollisionModel pair(arm, bodies, obstacles, of_pair);
      examine(pair, options.configurations, budget, found);
    }
    exemptions.push_back(std::move(found));
  }
  return exemptions;
}

}  // namespace beeline
