#pragma once

#include <string>
#include <unordered_set>

#include <beeline/io/text/internal/mjcf_document.h>

namespace beeline::internal {

/// The names of the bodies and joints of an MJCF file, and names for those without one.
class MjcfNames {
 public:
  /// Throws FileError for two bodies or two joints of one name, a name that cannot be one, more
  /// than 50,000 bodies, joints, geoms and sites, and bodies nested deeper than 200.
  explicit MjcfNames(const MjcfDocument& document);

  /// Returns the name of an element, with_escaped_bytes(); empty: it has none. Throws FileError.
  static std::string given(const tinyxml2::XMLElement& element);

  /// Returns `wanted`, with a mark at its end if another link, or another joint, has the name.
  std::string new_link(const std::string& wanted) { return unique(wanted, links_); }
  std::string new_joint(const std::string& wanted) { return unique(wanted, joints_); }

 private:
  static std::string unique(std::string wanted, std::unordered_set<std::string>& taken);
  void collect(const MjcfDocument& document, const tinyxml2::XMLElement& parent, int depth);

  std::unordered_set<std::string> links_{"world"}, joints_;
  std::size_t elements_ = 0;
};

}  // namespace beeline::internal
