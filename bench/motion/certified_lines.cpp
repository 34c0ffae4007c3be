// Usage: bench_certified_lines ARM [LINES]
//
// Random lines of 0.1 to 0.8 m with rotations of up to 90 degrees from random poses of an arm: each
// line that an independent dense search finds feasible must be solved, every other one refused for
// the reason that the search finds too. Solved lines are measured at 10,000 points and verified.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <map>

#include <beeline/certificate/verify.h>
#include <beeline/model/catalog.h>
#include <beeline/planning/move_along.h>

#include <tests/planning/dense_search.h>

using namespace beeline;
using namespace beeline::testing;

namespace {

struct Tally {
  int solved = 0, missed = 0, refused = 0, wrong = 0, early = 0, unverified = 0, broken = 0,
      fast = 0;
  int undecided = 0;  ///< the dense search succeeds, but its solution cannot be followed
  double position_ratio = 0, orientation_ratio = 0, samples = 0;
  std::vector<double> position_ratios, orientation_ratios, times_solved, times_refused;
  std::map<std::string, int> statuses;
};

/// Returns the deviation of the tool from the line, independent of deviation_from().
Deviation off_segment(const Line& line, const Pose& pose) {
  const Vector3 way = line.to.translation() - line.from.translation();
  const Vector3 done = pose.translation() - line.from.translation();
  const double s = std::clamp(done.dot(way) / way.squaredNorm(), 0.0, 1.0);
  const Vector3 turn = so3_log(line.to.linear() * line.from.linear().transpose());
  const Rotation there = so3_exp(s * turn) * line.from.linear();
  return {(done - s * way).norm(), so3_log(pose.linear() * there.transpose()).norm()};
}

/// Returns the fraction of the line named in a refusal; -1 when there is none.
double told_fraction(const PathMotion& motion) {
  const ReasonValue* const fraction = motion.reason.find(ReasonField::fraction);
  return fraction == nullptr ? -1 : std::get<double>(*fraction);
}

/// Whether a reason names a joint that would pass a limit.
bool names(const Reason& reason, const std::string& joint) {
  const ReasonValue* const named = reason.find(ReasonField::joint);
  return (named != nullptr && std::get<std::string>(*named) == joint) ||
         std::any_of(reason.details.begin(), reason.details.end(),
                     [&](const Reason& detail) { return names(detail, joint); });
}

/// CPU time, which does not depend on other load.
double seconds_of(const auto& work) {
  const std::clock_t begin = std::clock();
  work();
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

void measure(const Arm& arm, const Line& line, const PathMotion& motion, int number, Tally& tally) {
  const auto& positions = motion.trajectory.positions;
  const auto& times = motion.trajectory.times;
  const auto steps = static_cast<int>(positions.size()) - 1;
  const int parts = std::max(2, (10'000 + steps - 1) / steps);
  Deviation worst;
  for (std::size_t k = 0; k + 1 < positions.size(); ++k) {
    const Configuration step = positions[k + 1] - positions[k];
    for (int i = 0; i <= parts; ++i) {
      const Pose pose = forward_kinematics(arm, positions[k] + double(i) / parts * step);
      const Deviation off = off_segment(line, pose);
      worst.position = std::max(worst.position, off.position);
      worst.orientation = std::max(worst.orientation, off.orientation);
    }
    for (int j = 0; j < arm.dof(); ++j) {
      const double limit = arm.limits(j).velocity;
      const double most = std::isfinite(limit) ? limit : assumed_velocity_limit;
      if (std::abs(step[j]) > most * (times[k + 1] - times[k]) * (1 + 1e-6)) {
        ++tally.fast;
        std::printf("  %d: joint %d too fast after sample %zu\n", number, j + 1, k);
      }
    }
  }
  const Deviation& bound = motion.deviation.bound;
  if (worst.position > bound.position + 1e-12 || worst.orientation > bound.orientation + 1e-12) {
    ++tally.broken;
    std::printf("  %d: BOUND BROKEN %g > %g or %g > %g\n", number, worst.position, bound.position,
                worst.orientation, bound.orientation);
  }
  tally.position_ratios.push_back(bound.position / worst.position);
  if (worst.orientation > 1e-7) {
    tally.orientation_ratios.push_back(bound.orientation / worst.orientation);
  }
  if (tally.position_ratios.back() > 3 || bound.orientation / worst.orientation > 3) {
    std::printf(
        "  %d: loose: position %g / %g, orientation %g / %g, %d samples, inverse condition number "
        "%g\n",
        number, bound.position, worst.position, bound.orientation, worst.orientation, steps + 1,
        motion.inverse_condition);
  }
}

/// Returns whether the arm has a configuration for the line's pose at s, with or without limits.
bool reachable(const Arm& arm, const Line& line, double s, bool limits) {
  const InverseResult result =
      inverse_kinematics(arm, interpolate(line.from, line.to, std::clamp(s, 0.0, 1.0)),
                         {.all = true, .ignore_limits = !limits, .grid = 256});
  return result.status == InverseStatus::solved;
}

void judge_refusal(const Arm& arm, const Line& line, const PathMotion& motion, int number,
                   Tally& tally) {
  const bool spare = arm.dof() == 7;
  const DenseAnswer dense =
      spare ? dense_layers(arm, line.from, line.to) : dense_branches(arm, line.from, line.to);
  const double told = told_fraction(motion);
  const auto print = [&](const char* what) {
    std::printf("  %d: %s: dense %.6f joint %d margin %.2g; told %.6f %s: %s\n", number, what,
                dense.reached, dense.joint + 1, dense.margin, told, name(motion.status).c_str(),
                sentence(motion.reason).c_str());
  };
  if (dense.feasible() && spare) {
    if (can_follow(arm, line, dense.way)) {
      ++tally.missed;
      return print("MISSED");
    }
    ++tally.undecided;
    return print("undecided");
  }
  if (dense.feasible()) {
    ++(dense.margin > 1e-6 ? tally.missed : tally.undecided);
    return print("MISSED");
  }
  ++tally.refused;
  const double place = spare ? told : dense.reached;
  if (told < dense.reached - (spare ? 0.02 : 2e-3)) {
    ++tally.early;
    print("EARLY");
  }
  bool right = false;
  if (motion.status == MotionStatus::unreachable) {
    right =
        !reachable(arm, line, place + 1e-3, false) || !reachable(arm, line, place + 1e-5, false);
  } else if (motion.status == MotionStatus::outside_limits) {
    right = spare ? reachable(arm, line, told + 1e-4, false)
                  : dense.joint >= 0 && names(motion.reason, arm.joint_of(dense.joint).name);
  } else if (motion.status == MotionStatus::singular) {
    right = reachable(arm, line, place + 1e-3, spare) && dense.joint < 0;
  }
  if (right) return;
  ++tally.wrong;
  print("WRONG REASON");
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

}  // namespace

int main(int argc, char** argv) {
  const Arm arm = built_in(argc > 1 ? argv[1] : "panda");
  const int lines = argc > 2 ? std::stoi(argv[2]) : 1000;
  Random random;
  Tally tally;
  for (int i = 0; i < lines; ++i) {
    const Line line = random_certified_line(random, arm);
    const std::vector<Pose> poses{line.from, line.to};
    PathMotion motion;
    const double seconds = seconds_of([&] { motion = move_in_lines(arm, poses); });
    ++tally.statuses[name(motion.status)];
    if (motion.status == MotionStatus::reached) {
      ++tally.solved;
      tally.samples += static_cast<double>(motion.trajectory.size());
      tally.times_solved.push_back(seconds);
      measure(arm, line, motion, i, tally);
      const Verification proof = verify(arm, motion.trajectory, poses);
      if (proof.fault != Fault::none) {
        ++tally.unverified;
        std::printf("  %d: not verified: %s\n", i, sentence(proof.reason).c_str());
      }
    } else {
      tally.times_refused.push_back(seconds);
      judge_refusal(arm, line, motion, i, tally);
    }
    std::fflush(stdout);
  }
  const auto ms = [](const std::vector<double>& times, double share) {
    return 1e3 * quantile(times, share);
  };
  std::printf(
      "%s: %d lines, feasible %d, solved %d, missed %d, undecided %d, refused %d, of these "
      "wrongly reasoned %d, stopped early %d\n",
      arm.name().c_str(), lines, tally.solved + tally.missed, tally.solved, tally.missed,
      tally.undecided, tally.refused, tally.wrong, tally.early);
  for (const auto& [status, count] : tally.statuses) {
    std::printf("  %s %d", status.c_str(), count);
  }
  std::printf("\n  bounds broken %d, too fast %d, not verified %d\n", tally.broken, tally.fast,
              tally.unverified);
  for (const auto& [what, ratios] :
       {std::pair{"position", tally.position_ratios}, {"orientation", tally.orientation_ratios}}) {
    std::printf("  %s bound / measured: mean %.2f, 99 %% %.2f, worst %.2f\n", what, mean(ratios),
                quantile(ratios, 0.99), quantile(ratios, 1));
  }
  std::printf(
      "  samples %.1f; ms solved: mean %.2f, 99 %% %.2f, most %.2f; refused: mean %.2f, "
      "99 %% %.2f, most %.2f\n",
      tally.samples / std::max(1, tally.solved), 1e3 * mean(tally.times_solved),
      ms(tally.times_solved, 0.99), ms(tally.times_solved, 1), 1e3 * mean(tally.times_refused),
      ms(tally.times_refused, 0.99), ms(tally.times_refused, 1));
}
