#include <algorithm>
#include <utility>

#include <beeline/io/text/internal/read_fault.h>
#include <beeline/io/text/internal/urdf_fault.h>

namespace beeline::internal {

namespace {

ReadWarning warning_of(const UrdfFile& file, const UrdfFault& fault) {
  constexpr std::size_t most_compared = 10'000;  // beyond, the search for the nearest takes seconds
  ReadWarning warning = fault.warning;
  warning.path = fault.index ? path_of(file, file.joints[*fault.index]) : file.path;
  if (warning.kind == ReadWarningKind::unknown_link && file.links.size() <= most_compared) {
    for (const auto& link : file.links) warning.others.push_back(link.name);
  }
  if (warning.kind == ReadWarningKind::unknown_leader && file.joints.size() <= most_compared) {
    for (const auto& joint : file.joints) warning.others.push_back(joint.name);
  }
  return warning;
}

}  // namespace

FileError error_of(const UrdfFile& file, const UrdfFault& fault, const std::string& cure) {
  const ReadWarning warning = warning_of(file, fault);
  return {warning.path, warning.line, clause(warning) + cure};
}

std::vector<ReadWarning> warnings_of(const UrdfFile& file, const std::vector<UrdfFault>& faults,
                                     std::size_t most) {
  std::vector<ReadWarning> warnings;
  for (std::size_t i = 0; i < std::min(most, faults.size()); ++i) {
    ReadWarning warning = warning_of(file, faults[i]);
    const auto same_names = [&](const ReadWarning& before) {
      const bool of_element = warning.kind == ReadWarningKind::unknown_attribute;
      return before.kind == warning.kind && (!of_element || before.element == warning.element);
    };
    warning.lists_known = std::none_of(warnings.begin(), warnings.end(), same_names);
    warnings.push_back(std::move(warning));
  }
  return warnings;
}

}  // namespace beeline::internal
