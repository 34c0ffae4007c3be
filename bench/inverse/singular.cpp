// Counts the poses that are reachable within limits by construction and that inverse kinematics
// does not answer: poses of configurations with joints at special angles, exactly or nearly, and at
// their limits. Exit code 1 if an answer is wrong or a reason false.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>

#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/kinematics/forward.h>
#include <beeline/read/arm.h>

#include "poses.h"

namespace beeline::bench {
namespace {

constexpr double pi = std::numbers::pi;

enum class Kind {
  exact,
  some_exact,
  nearly,
  some_nearly,
  seven_decimals,
  at_limits,
  at_limits_and_exact
};
constexpr std::array<const char*, 7> kind_names{
    "exact",     "some exact",         "nearly", "one or two nearly", "seven decimals",
    "at limits", "at limits and exact"};

struct Range {
  double lower, upper;
  bool slides;
};

std::vector<Range> ranges_of(const Arm& arm) {
  std::vector<Range> ranges;
  for (int k = 0; k < arm.dof(); ++k) {
    const bool slides = kind(arm.joint_of(k)) == JointKind::prismatic;
    const double far = slides ? 1 : pi;
    const Limits& limits = arm.limits(k);
    ranges.push_back({std::isfinite(limits.lower) ? limits.lower : -far,
                      std::isfinite(limits.upper) ? limits.upper : far, slides});
  }
  return ranges;
}

/// Returns a multiple of a right angle, or seldom of 30 or 45 degrees.
double special_angle(Engine& engine) {
  if (uniform(engine, 0, 1) < 0.4) return 0;
  const double unit = uniform(engine, 0, 1) < 0.8   ? pi / 2
                      : uniform(engine, 0, 1) < 0.5 ? pi / 4
                                                    : pi / 6;
  return unit * std::round(uniform(engine, -pi, pi) / unit);
}

/// Returns 0, or 1e-15 to 1e-5 with random sign.
double deviation(Engine& engine) {
  const double power = std::floor(uniform(engine, -16, -4));
  if (power < -15) return 0;
  return std::pow(10.0, power) * (uniform(engine, 0, 1) < 0.5 ? -1 : 1);
}

double special_value(const Range& range, Engine& engine) {
  for (int i = 0; i < 20; ++i) {
    const double value = range.slides ? 0 : special_angle(engine);
    if (value >= range.lower && value <= range.upper) return value;
  }
  return uniform(engine, range.lower, range.upper);
}

Configuration configuration(const std::vector<Range>& ranges, Kind kind, Engine& engine) {
  Configuration q(ranges.size());
  const bool limits = kind == Kind::at_limits || kind == Kind::at_limits_and_exact;
  const double fraction = kind == Kind::some_nearly  ? 1.5 / static_cast<double>(ranges.size())
                          : kind == Kind::some_exact ? 0.4
                          : kind == Kind::at_limits  ? 0
                          : limits                   ? 0.5
                                                     : 0.7;
  for (std::size_t k = 0; k < ranges.size(); ++k) {
    const Range& range = ranges[k];
    double value = uniform(engine, range.lower, range.upper);
    if (limits && uniform(engine, 0, 1) < 0.5) {
      value = uniform(engine, 0, 1) < 0.5 ? range.lower : range.upper;
    } else if (uniform(engine, 0, 1) < fraction) {
      value = special_value(range, engine);
      if (kind == Kind::nearly || kind == Kind::some_nearly) value += deviation(engine);
      if (kind == Kind::seven_decimals) value = std::round(value * 1e7) / 1e7;
    }
    q[static_cast<Eigen::Index>(k)] = std::clamp(value, range.lower, range.upper);
  }
  return q;
}

struct Tally {
  long poses = 0, unanswered = 0, false_reasons = 0, wrong = 0;
  double seconds = 0, slowest = 0;
};

bool claims_impossible(const InverseResult& result) {
  return result.status == InverseStatus::unreachable ||
         result.status == InverseStatus::orientation_unreachable ||
         result.reason.starts_with("every solution");
}

void print(const Configuration& q) {
  for (int k = 0; k < q.size(); ++k) std::fprintf(stderr, "%s%.17g", k ? "," : "", q[k]);
  std::fprintf(stderr, "\n");
}

}  // namespace
}  // namespace beeline::bench

int main(int argc, char** argv) {
  using namespace beeline;
  using namespace beeline::bench;
  CLI::App app("Counts hard poses without an answer");
  std::vector<std::string> names;
  long count = 1000;
  std::uint64_t seed = 20261123;
  int lock = -1;
  bool each = false;
  app.add_option("arms", names, "built-in names or files")->required();
  app.add_option("--count", count, "poses of each kind and arm");
  app.add_option("--random-seed", seed);
  app.add_option("--lock", lock, "lock this coordinate at the configuration's value");
  app.add_flag("--each", each, "print each configuration that is not answered");
  CLI11_PARSE(app, argc, argv);
  std::printf(
      "| arm | kind | poses | unanswered | false reason | wrong | us | slowest ms "
      "|\n|---|---|---|---|---|---|---|---|\n");
  Tally all;
  for (const std::string& name : names) {
    const Arm arm = read_arm(name);
    const std::vector<Range> ranges = ranges_of(arm);
    InverseOptions options;
    if (lock >= 0) options.lock = lock;
    InverseSolver solver(arm, options);
    for (std::size_t kind = 0; kind < kind_names.size(); ++kind) {
      Engine engine(seed);
      Tally tally;
      for (long n = 0; n < count; ++n) {
        const Configuration q = configuration(ranges, static_cast<Kind>(kind), engine);
        const Pose pose = forward_kinematics(arm, q);
        const auto begin = std::chrono::steady_clock::now();
        Configuration from = middle_configuration(arm);
        if (lock >= 0) from[lock] = q[lock];
        const InverseResult result = solver.solve(pose, from);
        const double took =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        tally.seconds += took;
        tally.slowest = std::max(tally.slowest, took);
        ++tally.poses;
        if (!result) {
          ++tally.unanswered;
          if (claims_impossible(result)) ++tally.false_reasons;
          if (each) {
            std::fprintf(stderr, "%s, %s: %s: %s\n  ", arm.name().c_str(), kind_names[kind],
                         beeline::name(result.status).c_str(), result.reason.c_str());
            print(q);
          }
          continue;
        }
        const Deviation error =
            task_deviation(default_task(arm), pose, forward_kinematics(arm, result.solutions[0]));
        bool bad = !(std::max(error.position, error.orientation) <= 1e-10);
        for (int k = 0; k < q.size(); ++k) {
          const Limits& limits = arm.limits(k);
          bad = bad ||
                !(result.solutions[0][k] >= limits.lower && result.solutions[0][k] <= limits.upper);
        }
        tally.wrong += bad;
      }
      std::printf("| %s | %s | %ld | %ld | %ld | %ld | %.1f | %.1f |\n", arm.name().c_str(),
                  kind_names[kind], tally.poses, tally.unanswered, tally.false_reasons, tally.wrong,
                  1e6 * tally.seconds / static_cast<double>(tally.poses), 1e3 * tally.slowest);
      std::fflush(stdout);
      all.poses += tally.poses;
      all.unanswered += tally.unanswered;
      all.false_reasons += tally.false_reasons;
      all.wrong += tally.wrong;
    }
  }
  std::printf("| all | | %ld | %ld | %ld | %ld | | |\n", all.poses, all.unanswered,
              all.false_reasons, all.wrong);
  return all.false_reasons + all.wrong > 0;
}
