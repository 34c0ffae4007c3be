#pragma once

#include <string>
#include <string_view>

namespace tinyxml2 {
class XMLDocument;
}

namespace beeline {

/// Fills the document, in bounded time, memory and stack. Throws FileError for what is no whole
/// XML, nested deeper than 100 levels, larger than 8 MiB, or has a tag of over 100 attributes.
void parse_xml(tinyxml2::XMLDocument& document, std::string_view text, const std::string& path);

}  // namespace beeline
