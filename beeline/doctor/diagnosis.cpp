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
  constexpr internal::EnumNames<FindingKind> names("finding");
  return names.of(kind);
}

}  // namespace beeline
