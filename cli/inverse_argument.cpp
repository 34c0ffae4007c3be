#include "inverse_argument.h"

#include <algorithm>
#include <numbers>

#include <beeline/error.h>
#include <beeline/io/text/numbers.h>

namespace beeline::command {
namespace {

/// --lock NAME or NAME=VALUE; the value becomes the seed's.
void apply_lock(const std::string& lock, const Arm& arm, const UnitArgument& unit,
                InverseOptions& options) {
  const std::vector<std::string> names = arm.joint_names();
  const auto joint = std::find(names.begin(), names.end(), lock);
  const std::size_t equals = lock.rfind('=');
  const bool has_value = joint == names.end() && equals != std::string::npos;
  const std::string locked = has_value ? lock.substr(0, equals) : lock;
  const int k = coordinate_named(arm, locked, "--lock");
  options.lock = k;
  if (!has_value) return;
  if (!options.seed) options.seed = middle_configuration(arm);
  const double value = parse_number(lock.substr(equals + 1), "--lock " + locked);
  (*options.seed)[k] = unit.coordinate(arm, k, value);
  if (kind(arm.joint_of(k)) != JointKind::prismatic)
    warn_of_angle("--lock", (*options.seed)[k], unit);
}

/// --pose-tolerance, with angles in radians.
Eigen::VectorXd pose_tolerance_of(const std::string& text, const Arm& arm,
                                  const UnitArgument& unit) {
  std::vector<double> values = parse_numbers(text, "--pose-tolerance");
  const std::size_t lengths = arm.planar() ? 2 : 3;
  for (std::size_t k = lengths; k < values.size() && unit.degrees; ++k) {
    values[k] *= std::numbers::pi / 180;
  }
  return Eigen::Map<Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// --weights: one number for each coordinate.
Eigen::VectorXd weights_of(const std::string& text) {
  std::vector<double> values = parse_numbers(text, "--weights");
  return Eigen::Map<Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

}  // namespace

std::vector<Option> InverseArgument::choice_options() {
  return joined(
      {{work.option(), joint_values_option("--seed",
                                           "Joint values; solutions near them come first. Default: "
                                           "the middle of the position limits.",
                                           &seed)},
       task.options(),
       {Option("--ignore-limits", "Accept solutions outside the position limits.",
               &values.ignore_limits),
        Option("--lock JOINT[=VALUE]", "Keep this joint at the value given, or at the seed's.",
               &lock),
        Option(
            "--redundancy CHOICE",
            "Which of infinitely many solutions of a redundant arm: any; the one nearest to the "
            "seed; or the most centred between the position limits. Default: with a seed the "
            "nearest one that a search from it finds, if the arm has a closed form for each value "
            "of its redundant joint; otherwise any.",
            &redundancy,
            {.choices = {name(Redundancy::any), name(Redundancy::nearest),
                         name(Redundancy::centred)}}),
        Option("--pose-tolerance X,Y,Z,ROLL,PITCH,YAW",
               "How far the tool may deviate, in the axes of the pose, where the pose itself has "
               "no solution; planar arms: X,Y,THETA.",
               &pose_tolerance),
        Option("--weights W,W,...",
               "Weight of each joint in distances from the seed, 1e-6 to 1e6: a small one moves "
               "more readily.",
               &weights),
        Option("--grid N",
               "Number of values of the redundant joint at which solutions are first sought.",
               &values.grid, {.range = {2, 10'000}})}});
}

std::vector<Option> InverseArgument::search_options() {
  return {
      Option("--method METHOD",
             "closed_form: all solutions by formulas, an error for an arm without; numerical: "
             "iterations from the seed and from random configurations; automatic: closed form "
             "where there is one.",
             &method,
             {.choices = {name(InverseMethod::automatic), name(InverseMethod::closed_form),
                          name(InverseMethod::numerical)}}),
      Option("--tolerance E", "Largest error of a solution, in metres and in radians.",
             &values.tolerance, {.range = {.lowest = 0, .highest = 0.1, .excludes_lowest = true}}),
      Option("--max-iterations N",
             "Largest number of iterations from one start of the numerical method.",
             &values.max_iterations),
      Option("--max-restarts N", "Largest number of random starts of the numerical method.",
             &values.max_restarts),
      Option("--random-seed N", "Seed of the random starts; the same seed gives the same answer.",
             &values.random_seed)};
}

InverseOptions InverseArgument::read(const Arm& arm, const ArmArgument& argument,
                                     const UnitArgument& unit) const {
  InverseOptions options = values;
  options.task = task.read(arm);
  options.method = inverse_method_named(method);
  if (!redundancy.empty()) options.redundancy = redundancy_named(redundancy);
  if (!seed.empty()) options.seed = argument.configuration(arm, seed, "--seed", unit);
  if (!pose_tolerance.empty()) {
    options.pose_tolerance = pose_tolerance_of(pose_tolerance, arm, unit);
  }
  if (!weights.empty()) options.weights = weights_of(weights);
  if (!lock.empty()) apply_lock(lock, arm, unit, options);
  return options;
}

}  // namespace beeline::command
