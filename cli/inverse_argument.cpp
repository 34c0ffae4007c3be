#include "inverse_argument.h"

#include <algorithm>
#include <charconv>

#include <beeline/error.h>
#include <beeline/read/numbers.h>

using namespace beeline;

namespace {

/// CLI11 takes -1 for the largest number, and cuts off what is too large.
std::string whole_number(const std::string& text) {
  std::uint64_t value = 0;
  const char* const last = text.data() + text.size();
  const auto [end, fault] = std::from_chars(text.data(), last, value);
  if (text.empty() || (fault == std::errc() && end == last)) return "";
  return "needs a whole number from 0 to 18446744073709551615, not " + text;
}

/// --lock NAME or NAME=VALUE: the value goes into the seed, where the joint stays.
void apply_lock(const std::string& lock, const Arm& arm, const UnitArgument& unit,
                InverseOptions& options) {
  const std::vector<std::string> names = arm.joint_names();
  auto joint = std::find(names.begin(), names.end(), lock);
  const std::size_t equals = lock.rfind('=');
  const bool has_value = joint == names.end() && equals != std::string::npos;
  const std::string asked = has_value ? lock.substr(0, equals) : lock;
  joint = std::find(names.begin(), names.end(), asked);
  if (joint == names.end()) throw unknown_name("joint", asked, names);
  const int k = static_cast<int>(joint - names.begin());
  options.lock = k;
  if (!has_value) return;
  if (!options.seed) options.seed = middle_configuration(arm);
  const double value = parse_number(lock.substr(equals + 1), "--lock " + asked);
  (*options.seed)[k] = unit.coordinate(arm, k, value);
}

}  // namespace

void InverseArgument::declare_choices(CLI::App& verb) {
  verb.add_option("--seed", seed, "Joint values to be near to (default: the middle)");
  task.declare(verb);
  verb.add_flag("--ignore-limits", options.ignore_limits, "Joint limits do not count");
  verb.add_option("--lock", lock,
                  "NAME or NAME=VALUE: this joint stays at the seed's value, or at this one");
  verb.add_option("--redundancy", redundancy,
                  "With a joint to spare, which of infinitely many solutions: any, the nearest\n"
                  "to the seed, or the one most centred between the limits")
      ->capture_default_str();
  verb.add_option("--grid", options.grid, "Values of the joint to spare that are tried first")
      ->capture_default_str();
}

void InverseArgument::declare_search(CLI::App& verb) {
  verb.add_option("--method", method,
                  "automatic, closed_form (all solutions by formulas; an error where the arm\n"
                  "has none) or numerical (descents from the seed and from elsewhere)")
      ->capture_default_str();
  verb.add_option("--tolerance", options.tolerance, "Largest error, metres and radians")
      ->capture_default_str();
  verb.add_option("--iterations", options.iterations, "Most steps of the numerical solver in a try")
      ->capture_default_str();
  verb.add_option("--restarts", options.restarts, "Most tries from random configurations")
      ->capture_default_str();
  verb.add_option("--random-seed", options.random_seed, "The same seed gives the same answer")
      ->check(whole_number)
      ->capture_default_str();
  verb.add_option("--time-limit", options.time_limit,
                  "Seconds after which a numerical search ends with what it has");
}

InverseOptions InverseArgument::read(const Arm& arm, const UnitArgument& unit) const {
  InverseOptions asked = options;
  asked.task = task.read(arm);
  asked.method = inverse_method_named(method);
  asked.redundancy = redundancy_named(redundancy);
  if (!seed.empty()) asked.seed = unit.configuration(arm, seed, "--seed");
  if (!lock.empty()) apply_lock(lock, arm, unit, asked);
  return asked;
}
