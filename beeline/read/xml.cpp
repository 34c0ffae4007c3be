#include <algorithm>
#include <tinyxml2.h>

#include <beeline/error.h>
#include <beeline/read/xml.h>

namespace beeline {
namespace {

/// A parsed element takes some fifty times its text; no arm's description comes near.
constexpr std::size_t largest_xml = std::size_t{8} << 20;

/// The parser compares every attribute of a tag with all before it; no tag of ours has ten.
constexpr int max_attributes = 100;

/// Where the tag that starts at `at` ends; counts its attributes on the way.
std::size_t end_of_tag(std::string_view text, std::size_t at, int& attributes) {
  attributes = 0;
  while (at < text.size() && text[at] != '>') {
    if (text[at] == '=') ++attributes;
    if (text[at] == '"' || text[at] == '\'')
      at = std::min(text.find(text[at], at + 1), text.size());
    ++at;
  }
  return at;
}

/// The place of the first tag with too many attributes; npos when there is none. Comments and the
/// like are passed over, as the parser does.
std::size_t find_crowded_tag(std::string_view text) {
  constexpr std::string_view passages[][2] = {
      {"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<!", ">"}, {"<?", "?>"}};
  for (std::size_t at = text.find('<'); at < text.size(); at = text.find('<', at)) {
    const auto* const passage = std::ranges::find_if(
        passages, [&](const auto& marks) { return text.substr(at).starts_with(marks[0]); });
    if (passage != std::end(passages)) {
      at = text.find((*passage)[1], at + (*passage)[0].size());
      continue;
    }
    int attributes = 0;
    const std::size_t end = end_of_tag(text, at, attributes);
    if (attributes > max_attributes) return at;
    at = end;
  }
  return std::string_view::npos;
}

std::string reason(const tinyxml2::XMLDocument& document) {
  switch (document.ErrorID()) {
    case tinyxml2::XML_ERROR_EMPTY_DOCUMENT:
      return "it is empty";
    case tinyxml2::XML_ERROR_MISMATCHED_ELEMENT:
      return "an element is not closed";
    case tinyxml2::XML_ERROR_PARSING_ATTRIBUTE:
      return "an attribute is not name=\"value\", or stands there twice";
    case tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED:
      return "its elements are nested deeper than 100 levels";
    default:
      return document.ErrorName();
  }
}

}  // namespace

void parse_xml(tinyxml2::XMLDocument& document, std::string_view text, const std::string& path) {
  if (text.size() > largest_xml) throw FileError(path, 0, "is larger than 8 MiB");
  const std::size_t crowded = find_crowded_tag(text);
  if (crowded != std::string_view::npos) {
    const auto line = 1 + std::ranges::count(text.substr(0, crowded), '\n');
    throw FileError(path, static_cast<int>(line), "a tag has more than 100 attributes");
  }
  if (document.Parse(text.data(), text.size()) == tinyxml2::XML_SUCCESS) return;
  throw FileError(path, document.ErrorLineNum(), "is not whole XML: " + reason(document));
}

}  // namespace beeline
