#include <beeline/read/internal/name.h>
#include <beeline/read/internal/urdf_fault.h>

namespace beeline::internal {
namespace {

/// The clause of a fault. It is composed here where that takes long, as the search for the nearest
/// name: a file may have thousands of faults.
std::string clause_of(const UrdfFile& file, const UrdfFault& fault) {
  if (fault.kind != ReadWarningKind::unknown_link) return fault.clause;
  constexpr std::size_t most_compared = 10'000;  // beyond, the search takes seconds
  std::vector<std::string> known;
  if (file.links.size() <= most_compared) {
    for (const auto& link : file.links) known.push_back(link.name);
  }
  const bool parent = file.joints[*fault.index].parent == fault.link;
  const Error unknown =
      unknown_name(parent ? "parent link" : "child link", printable(fault.link), known);
  return "joint " + fault.joint + " has an " + unknown.what();
}

}  // namespace

FileError error_of(const UrdfFile& file, const UrdfFault& fault, const std::string& cure) {
  return {file.path, fault.line, clause_of(file, fault) + cure};
}

ReadWarning warning_of(const UrdfFile& file, const UrdfFault& fault) {
  return {.kind = fault.kind,
          .path = file.path,
          .line = fault.line,
          .joint = fault.joint,
          .link = fault.link,
          .element = fault.element,
          .fault = clause_of(file, fault)};
}

}  // namespace beeline::internal
