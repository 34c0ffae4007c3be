// Counts the poses that are reachable within limits by construction and that inverse kinematics
// does not answer: poses of configurations with joints at special angles, exactly or nearly, and at
// their limits. Exit code 1 if an answer is wrong or a reason is false.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>

#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/io/text/arm.h>
#include <beeline/kinematics/forward.h>

#include "poses.h"

namespace beeline::bench {
namespace {

constexpr double pi = std::numbers::pi;

/// A kind of configurations.
struct Kind {
  const char* name;
  double special;       ///< probability that a value is a special angle
  double at_limit = 0;  ///< probability that one of the others is at a limit
  bool deviates = false;
  bool seven_decimals = false;
};
constexpr Kind kinds[] = {
    {.name = "exact", .special = 0.7},
    {.name = "some exact", .special = 0.4},
    {.name = "nearly", .special = 0.7, .deviates = true},
    {.name = "some nearly", .special = 0.2, .deviates = true},
    {.name = "seven decimals", .special = 0.7, .seven_decimals = true},
    {.name = "at limits", .special = 0, .at_limit = 0.5},
    {.name = "at limits and exact", .special = 0.25, .at_limit = 0.7},
};

struct Run {
  std::vector<std::string> arms;
  long count = 1000;
  std::uint64_t seed = 20261123;
  int lock = -1;
  bool each = false;
};

struct Tally {
  long poses = 0, unanswered = 0, false_reasons = 0, wrong = 0;
  double seconds = 0, slowest = 0;
};

bool happens(double probability, Engine& engine) { return uniform(engine, 0, 1) < probability; }

/// Returns 0 or a multiple of a right angle, seldom of 30 or 45 degrees.
double special_angle(Engine& engine) {
  if (happens(0.4, engine)) return 0;
  const double unit = happens(0.8, engine) ? pi / 2 : happens(0.5, engine) ? pi / 4 : pi / 6;
  return unit * std::round(uniform(engine, -pi, pi) / unit);
}

/// Returns 0, or 1e-15 to 1e-5 with random sign.
double deviation(Engine& engine) {
  const double power = std::floor(uniform(engine, -16, -4));
  if (power < -15) return 0;
  return std::pow(10.0, power) * (happens(0.5, engine) ? -1 : 1);
}

double value_of(const Arm& arm, int k, const Kind& kind_of_value, Engine& engine) {
  const bool slides = kind(arm.joint_of(k)) == JointKind::prismatic;
  const double far = slides ? 1 : pi;
  const Limits& limits = arm.limits(k);
  const double lower = std::isfinite(limits.lower) ? limits.lower : -far;
  const double upper = std::isfinite(limits.upper) ? limits.upper : far;
  double value = uniform(engine, lower, upper);
  if (happens(kind_of_value.special, engine)) {
    const double special = slides ? 0 : special_angle(engine);
    if (special >= lower && special <= upper) value = special;
    if (kind_of_value.deviates) value += deviation(engine);
    if (kind_of_value.seven_decimals) value = std::round(value * 1e7) / 1e7;
  } else if (happens(kind_of_value.at_limit, engine)) {
    value = happens(0.5, engine) ? lower : upper;
  }
  return std::clamp(value, lower, upper);
}

bool claims_impossible(const InverseResult& result) {
  return result.status == InverseStatus::unreachable ||
         result.status == InverseStatus::orientation_unreachable ||
         result.reason.code == ReasonCode::all_solutions_outside_limits;
}

bool is_wrong(const Arm& arm, const Pose& pose, const Configuration& q) {
  const Deviation error = task_deviation(default_task(arm), pose, forward_kinematics(arm, q));
  if (!(std::max(error.position, error.orientation) <= 1e-10)) return true;
  for (int k = 0; k < arm.dof(); ++k) {
    if (!(q[k] >= arm.limits(k).lower && q[k] <= arm.limits(k).upper)) return true;
  }
  return false;
}

void print_unanswered(const Arm& arm, const Kind& kind, const InverseResult& result,
                      const Configuration& q) {
  std::fprintf(stderr, "%s, %s: %s: %s\n  ", arm.name().c_str(), kind.name,
               name(result.status).c_str(), sentence(result.reason).c_str());
  for (int k = 0; k < q.size(); ++k) std::fprintf(stderr, "%s%.17g", k > 0 ? "," : "", q[k]);
  std::fprintf(stderr, "\n");
}

Tally tally_of(const Arm& arm, const Kind& kind, const Run& run) {
  Engine engine(run.seed);
  Tally tally;
  for (; tally.poses < run.count; ++tally.poses) {
    Configuration q(arm.dof()), seed = middle_configuration(arm);
    for (int k = 0; k < arm.dof(); ++k) q[k] = value_of(arm, k, kind, engine);
    InverseOptions options;
    if (run.lock >= 0) {
      options.lock = run.lock;
      seed[run.lock] = q[run.lock];
    }
    options.seed = seed;
    const Pose pose = forward_kinematics(arm, q);
    const auto begin = std::chrono::steady_clock::now();
    const InverseResult result = inverse_kinematics(arm, pose, options);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    tally.seconds += took.count();
    tally.slowest = std::max(tally.slowest, took.count());
    if (result) {
      tally.wrong += is_wrong(arm, pose, result.solutions.front());
      continue;
    }
    ++tally.unanswered;
    tally.false_reasons += claims_impossible(result);
    if (run.each) print_unanswered(arm, kind, result, q);
  }
  return tally;
}

/// Returns the sums over all arms.
Tally tally_all(const Run& run) {
  Tally all;
  for (const std::string& name : run.arms) {
    const Arm arm = read_arm(name);
    for (const Kind& kind : kinds) {
      const Tally t = tally_of(arm, kind, run);
      std::printf("| %s | %s | %ld | %ld | %ld | %ld | %.1f | %.1f |\n", arm.name().c_str(),
                  kind.name, t.poses, t.unanswered, t.false_reasons, t.wrong,
                  1e6 * t.seconds / static_cast<double>(t.poses), 1e3 * t.slowest);
      std::fflush(stdout);
      all.poses += t.poses;
      all.unanswered += t.unanswered;
      all.false_reasons += t.false_reasons;
      all.wrong += t.wrong;
    }
  }
  return all;
}

}  // namespace
}  // namespace beeline::bench

int main(int argc, char** argv) {
  using namespace beeline::bench;
  CLI::App app("Counts poses at singularities and limits that are not answered");
  Run run;
  app.add_option("arms", run.arms, "built-in names or files")->required();
  app.add_option("--count", run.count, "poses of each kind and arm")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_option("--random-seed", run.seed)->capture_default_str();
  app.add_option("--lock", run.lock, "coordinate, from 0, that keeps its value");
  app.add_flag("--each", run.each, "prints each configuration that is not answered");
  CLI11_PARSE(app, argc, argv);
  try {
    std::printf(
        "| arm | kind | poses | unanswered | false reason | wrong | us | slowest, ms |\n"
        "|---|---|---|---|---|---|---|---|\n");
    const Tally all = tally_all(run);
    std::printf("| all | | %ld | %ld | %ld | %ld | | |\n", all.poses, all.unanswered,
                all.false_reasons, all.wrong);
    return all.false_reasons + all.wrong == 0 ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_inverse_singular: %s\n", error.what());
    return 2;
  }
}
