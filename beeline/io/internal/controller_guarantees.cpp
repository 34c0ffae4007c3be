#include <algorithm>
#include <cmath>
#include <functional>

#include <beeline/certificate/verify.h>
#include <beeline/io/internal/controller_guarantees.h>
#include <beeline/trajectory/internal/append.h>
#include <beeline/trajectory/internal/interval_polynomial.h>

namespace beeline::internal {
namespace {

/// A limit of the joints, and the fault of a motion that exceeds it.
struct LimitKind {
  const char* name;
  Fault fault;
  int order;  ///< of the derivative
  double Limits::*limit;
};

constexpr LimitKind rates[] = {{"velocity", Fault::velocity, 1, &Limits::velocity},
                               {"acceleration", Fault::acceleration, 2, &Limits::acceleration},
                               {"jerk", Fault::jerk, 3, &Limits::jerk}};

/// "velocity, acceleration and jerk".
std::string in_words(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  }
  return text;
}

/// The trajectory as the file has it: ROS holds times in whole nanoseconds.
Trajectory written(const Trajectory& samples, ControllerForm form) {
  Trajectory result = samples;
  if (form != ControllerForm::ros2) {
    result.velocities.clear();
    result.accelerations.clear();
    return result;
  }
  for (double& time : result.times) time = round_to_nanoseconds(time);
  const bool in_order = std::adjacent_find(result.times.begin(), result.times.end(),
                                           std::greater_equal<>()) == result.times.end();
  return in_order ? result : samples;  // what follows refuses equal times
}

/// The arm with the limits that it has; those that verify() would assume are out of reach.
Arm with_known_limits(const Arm& arm) {
  std::map<std::string, LimitOverrides> none;
  for (int k = 0; k < arm.dof(); ++k) {
    const Limits& limits = arm.limits(k);
    LimitOverrides& overrides = none[arm.joint_of(k).name];
    if (!(limits.velocity < Limits::none)) overrides.velocity = Limits::max_rate;
    if (!(limits.acceleration < Limits::none)) overrides.acceleration = Limits::max_rate;
  }
  return with_limits(arm, none);
}

const FaultsOfKind* found(const Verification& verification, Fault kind) {
  for (const FaultsOfKind& faults : verification.faults) {
    if (faults.kind == kind) return &faults;
  }
  return nullptr;
}

/// The joints without a limit of this kind: all, some by name, or none.
std::string joints_without(const Arm& arm, double Limits::*limit) {
  std::vector<std::string> names;
  for (int k = 0; k < arm.dof(); ++k) {
    if (!(arm.limits(k).*limit < Limits::none)) names.push_back(arm.joint_of(k).name);
  }
  if (names.empty()) return "";
  if (static_cast<int>(names.size()) == arm.dof()) return "the arm has none";
  return (names.size() == 1 ? "joint " + names.front() + " has none"
                            : "joints " + listed(names) + " have none");
}

/// Names of limits with the same cause for which they are not proved.
struct NotProved {
  std::vector<std::string> names;
  std::string why;
};

void add(std::vector<NotProved>& list, const char* name, const std::string& why) {
  const auto same = std::find_if(list.begin(), list.end(),
                                 [&](const NotProved& entry) { return entry.why == why; });
  if (same == list.end()) {
    list.push_back({{name}, why});
  } else {
    same->names.emplace_back(name);
  }
}

/// Whether all times are doubles nearest to whole nanoseconds, as ROS holds them.
bool in_whole_nanoseconds(const Trajectory& trajectory) {
  return std::all_of(trajectory.times.begin(), trajectory.times.end(),
                     [](double time) { return round_to_nanoseconds(time) == time; });
}

std::string polynomials(const Trajectory& trajectory) {
  if (trajectory.velocities.empty()) return "straight lines";
  return trajectory.accelerations.empty() ? "cubic polynomials" : "quintic polynomials";
}

std::string ros2_proof(const Trajectory& samples, const std::string& limits, bool resampled) {
  const std::string plays =
      "; a joint_trajectory_controller with its default interpolation method plays the " +
      polynomials(samples) + " between these points";
  const std::string check = "; `beeline check` of a .json export proves its path";
  if (resampled) {
    return limits + plays + ", which differ from the trajectory's" + check;
  }
  if (!in_whole_nanoseconds(samples)) {
    return limits + plays + ", the trajectory's with times rounded to nanoseconds" + check;
  }
  return limits + ", and what `beeline check` proves of the trajectory" + plays +
         ", the same motion as the trajectory";
}

/// The guarantee of a form that does not carry the motion between the samples.
std::string samples_proof(ControllerForm form, const std::string& within) {
  switch (form) {
    case ControllerForm::urscript:
      return "the setpoints" + within +
             "; the controller interpolates and filters them (lookahead_time, gain), and follows "
             "with a delay";
    case ControllerForm::rapid:
      return "only the positions of the samples" + within +
             "; the controller plans the motion between them again and rounds those at which it "
             "does not stop (zone z1)";
    case ControllerForm::krl:
      return "only the positions of the samples" + within +
             "; the controller plans the motion between them again, at 10 % speed, and rounds "
             "those with C_PTP";
    default:
      return "the setpoints" + within + "; the motion between them is the controller's";
  }
}

/// Returns the first limit in time that the arm has and the motion exceeds: of position, and of
/// derivatives up to this order.
Reason first_excess(const Verification& known, int order) {
  for (const FaultsOfKind& faults : known.faults) {
    if (faults.kind == Fault::limits) return faults.first;
    for (const LimitKind& rate : rates) {
      if (faults.kind == rate.fault && rate.order <= order) return faults.first;
    }
  }
  return {};
}

/// The beginning outside the limits. Between the samples it holds for motions that are played.
std::string recovery_sentence(const Recovery& recovery) {
  return "joint " + recovery.joint + " starts outside its limits by " + number(recovery.excess) +
         "; all joints have returned at " + number(recovery.time) + " s and stay within them";
}

void append_rest(const Arm& arm, const Trajectory& trajectory,
                 std::vector<std::string>& not_proved) {
  const Verification ends = verify(arm, trajectory);
  if (const FaultsOfKind* const moving = found(ends, Fault::moving)) {
    not_proved.push_back("rest at the ends: " + sentence(moving->worst));
  }
  if (const FaultsOfKind* const flip = found(ends, Fault::flip)) {
    not_proved.push_back("the direction of rotation: " + sentence(flip->worst));
  }
}

}  // namespace

ControllerGuarantees guarantees_of(const Arm& arm, const Trajectory& given,
                                   const Trajectory& samples, ControllerForm form, bool resampled,
                                   const ControllerFileOptions& options) {
  const Trajectory trajectory = written(samples, form);
  const bool plays = form == ControllerForm::ros2;
  const int carried = plays ? bounded_order(trajectory.interpolation()) : 0;
  const Arm limited = with_known_limits(arm);
  const VerifyOptions verifying{.moving = {true, true},
                                .limit_tolerance = options.limit_tolerance,
                                .recover = options.recover};
  const Verification known = verify(limited, trajectory, verifying);
  ControllerGuarantees result;
  if (!options.ignore_limits) {
    // Limits that only other samples of a good trajectory exceed are named, not refused.
    result.refusal = first_excess(verify(limited, given, verifying), carried);
    if (!result.refusal) result.refusal = first_excess(known, 0);
  }
  std::vector<std::string> kept;
  std::vector<NotProved> others;
  if (const FaultsOfKind* const outside = found(known, Fault::limits)) {
    add(others, "position", sentence(outside->worst));
  } else if (known.recovery) {
    add(others, "position", recovery_sentence(*known.recovery));
  } else {
    kept.emplace_back("position");
  }
  for (const LimitKind& rate : rates) {
    const std::string without = joints_without(arm, rate.limit);
    const FaultsOfKind* const excess = found(known, rate.fault);
    if (!plays) {
      add(others, rate.name, "the motion between the samples is the controller's");
    } else if (excess != nullptr) {
      add(others, rate.name, sentence(excess->worst));
    } else if (!without.empty()) {
      add(others, rate.name, without);
    } else if (rate.order > carried) {
      add(others, rate.name, "not bounded by " + polynomials(trajectory));
    } else {
      kept.emplace_back(rate.name);
    }
  }
  for (const NotProved& entry : others) {
    result.not_proved.push_back("limits of " + in_words(entry.names) + ": " + entry.why);
  }
  if (plays) append_rest(arm, trajectory, result.not_proved);
  const bool within = !kept.empty() && kept.front() == std::string("position");
  result.proof =
      plays ? ros2_proof(
                  samples,
                  kept.empty() ? "the points" : "the limits of " + in_words(kept) + " at all times",
                  resampled)
            : samples_proof(form, within ? ", within the limits of position" : "");
  return result;
}

}  // namespace beeline::internal
