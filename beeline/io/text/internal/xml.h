#pragma once

#include <string>
#include <string_view>

namespace tinyxml2 {
class XMLDocument;
}

namespace beeline::internal {

/// Parses XML text in bounded time, memory and stack. The text is UTF-8, or Latin-1 if its XML
/// declaration says so. Throws FileError for another encoding, see text_in(), for text that is not
/// well-formed XML, is nested deeper than 100 levels, is larger than 8 MiB, or has a tag with more
/// than 100 attributes.
void parse_xml(tinyxml2::XMLDocument& document, std::string_view bytes, const std::string& path);

}  // namespace beeline::internal
