#include <beeline/io/text/internal/read_fault.h>
#include <beeline/io/text/internal/urdf_fault.h>

namespace beeline::internal {

FileError error_of(const UrdfFile& file, const UrdfFault& fault, const std::string& cure) {
  const ReadWarning warning = warning_of(file, fault);
  return {file.path, warning.line, clause(warning) + cure};
}

ReadWarning warning_of(const UrdfFile& file, const UrdfFault& fault) {
  constexpr std::size_t most_compared = 10'000;  // beyond, the search for the nearest takes seconds
  ReadWarning warning = fault.warning;
  warning.path = file.path;
  if (warning.kind == ReadWarningKind::unknown_link && file.links.size() <= most_compared) {
    for (const auto& link : file.links) warning.others.push_back(link.name);
  }
  if (warning.kind == ReadWarningKind::unknown_leader && file.joints.size() <= most_compared) {
    for (const auto& joint : file.joints) warning.others.push_back(joint.name);
  }
  return warning;
}

}  // namespace beeline::internal
