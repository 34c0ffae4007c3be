#include <beeline/doctor/diagnosis.h>
#include <beeline/doctor/internal/findings.h>
#include <beeline/internal/enum_names.h>

namespace beeline {

Diagnosis diagnose(const Arm& arm) {
  Diagnosis diagnosis;
  internal::find_units(arm, diagnosis.findings);
  internal::find_axes(arm, diagnosis.findings);
  internal::find_limits(arm, AngleUnit::radians, diagnosis.findings);
  return diagnosis;
}

Diagnosis diagnose(const std::string& text, const ChainEnds& ends) {
  const Arm arm = read_arm(text, ends);
  Diagnosis diagnosis;
  internal::find_faults(text, diagnosis.findings);
  const AngleUnit unit = internal::find_in_file(text, arm, diagnosis.findings);
  internal::find_units(arm, diagnosis.findings);
  internal::find_axes(arm, diagnosis.findings);
  internal::find_limits(arm, unit, diagnosis.findings);
  return diagnosis;
}

std::string name(FindingKind kind) {
  constexpr internal::EnumNames<FindingKind::fault> names(
      "finding",
      "length_unit angle_unit rounded_angle nearly_special coincident_axes missing_axis "
      "axis_length no_range unknown_velocity fault");
  return names.of(kind);
}

}  // namespace beeline
