#include <algorithm>
#include <tinyxml2.h>

#include <beeline/error.h>
#include <beeline/internal/letter_case.h>
#include <beeline/internal/utf8.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/text_encoding.h>
#include <beeline/io/text/internal/xml.h>

namespace beeline::internal {
namespace {

/// A parsed element takes about fifty times the memory of its text: 400 MiB for a text of this
/// size. URDF files of real robots stay below 1 MiB.
constexpr std::size_t max_xml_size = std::size_t{8} << 20;

/// The parser compares every attribute of a tag with all before it. URDF tags have fewer than ten.
constexpr int max_attributes = 100;

/// Returns the end of the tag that starts at `at`, and the number of its attributes.
std::size_t end_of_tag(std::string_view text, std::size_t at, int& attributes) {
  attributes = 0;
  while (at < text.size() && text[at] != '>') {
    if (text[at] == '=') ++attributes;
    if (text[at] == '"' || text[at] == '\'') {
      at = std::min(text.find(text[at], at + 1), text.size());
    }
    ++at;
  }
  return at;
}

/// Returns the position of the first tag with too many attributes; npos when there is none. Skips
/// comments, CDATA, declarations and processing instructions, as the parser does.
std::size_t find_crowded_tag(std::string_view text) {
  constexpr std::string_view passages[][2] = {
      {"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<!", ">"}, {"<?", "?>"}};
  for (std::size_t at = text.find('<'); at < text.size(); at = text.find('<', at)) {
    const auto* const passage =
        std::find_if(std::begin(passages), std::end(passages),
                     [&](const auto& marks) { return text.substr(at).starts_with(marks[0]); });
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

std::string reason(const tinyxml2::XMLDocument& document, std::string_view text) {
  switch (document.ErrorID()) {
    case tinyxml2::XML_ERROR_EMPTY_DOCUMENT:
      return "it is empty";
    case tinyxml2::XML_ERROR_MISMATCHED_ELEMENT:
      return "an element is not closed";
    case tinyxml2::XML_ERROR_PARSING_ATTRIBUTE:
      return "an attribute is not name=\"value\", or is given twice";
    case tinyxml2::XML_ERROR_PARSING_DECLARATION:
      if (text.find("?>", std::min(text.rfind("<?"), text.size())) != std::string_view::npos) {
        return "a declaration <?...?> stands below other text; remove it, the text above it, or "
               "the second document";
      }
      [[fallthrough]];
    case tinyxml2::XML_ERROR_PARSING_COMMENT:
    case tinyxml2::XML_ERROR_PARSING_CDATA:
    case tinyxml2::XML_ERROR_PARSING_UNKNOWN:
      return "a comment or a declaration has no end";
    case tinyxml2::XML_ERROR_PARSING_TEXT:
      return "text is outside of an element";
    case tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED:
      return "its elements are nested deeper than 100 levels";
    default:
      return "a tag or a name is cut off or malformed";
  }
}

/// Whether the XML declaration at the front of the text names Latin-1 as its encoding.
bool declares_latin1(std::string_view text) {
  if (!text.starts_with("<?xml")) return false;
  const std::string declaration =
      lower_case(text.substr(0, std::min(text.find("?>"), std::size_t{200})));
  const std::size_t encoding = declaration.find("encoding");
  if (encoding == std::string::npos) return false;
  const std::string value = declaration.substr(encoding);
  return value.find("iso-8859-1\"") != std::string::npos ||
         value.find("iso-8859-1'") != std::string::npos || value.find("latin") != std::string::npos;
}

}  // namespace

void parse_xml(tinyxml2::XMLDocument& document, std::string_view bytes, const std::string& path) {
  if (bytes.size() > max_xml_size) throw FileError(path, 0, "is larger than 8 MiB");
  std::string_view text = text_in(bytes, path);
  std::string utf8;
  if (declares_latin1(text) && !is_utf8(text)) text = utf8 = utf8_of_latin1(text);
  const std::size_t crowded = find_crowded_tag(text);
  if (crowded != std::string_view::npos) {
    const auto line = 1 + std::count(text.begin(), text.begin() + crowded, '\n');
    throw FileError(path, static_cast<int>(line), "a tag has more than 100 attributes");
  }
  if (document.Parse(text.data(), text.size()) == tinyxml2::XML_SUCCESS) return;
  throw FileError(path, document.ErrorLineNum(),
                  "is not well-formed XML: " + reason(document, text));
}

}  // namespace beeline::internal
