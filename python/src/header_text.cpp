#include "header_text.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "signature.h"

namespace beeline::python {
namespace {

struct HeaderText {
  std::string_view name;  ///< `Line`, `Line::from`
  const char* text;
};
constexpr HeaderText header_texts[] = {
#include "header_texts.inc"  // in the build folder, ascending names
};

}  // namespace

std::string header_text(std::string_view type, std::string_view member) {
  const std::string name = std::string(type) + (member.empty() ? "" : "::") + std::string(member);
  const auto* found = std::ranges::lower_bound(header_texts, name, {}, &HeaderText::name);
  return found != std::end(header_texts) && found->name == name ? found->text : "";
}

const char* comment(std::string_view name) {
  return docstring(header_text(name, ""), name, "its declaration");
}

const char* docstring(const std::string& text, std::string_view type, std::string_view member) {
  if (!text.empty()) return kept_text(text);
  throw std::logic_error(std::string(type) + "::" + std::string(member) +
                         " has no comment in its header");
}

}  // namespace beeline::python
