#include <beeline/internal/budget_meter.h>
#include <beeline/internal/enum_names.h>
#include <beeline/timing/internal/fastest.h>
#include <beeline/timing/internal/jerk_limited.h>
#include <beeline/timing/internal/scalar_profile.h>
#include <beeline/timing/time_scaling.h>

namespace beeline {
namespace {

constexpr internal::EnumNames<Profile> profiles("profile",
                                                "fastest jerk trapezoidal quintic s-curve");

}  // namespace

std::string name(Profile profile) { return profiles.of(profile); }

std::vector<std::string> profile_names() { return profiles.all(); }

Profile profile_named(const std::string& name) { return profiles.named(name); }

bool keeps_jerk(Profile profile) {
  switch (profile) {
    case Profile::fastest:
    case Profile::trapezoidal:
      return false;
    case Profile::jerk:
    case Profile::quintic:
    case Profile::s_curve:
      return true;
  }
  throw Error("unknown profile");
}

TimeScaling time_scaling(const JointPath& path, const PathLimits& limits, Profile profile,
                         const Budget& budget) {
  using internal::ScalarForm;
  internal::BudgetMeter meter(budget);
  const auto scalar = [&](ScalarForm form) {
    return internal::scalar_profile(form, path, limits, meter);
  };
  switch (profile) {
    case Profile::fastest:
      return internal::fastest(path, limits, {}, meter);
    case Profile::jerk:
      return internal::jerk_limited(path, limits, meter);
    case Profile::trapezoidal:
      return scalar(ScalarForm::trapezoidal);
    case Profile::quintic:
      return scalar(ScalarForm::quintic);
    case Profile::s_curve:
      return scalar(ScalarForm::s_curve);
  }
  throw Error("unknown profile");
}

}  // namespace beeline
