#include <algorithm>

#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/internal/tool_motion.h>
#include <beeline/math/minimum_norm.h>
#include <beeline/math/polynomial.h>
#include <beeline/path/internal/following.h>
#include <beeline/path/joint_path.h>
#include <beeline/planning/internal/timed_plan.h>
#include <beeline/timing/internal/section.h>
#include <beeline/trajectory/internal/append.h>

namespace beeline::internal {
namespace {

/// The samples from one stop to the next.
struct Section {
  std::vector<Configuration> samples;
  std::vector<double> path_parameters;
};

/// Adds segment i of a branch to the section. Of samples at one position only the last is kept: the
/// path is at rest there in the task's rows.
void add(Section& section, const TrackedSegment& segment, std::size_t i) {
  constexpr double still = 1e-12;  // radians or metres
  for (std::size_t k = 1; k < segment.samples.size(); ++k) {
    const bool moves = (segment.samples[k] - section.samples.back()).norm() > still;
    if (moves) {
      section.samples.push_back(segment.samples[k]);
      section.path_parameters.push_back(0);
    }
    section.path_parameters.back() = static_cast<double>(i) + segment.fractions[k];
  }
  // A segment at rest has no sample of its own.
  section.path_parameters.back() = static_cast<double>(i + 1);
}

/// The joint path of a section: quintics between samples of the branch, at which the tool has the
/// path's position, tangent and curvature. Samples are added where the tool leaves the path by more
/// than `tolerance` between them.
class SectionPath {
 public:
  SectionPath(const Arm& arm, const ToolPath& path, const Task& task, Section samples,
              const Deviation& tolerance)
      : arm_(arm), path_(path), task_(task), bounds_(bounds_of(arm)), samples_(std::move(samples)) {
    constexpr int max_rounds = 8;
    for (int round = 0; round < max_rounds; ++round) {
      interpolate();
      if (!add_samples(tolerance)) return;
    }
    interpolate();
  }

  const JointPath& joint_path() const { return joint_path_; }

  /// The parameters of the joint path at the ends of segments.
  std::vector<double> segment_ends() const {
    std::vector<double> ends;
    for (std::size_t k = 1; k + 1 < joint_path_.size(); ++k) {
      const double s = samples_.path_parameters[k];
      if (s == std::floor(s)) ends.push_back(joint_path_.s[k]);
    }
    return ends;
  }

  /// The path parameters of timed samples of the joint path, on the tool path.
  std::vector<double> path_parameters(const SampledSection& timed) const {
    std::vector<double> parameters{samples_.path_parameters.front()};
    for (std::size_t k = 1; k + 1 < timed.progress.size(); ++k) {
      parameters.push_back(std::max(path_parameter(timed.progress[k]), parameters.back()));
    }
    parameters.push_back(samples_.path_parameters.back());
    return parameters;
  }

 private:
  /// A point of a segment.
  struct PathPlace {
    std::size_t index = 0;
    double fraction = 0;  ///< the segment parameter
  };

  /// The path parameter s on the segment on which `end` is.
  PathPlace at(double s, double end) const {
    const std::size_t i = segment_at(path_, end);
    return {i, std::clamp(s - static_cast<double>(i), 0.0, 1.0)};
  }

  /// The spline through the samples, with the derivatives of the tool path there.
  void interpolate() {
    joint_path_ = joint_spline(samples_.samples, chord_length(samples_.samples));
    const auto& parameters = samples_.path_parameters;
    for (std::size_t k = 0; k < joint_path_.size(); ++k) {
      follow(at(parameters[k], parameters[std::max<std::size_t>(k, 1)]), joint_path_.q[k],
             joint_path_.dq[k], joint_path_.ddq[k]);
    }
  }

  /// Adds one half-way between any two between which the tool is off the path; returns whether
  /// there were any.
  bool add_samples(const Deviation& tolerance) {
    Section refined{{samples_.samples.front()}, {samples_.path_parameters.front()}};
    for (std::size_t k = 1; k < samples_.samples.size(); ++k) {
      const PathPlace place = between(k, 0.5);
      const Pose pose = pose_at(path_.segments[place.index], place.fraction);
      const Configuration q = path_point(joint_path_, k - 1, 0.5).q;
      if (!within(task_deviation(task_, pose, forward_kinematics(arm_, q)), tolerance)) {
        const NumericalResult exact = levenberg_marquardt(arm_, pose, task_, bounds_, q);
        if (exact.converged) {
          refined.samples.push_back(exact.q);
          refined.path_parameters.push_back(static_cast<double>(place.index) + place.fraction);
        }
      }
      refined.samples.push_back(samples_.samples[k]);
      refined.path_parameters.push_back(samples_.path_parameters[k]);
    }
    const bool added = refined.samples.size() > samples_.samples.size();
    samples_ = std::move(refined);
    return added;
  }

  ParameterRates rates_of(const PathPlace& place, std::size_t k) const {
    return following(
        path_.segments[place.index], place.fraction, task_,
        internal::tool_motion(arm_, joint_path_.q[k], joint_path_.dq[k], joint_path_.ddq[k]));
  }

  /// The point of the tool path at fraction u from sample j - 1 to j: the segment parameter is the
  /// quintic with the rates at which the tool follows the path at both.
  PathPlace between(std::size_t j, double u) const {
    const auto& parameters = samples_.path_parameters;
    const PathPlace begin = at(parameters[j - 1], parameters[j]);
    const PathPlace end = at(parameters[j], parameters[j]);
    const double h = joint_path_.s[j] - joint_path_.s[j - 1];
    const ParameterRates a = rates_of(begin, j - 1), b = rates_of(end, j);
    const Polynomial p = quintic_between(begin.fraction, end.fraction, h * a.first, h * b.first,
                                         h * h * a.second, h * h * b.second);
    return {end.index, u == 1 ? end.fraction : std::clamp(p(u), 0.0, 1.0)};
  }

  double path_parameter(const Progress& now) const {
    constexpr double nanoseconds = 2e-9;  // by which times have been rounded
    const double rounding = nanoseconds * now.speed;
    const auto& s = joint_path_.s;
    const auto next = std::lower_bound(s.begin() + 1, s.end() - 1, now.s - rounding);
    const auto j = static_cast<std::size_t>(next - s.begin());
    const bool at_sample = std::abs(now.s - s[j]) <= rounding;
    const PathPlace place = between(j, at_sample ? 1 : (now.s - s[j - 1]) / (s[j] - s[j - 1]));
    return static_cast<double>(place.index) + place.fraction;
  }

  /// Changes the joints' derivatives as little as possible, so that the tool has the path's tangent
  /// and curvature.
  void follow(const PathPlace& place, const Configuration& q, Configuration& dq,
              Configuration& ddq) const {
    PoseMotion tool = internal::tool_motion(arm_, q, dq, ddq);
    const Segment& segment = path_.segments[place.index];
    const PoseMotion path =
        motion_along(segment, place.fraction, following(segment, place.fraction, task_, tool));
    const Eigen::MatrixXd inverse = pseudo_inverse(task_jacobian(arm_, q, task_));
    dq += inverse * rows(tool, path.velocity - tool.velocity);
    tool = internal::tool_motion(arm_, q, dq, ddq);
    ddq += inverse * rows(tool, path.acceleration - tool.acceleration);
  }

  /// The task's rows of a twist in world axes.
  Eigen::VectorXd rows(const PoseMotion& tool, Twist twist) const {
    if (task_.frame == Frame::tool) {
      const Rotation tool_R_world = tool.pose.linear().transpose();
      twist << tool_R_world * twist.head<3>(), tool_R_world * twist.tail<3>();
    }
    return task_rows(task_, twist);
  }

  const Arm& arm_;
  const ToolPath& path_;
  const Task& task_;
  Bounds bounds_;
  Section samples_;
  JointPath joint_path_;
};

/// Appends the timed section, or sets the status and reason of `timed`.
void append(TimedPlan& timed, const Arm& arm, const ToolPath& path, const Section& exact,
            const Task& task, const Deviation& tolerance, const RetimeOptions& options,
            double longest_gap) {
  if (exact.samples.size() > 1) {
    const Profile profile = options.profile.value_or(default_profile);
    check_options(options.tool_speed, options.rate);
    const SectionPath samples(arm, path, task, exact, tolerance);
    const TimedPath motion =
        timed_path(arm, samples.joint_path(), profile, options.speed_scale, options.tool_speed);
    if (!motion.scaling.reason.empty()) {
      timed.status = MotionStatus::outside_limits;
      timed.reason = motion.scaling.reason;
      return;
    }
    SectionOptions section{.interpolation = options.interpolation,
                           .keep_jerk = keeps_jerk(profile),
                           .speed_scale = options.speed_scale,
                           .tool_speed = options.tool_speed,
                           .rate = options.rate,
                           .longest_gap = longest_gap};
    if (options.interpolation == Interpolation::linear) {
      section.longest_gap /= static_cast<double>(exact.samples.size());
    }
    section.required = samples.segment_ends();
    const SampledSection sampled = sample_section(arm, motion, section);
    internal::append(timed.trajectory, sampled.trajectory);
    const std::vector<double> path_parameters = samples.path_parameters(sampled);
    timed.path_parameters.insert(timed.path_parameters.end(), path_parameters.begin() + 1,
                                 path_parameters.end());
  }
  timed.path_parameters.back() = exact.path_parameters.back();
}

}  // namespace

TimedPlan time_plan(const Arm& arm, const Route& route, const Branch& plan, const Task& task,
                    const Deviation& tolerance, const RetimeOptions& options, double longest_gap) {
  TimedPlan timed{.trajectory = at_rest(arm, plan.start), .path_parameters = {0}};
  if (options.interpolation != Interpolation::quintic) timed.trajectory.accelerations.clear();
  if (options.interpolation == Interpolation::linear) timed.trajectory.velocities.clear();
  Section section{{plan.start}, {0}};
  for (std::size_t i = 0; i < plan.segments.size(); ++i) {
    add(section, plan.segments[i], i);
    if (i + 1 < plan.segments.size() && !route.stops[i]) continue;
    append(timed, arm, route.path, section, task, tolerance, options, longest_gap);
    if (timed.status != MotionStatus::reached) {
      timed.reason = "up to the end of segment " + std::to_string(i + 1) + ": " + timed.reason;
      return timed;
    }
    section = {{section.samples.back()}, {section.path_parameters.back()}};
  }
  return timed;
}

}  // namespace beeline::internal
