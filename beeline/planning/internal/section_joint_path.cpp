#include <algorithm>
#include <cmath>

#include <beeline/certificate/internal/path_step.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/internal/tool_motion.h>
#include <beeline/kinematics/jacobian.h>
#include <beeline/math/minimum_norm.h>
#include <beeline/math/polynomial.h>
#include <beeline/path/internal/nearest_on_line.h>
#include <beeline/planning/internal/section_joint_path.h>

namespace beeline::internal {
namespace {

/// Whether a segment parameter moves backwards.
bool moves_back(const Polynomial& p) {
  constexpr int scan = 16;
  const double rounding = 1e-3 * std::abs(p(1) - p(0));
  for (int i = 1; i <= scan; ++i) {
    if (p(static_cast<double>(i) / scan) < p(static_cast<double>(i - 1) / scan) - rounding)
      return true;
  }
  return false;
}

/// The rows of a task, in the axes of its frame, of a twist in world axes.
Eigen::VectorXd in_task_rows(const Task& task, const Rotation& world_R_tool, const Twist& twist) {
  return task_rows(task, in_task_axes(task, world_R_tool, twist));
}

}  // namespace

SectionJointPath::SectionJointPath(const MotionRequest& request, BranchSection samples,
                                   BudgetMeter& budget)
    : arm_(request.arm),
      path_(request.route.path),
      task_(request.task()),
      bounds_(bounds_of(arm_)),
      samples_(std::move(samples)) {
  constexpr double tolerated = 0.01;
  // Tasks with one orientation row, whose error is no linear function of the angular velocity, may
  // need very many; the proof decides whether these are enough.
  constexpr std::size_t max_samples = 1024;
  const std::size_t given = samples_.samples.size();
  interpolate();
  while (samples_.samples.size() < std::max(max_samples, 2 * given) &&
         add_samples(request.tolerance(tolerated), budget)) {
    interpolate();
  }
}

/// The smooth path through the samples, with the derivatives of the tool path there. Jumps of its
/// third derivative would be jumps of the joints' jerk.
void SectionJointPath::interpolate() {
  joint_path_ = joint_spline(samples_.samples, chord_length(samples_.samples));
  const auto& parameters = samples_.path_parameters;
  const auto follow_at = [&](std::size_t k) {
    follow(k, at(parameters[k], parameters[std::max<std::size_t>(k, 1)]));
  };
  follow_at(0);
  follow_at(joint_path_.size() - 1);
  smooth_derivatives(joint_path_);
  for (std::size_t k = 0; k < joint_path_.size(); ++k) follow_at(k);
}

/// The tool's deviation from the path at fraction u from sample k - 1 to k, where the segment
/// parameter is p(u).
Deviation SectionJointPath::deviation(std::size_t k, const Polynomial& p, double u) const {
  const SegmentPoint place = between(k, p, u);
  const Pose pose = forward_kinematics(arm_, path_point(joint_path_, k - 1, u).q);
  return deviation_from(path_.segments[place.index], place.fraction, pose, task_);
}

/// Adds one half-way between any two between which the tool is off the path; returns whether
/// there were any, and the budget has not ended.
bool SectionJointPath::add_samples(const Deviation& tolerance, BudgetMeter& budget) {
  BranchSection refined{{samples_.samples.front()}, {samples_.path_parameters.front()}};
  for (std::size_t k = 1; k < samples_.samples.size(); ++k) {
    if (budget.ended()) return false;
    const Polynomial p = segment_parameter(k);
    const auto off = [&](double u) { return !within(deviation(k, p, u), tolerance); };
    const bool back = moves_back(p);
    if (back || off(0.5) || off(0.2) || off(0.8)) {
      SegmentPoint place = between(k, p, 0.5);
      if (back) {
        const double a = samples_.path_parameters[k - 1], b = samples_.path_parameters[k];
        place = at(0.5 * (a + b), b);
      }
      // Near a singularity the solution may be on another branch: only one near both is taken. The
      // spline is a better guess than the middle, except where it oscillates.
      const Configuration middle = (samples_.samples[k - 1] + samples_.samples[k]) / 2;
      constexpr double excursion = 0.5;   // of a path that turns back between them
      constexpr double min_chord = 1e-9;  // both in radians or metres
      const double chord = (samples_.samples[k] - samples_.samples[k - 1]).norm();
      const Configuration guess = path_point(joint_path_, k - 1, 0.5).q;
      const NumericalResult exact =
          levenberg_marquardt(arm_, pose_at(path_.segments[place.index], place.fraction), task_,
                              bounds_, (guess - middle).norm() <= chord ? guess : middle);
      const auto near = [&](const Configuration& q) {
        return (q - middle).norm() <= excursion + chord;
      };
      const auto apart = [&](const Configuration& q) { return (exact.q - q).norm() > min_chord; };
      if (exact.converged && near(exact.q) && apart(samples_.samples[k - 1]) &&
          apart(samples_.samples[k])) {
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

/// Returns the point of path parameter s on the segment that contains `end`.
SectionJointPath::SegmentPoint SectionJointPath::at(double s, double end) const {
  const std::size_t i = segment_at(path_, end);
  return {i, std::clamp(s - static_cast<double>(i), 0.0, 1.0)};
}

ParameterRates SectionJointPath::rates_of(const SegmentPoint& place, std::size_t k) const {
  return following(
      path_.segments[place.index], place.fraction, task_,
      internal::tool_motion(arm_, joint_path_.q[k], joint_path_.dq[k], joint_path_.ddq[k]));
}

/// The segment parameter from sample j - 1 to j: the quintic with the rates at which the tool
/// follows the path at both.
Polynomial SectionJointPath::segment_parameter(std::size_t j) const {
  const auto& parameters = samples_.path_parameters;
  const SegmentPoint begin = at(parameters[j - 1], parameters[j]);
  const SegmentPoint end = at(parameters[j], parameters[j]);
  const double h = joint_path_.s[j] - joint_path_.s[j - 1];
  const ParameterRates a = rates_of(begin, j - 1), b = rates_of(end, j);
  return quintic_between(begin.fraction, end.fraction, h * a.first, h * b.first, h * h * a.second,
                         h * h * b.second);
}

/// The point of the tool path at fraction u from sample j - 1 to j.
SectionJointPath::SegmentPoint SectionJointPath::between(std::size_t j, const Polynomial& p,
                                                         double u) const {
  const auto& parameters = samples_.path_parameters;
  const std::size_t i = at(parameters[j], parameters[j]).index;
  return {i, std::clamp(p(u), 0.0, 1.0)};
}

double SectionJointPath::path_parameter(const Configuration& q, double s, double rounding) const {
  const auto& grid = joint_path_.s;
  const auto next = std::lower_bound(grid.begin() + 1, grid.end() - 1, s - rounding);
  const auto j = static_cast<std::size_t>(next - grid.begin());
  if (std::abs(s - grid[j]) <= rounding) return samples_.path_parameters[j];
  SegmentPoint place =
      between(j, segment_parameter(j), (s - grid[j - 1]) / (grid[j] - grid[j - 1]));
  if (const auto* line = std::get_if<Line>(&path_.segments[place.index])) {
    // The polynomial between two samples is no measure near a singularity.
    place.fraction = nearest_fraction(*line, forward_kinematics(arm_, q), task_);
  }
  return static_cast<double>(place.index) + place.fraction;
}

std::vector<double> SectionJointPath::segment_ends() const {
  std::vector<double> ends;
  for (std::size_t k = 1; k + 1 < joint_path_.size(); ++k) {
    const double s = samples_.path_parameters[k];
    if (s == std::floor(s)) ends.push_back(joint_path_.s[k]);
  }
  return ends;
}

double SectionJointPath::parameter_at(double path_parameter) const {
  const auto& parameters = samples_.path_parameters;
  const auto sample = std::lower_bound(parameters.begin(), parameters.end() - 1, path_parameter);
  return joint_path_.s[static_cast<std::size_t>(sample - parameters.begin())];
}

/// Whether coordinate i rests at a limit at sample k, such as a joint whose limits are equal. With
/// another derivative it would leave the limits between the samples.
bool SectionJointPath::rests_at_limit(std::size_t k, Eigen::Index i) const {
  const double q = joint_path_.q[k][i];
  return joint_path_.dq[k][i] == 0 && joint_path_.ddq[k][i] == 0 &&
         (q <= bounds_.lower[i] || q >= bounds_.upper[i]);
}

/// Changes the derivatives at sample k as little as possible, so that the tool has the path's
/// tangent and curvature in the task's rows. A coordinate that rests at a limit remains at rest.
/// Near a singularity, where the change is large, the derivatives of the spline remain.
void SectionJointPath::follow(std::size_t k, const SegmentPoint& place) {
  const Configuration& q = joint_path_.q[k];
  Configuration &dq = joint_path_.dq[k], &ddq = joint_path_.ddq[k];
  const Segment& segment = path_.segments[place.index];
  const PoseMotion tool = internal::tool_motion(arm_, q, dq, ddq);
  ParameterRates rates = following(segment, place.fraction, task_, tool);
  rates.first = std::max(rates.first, 0.0);  // not backwards
  const PoseMotion path = motion_along(segment, place.fraction, rates);
  Eigen::MatrixXd equations = error_jacobian(task_, tool.pose, path.pose) * jacobian(arm_, q);
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    if (rests_at_limit(k, i)) equations.col(i).setZero();  // and so its row of the inverse
  }
  const Eigen::MatrixXd inverse = pseudo_inverse(equations);
  const auto correction = [&](const Twist& error) -> Configuration {
    return -inverse * in_task_rows(task_, tool.pose.linear(), error);
  };
  const Configuration first = correction(error_rates(task_, tool, path).first);
  if (!(first.norm() <= 0.5 * dq.norm())) return;
  dq += first;
  const PoseMotion along = internal::tool_motion(arm_, q, dq, ddq);
  const Configuration second = correction(error_rates(task_, along, path).second);
  const double step = k == 0 ? joint_path_.s[1] : joint_path_.s[k] - joint_path_.s[k - 1];
  if (second.norm() <= ddq.norm() + dq.norm() / step) ddq += second;
}

}  // namespace beeline::internal
