#include <algorithm>
#include <tinyxml2.h>

#include <beeline/error.h>
#include <beeline/read/internal/limit_numbers.h>
#include <beeline/read/internal/name.h>
#include <beeline/read/internal/numbers.h>
#include <beeline/read/internal/text_encoding.h>
#include <beeline/read/internal/xml_elements.h>

namespace beeline::internal {

using tinyxml2::XMLElement;

std::string described(const XMLElement& element) { return "<" + printable(element.Name()) + ">"; }

void XmlElements::refuse(int line, const std::string& message) const {
  throw XmlError(path_, line, message);
}

std::string XmlElements::needed_text(const XMLElement& element, const char* attribute) const {
  const char* text = element.Attribute(attribute);
  if (text == nullptr) {
    refuse(element.GetLineNum(), described(element) + " needs the attribute " + attribute);
  }
  return text;
}

std::string XmlElements::needed_name(const XMLElement& element, const char* attribute) const {
  std::string name = needed_text(element, attribute);
  if (!is_utf8(name)) {
    refuse(element.GetLineNum(), described(element) + ": " + attribute + " " + in_quotes(name) +
                                     " " + std::string(not_utf8));
  }
  try {
    check_name(name, described(element) + ": " + attribute);
  } catch (const Error& error) {
    refuse(element.GetLineNum(), error.what());
  }
  return name;
}

std::vector<double> XmlElements::numbers(const XMLElement& element, const char* attribute) const {
  constexpr std::string_view blanks = " \t\r\n";
  const std::string text = needed_text(element, attribute);
  std::string_view rest = text;
  std::vector<double> values;
  for (;;) {
    rest.remove_prefix(std::min(rest.size(), rest.find_first_not_of(blanks)));
    if (rest.empty()) return values;
    const std::string_view item = rest.substr(0, rest.find_first_of(blanks));
    values.push_back(number(element, attribute, item, parse_number));
    rest.remove_prefix(item.size());
  }
}

Vector3 XmlElements::vector(const XMLElement& element, const char* attribute,
                            const Vector3& otherwise) const {
  if (element.Attribute(attribute) == nullptr) return otherwise;
  const std::vector<double> values = numbers(element, attribute);
  if (values.size() != 3) {
    refuse(element.GetLineNum(), described(element) + ": " + attribute + " has " +
                                     std::to_string(values.size()) +
                                     " numbers; it must have three, as in \"0 0 1\"");
  }
  return {values[0], values[1], values[2]};
}

double XmlElements::number_or(const XMLElement& element, const char* attribute,
                              double otherwise) const {
  const char* text = element.Attribute(attribute);
  return text == nullptr ? otherwise : number(element, attribute, text, parse_number);
}

double XmlElements::limit_or(const XMLElement& element, const char* attribute,
                             double otherwise) const {
  const char* text = element.Attribute(attribute);
  return text == nullptr ? otherwise : number(element, attribute, text, parse_limit);
}

double XmlElements::number(const XMLElement& element, const char* attribute, std::string_view text,
                           Parse parse) const {
  try {
    return parse(text, described(element) + ": " + attribute);
  } catch (const Error& error) {
    const bool macro =
        text.find("${") != std::string_view::npos || text.find("$(") != std::string_view::npos;
    refuse(element.GetLineNum(), std::string(error.what()) + (macro ? "; run xacro first" : ""));
  }
}

}  // namespace beeline::internal
