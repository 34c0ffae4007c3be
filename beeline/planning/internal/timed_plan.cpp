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

/// Puts samples of a section onto the tool path, with its velocity and acceleration. The path
/// parameter of the tool path is a twice differentiable function of that of the joint path: between
/// two samples of the branch the quintic with the rates at which the tool follows the path there.
class PathSamples {
 public:
  PathSamples(const Arm& arm, const ToolPath& path, const Task& task, const Section& exact)
      : arm_(arm),
        path_(path),
        task_(task),
        exact_(exact),
        bounds_(bounds_of(arm)),
        joint_path_(joint_spline(exact.samples, chord_length(exact.samples))) {
    const auto& parameters = exact.path_parameters;
    for (std::size_t k = 0; k < joint_path_.size(); ++k) {
      const PathPlace place = at(parameters[k], parameters[std::max<std::size_t>(k, 1)]);
      const ParameterRates rates =
          rates_of(place, joint_path_.q[k], joint_path_.dq[k], joint_path_.ddq[k]);
      follow(place, rates, joint_path_.q[k], joint_path_.dq[k], &joint_path_.ddq[k]);
    }
  }

  /// The spline through the branch's samples, with the derivatives of the tool path there.
  const JointPath& joint_path() const { return joint_path_; }

  void move(SampledSection& section) const {
    auto& [names, t, q, v, a] = section.trajectory;
    for (std::size_t k = 1; k + 1 < section.progress.size(); ++k) {
      const auto [place, rates] = along_tool_path(section.progress[k]);
      put_on_path(place, q[k]);
      if (!v.empty()) follow(place, rates, q[k], v[k], a.empty() ? nullptr : &a[k]);
    }
  }

  /// The path parameters of the joint path at the ends of segments.
  std::vector<double> segment_ends() const {
    std::vector<double> ends;
    for (std::size_t k = 1; k + 1 < joint_path_.size(); ++k) {
      const double s = exact_.path_parameters[k];
      if (s == std::floor(s)) ends.push_back(joint_path_.s[k]);
    }
    return ends;
  }

  /// The path parameters of the samples on the tool path.
  std::vector<double> path_parameters(const SampledSection& section) const {
    std::vector<double> parameters{exact_.path_parameters.front()};
    for (std::size_t k = 1; k + 1 < section.progress.size(); ++k) {
      const PathPlace place = along_tool_path(section.progress[k]).place;
      const double s = static_cast<double>(place.index) + place.fraction;
      parameters.push_back(std::max(s, parameters.back()));
    }
    parameters.push_back(exact_.path_parameters.back());
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

  ParameterRates rates_of(const PathPlace& place, const Configuration& q, const Configuration& dq,
                          const Configuration& ddq) const {
    return following(path_.segments[place.index], place.fraction, task_,
                     internal::tool_motion(arm_, q, dq, ddq));
  }

  struct PlaceInTime {
    PathPlace place;
    ParameterRates rates;  ///< time derivatives of the segment parameter
  };

  PlaceInTime along_tool_path(const Progress& now) const {
    constexpr double nanoseconds = 2e-9;  // by which times have been rounded
    const auto& s = joint_path_.s;
    const auto next = std::lower_bound(s.begin() + 1, s.end() - 1, now.s - nanoseconds * now.speed);
    const auto j = static_cast<std::size_t>(next - s.begin());
    const auto& parameters = exact_.path_parameters;
    const PathPlace begin = at(parameters[j - 1], parameters[j]);
    const PathPlace end = at(parameters[j], parameters[j]);
    const auto rates = [&](const PathPlace& place, std::size_t i) {
      return rates_of(place, joint_path_.q[i], joint_path_.dq[i], joint_path_.ddq[i]);
    };
    const double h = s[j] - s[j - 1];
    const double u = std::abs(now.s - s[j]) <= nanoseconds * now.speed ? 1 : (now.s - s[j - 1]) / h;
    const ParameterRates a = rates(begin, j - 1), b = rates(end, j);
    const Polynomial p = quintic_between(begin.fraction, end.fraction, h * a.first, h * b.first,
                                         h * h * a.second, h * h * b.second);
    const Polynomial d = p.derivative();
    const double first = d(u) / h, second = d.derivative()(u) / (h * h);
    return {{end.index, u == 1 ? end.fraction : std::clamp(p(u), 0.0, 1.0)},
            {first * now.speed, second * now.speed * now.speed + first * now.acceleration}};
  }

  /// Solves for the pose to rounding: third differences of samples at a high rate show the rest.
  void put_on_path(const PathPlace& place, Configuration& q) const {
    const Pose pose = pose_at(path_.segments[place.index], place.fraction);
    const NumericalResult found = levenberg_marquardt(arm_, pose, task_, bounds_, q);
    if (!found.converged) return;
    q = found.q + pseudo_inverse(task_jacobian(arm_, found.q, task_)) *
                      task_error(task_, pose, forward_kinematics(arm_, found.q));
  }

  /// Changes the joints' first derivative and, if given, the second as little as possible, so that
  /// the tool has those of the path at these rates.
  void follow(const PathPlace& place, const ParameterRates& rates, const Configuration& q,
              Configuration& dq, Configuration* ddq) const {
    const PoseMotion path = motion_along(path_.segments[place.index], place.fraction, rates);
    const Eigen::MatrixXd inverse = pseudo_inverse(task_jacobian(arm_, q, task_));
    const Configuration second = ddq ? *ddq : Configuration::Zero(arm_.dof());
    PoseMotion tool = internal::tool_motion(arm_, q, dq, second);
    dq += inverse * rows(tool, path.velocity - tool.velocity);
    if (ddq == nullptr) return;
    tool = internal::tool_motion(arm_, q, dq, second);
    *ddq += inverse * rows(tool, path.acceleration - tool.acceleration);
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
  const Section& exact_;
  Bounds bounds_;
  JointPath joint_path_;
};

/// Appends the timed section, or sets the status and reason of `timed`.
void append(TimedPlan& timed, const Arm& arm, const ToolPath& path, const Section& exact,
            const Task& task, const RetimeOptions& options, double longest_gap) {
  if (exact.samples.size() > 1) {
    const Profile profile = options.profile.value_or(default_profile);
    check_options(options.tool_speed, options.rate);
    const PathSamples samples(arm, path, task, exact);
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
    section.move = [&](SampledSection& moved) { samples.move(moved); };
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
                    const RetimeOptions& options, double longest_gap) {
  TimedPlan timed{.trajectory = at_rest(arm, plan.start), .path_parameters = {0}};
  if (options.interpolation != Interpolation::quintic) timed.trajectory.accelerations.clear();
  if (options.interpolation == Interpolation::linear) timed.trajectory.velocities.clear();
  Section section{{plan.start}, {0}};
  for (std::size_t i = 0; i < plan.segments.size(); ++i) {
    add(section, plan.segments[i], i);
    if (i + 1 < plan.segments.size() && !route.stops[i]) continue;
    append(timed, arm, route.path, section, task, options, longest_gap);
    if (timed.status != MotionStatus::reached) {
      timed.reason = "up to the end of segment " + std::to_string(i + 1) + ": " + timed.reason;
      return timed;
    }
    section = {{section.samples.back()}, {section.path_parameters.back()}};
  }
  return timed;
}

}  // namespace beeline::internal
