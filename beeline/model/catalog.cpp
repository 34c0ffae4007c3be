#include <beeline/error.h>
#include <beeline/model/catalog.h>
#include <beeline/model/internal/catalog_entry.h>

namespace beeline {

const std::vector<BuiltInArm>& built_in_arms() {
  static const std::vector<BuiltInArm> arms = [] {
    std::vector<BuiltInArm> all;
    for (const internal::CatalogEntry& entry : internal::catalog_entries()) {
      all.push_back(entry.about);
    }
    return all;
  }();
  return arms;
}

std::vector<std::string> built_in_names() {
  std::vector<std::string> names;
  for (const BuiltInArm& arm : built_in_arms()) names.push_back(arm.name);
  return names;
}

Arm built_in(std::string_view name) {
  for (const internal::CatalogEntry& entry : internal::catalog_entries()) {
    if (entry.about.name == name) return entry.build();
  }
  throw unknown_name("built-in arm", name, built_in_names());
}

}  // namespace beeline
