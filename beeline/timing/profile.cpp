#include <algorithm>

#include <beeline/internal/budget_meter.h>
#include <beeline/timing/internal/fastest.h>
#include <beeline/timing/internal/jerk_limited.h>
#include <beeline/timing/internal/scalar_profile.h>
#include <beeline/timing/time_scaling.h>

namespace beeline {
namespace {

struct Row {
  Profile profile;
  const char* name;
  bool keeps_jerk;
  TimeScaling (*scaling)(const JointPath& path, const PathLimits& limits,
                         internal::BudgetMeter& budget);
};

template <internal::ScalarForm form>
TimeScaling scalar(const JointPath& path, const PathLimits& limits, internal::BudgetMeter& budget) {
  return internal::scalar_profile(form, path, limits, budget);
}

TimeScaling from_rest_to_rest(const JointPath& path, const PathLimits& limits,
                              internal::BudgetMeter& budget) {
  return internal::fastest(path, limits, {}, budget);
}

using internal::ScalarForm;
constexpr Row table[] = {
    {Profile::fastest, "fastest", false, from_rest_to_rest},
    {Profile::jerk, "jerk", true, internal::jerk_limited},
    {Profile::trapezoidal, "trapezoidal", false, scalar<ScalarForm::trapezoidal>},
    {Profile::quintic, "quintic", true, scalar<ScalarForm::quintic>},
    {Profile::s_curve, "s-curve", true, scalar<ScalarForm::s_curve>},
};

constexpr bool in_order() {
  int k = 0;
  for (const Row& row : table) {
    if (static_cast<int>(row.profile) != k++) return false;
  }
  return true;
}
static_assert(in_order());

const Row& row(Profile profile) { return table[static_cast<int>(profile)]; }

}  // namespace

std::string name(Profile profile) { return row(profile).name; }

std::vector<std::string> profile_names() {
  std::vector<std::string> names;
  for (const Row& row : table) names.emplace_back(row.name);
  return names;
}

Profile profile_named(const std::string& name) {
  for (const Row& row : table) {
    if (name == row.name) return row.profile;
  }
  throw unknown_name("profile", name, profile_names());
}

bool keeps_jerk(Profile profile) { return row(profile).keeps_jerk; }

TimeScaling time_scaling(const JointPath& path, const PathLimits& limits, Profile profile,
                         const Budget& budget) {
  internal::BudgetMeter meter(budget);
  return row(profile).scaling(path, limits, meter);
}

}  // namespace beeline
