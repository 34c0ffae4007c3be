#include <algorithm>

#include <beeline/io/text/internal/link_tree.h>
#include <beeline/io/text/internal/mjcf_file.h>

namespace beeline::internal {
namespace {

/// Removes what may stand before the root: comments, declarations and blanks.
std::string_view from_root(std::string_view text) {
  constexpr std::string_view passages[][2] = {{"<!--", "-->"}, {"<?", "?>"}, {"<!", ">"}};
  for (;;) {
    text.remove_prefix(std::min(text.find('<'), text.size()));
    const auto* const passage =
        std::find_if(std::begin(passages), std::end(passages),
                     [&](const auto& marks) { return text.starts_with(marks[0]); });
    if (passage == std::end(passages)) return text;
    const std::size_t end = text.find((*passage)[1], (*passage)[0].size());
    text.remove_prefix(std::min(end, text.size()));
  }
}

}  // namespace

bool is_mjcf(std::string_view text) {
  constexpr std::string_view root = "<mujoco";
  const std::string_view found = from_root(text);
  if (!found.starts_with(root)) return false;
  return found.size() == root.size() ||
         std::string_view(" \t\r\n/>").find(found[root.size()]) != std::string_view::npos;
}

UrdfFile parse_link_tree(std::string_view text, const std::string& path) {
  return is_mjcf(text) ? read_mjcf(text, path)->file : parse_urdf(text, path);
}

UrdfShapes link_tree_shapes(std::string_view text, const std::string& path,
                            const std::map<std::string, std::string>& package, MjcfUse use) {
  return is_mjcf(text) ? mjcf_shapes(text, path, package, use)
                       : collision_shapes(text, path, package);
}

}  // namespace beeline::internal
