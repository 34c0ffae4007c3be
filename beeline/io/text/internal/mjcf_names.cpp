#include <tinyxml2.h>

#include <beeline/error.h>
#include <beeline/io/text/internal/mjcf_names.h>
#include <beeline/io/text/internal/name.h>

namespace beeline::internal {
namespace {

using tinyxml2::XMLElement;

constexpr std::size_t max_mjcf_elements = 50'000;  // bounds memory: a joint takes 600 bytes
constexpr int max_body_depth = 200;                // bounds the stack

}  // namespace

MjcfNames::MjcfNames(const MjcfDocument& document) {
  for (const XMLElement* at : document.children(document.root())) {
    if (std::string_view(at->Name()) == "worldbody") collect(document, *at, 0);
  }
}

std::string MjcfNames::given(const XMLElement& element) {
  const char* const bytes = element.Attribute("name");
  if (bytes == nullptr || *bytes == 0) return "";
  return MjcfDocument::reader_of(element).checked_name(element, "name", with_escaped_bytes(bytes));
}

void MjcfNames::collect(const MjcfDocument& document, const XMLElement& parent, int depth) {
  for (const XMLElement* at : document.children(parent)) {
    const XmlElements& reader = MjcfDocument::reader_of(*at);
    if (++elements_ > max_mjcf_elements) {
      reader.refuse(at->GetLineNum(), "has more than 50000 elements in <worldbody>");
    }
    if (depth == max_body_depth) {
      reader.refuse(at->GetLineNum(), "bodies are nested deeper than 200");
    }
    const std::string_view tag = at->Name();
    const bool is_body = tag == "body", is_joint = tag == "joint" || tag == "freejoint";
    if (is_body || is_joint) {
      const std::string name = given(*at);
      if (!name.empty() && !(is_body ? links_ : joints_).insert(name).second) {
        reader.refuse(at->GetLineNum(), std::string("two ") + (is_body ? "bodies" : "joints") +
                                            " have the name " + name);
      }
    }
    if (is_body || tag == "frame") collect(document, *at, depth + 1);
  }
}

std::string MjcfNames::unique(std::string wanted, std::unordered_set<std::string>& taken) {
  while (!taken.insert(wanted).second) wanted += "_";
  return wanted;
}

}  // namespace beeline::internal
