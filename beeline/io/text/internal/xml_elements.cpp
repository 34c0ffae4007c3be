#include <algorithm>
#include <tinyxml2.h>

#include <beeline/error.h>
#include <beeline/internal/nearest_name.h>
#include <beeline/io/text/internal/limit_numbers.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/numbers.h>
#include <beeline/io/text/internal/read_fault.h>
#include <beeline/io/text/internal/xml_elements.h>

namespace beeline::internal {

using tinyxml2::XMLElement;

namespace {

/// The attribute of an element that is nearly of this name; empty if there is none.
std::string attribute_like(const XMLElement& element, const char* name) {
  for (const auto* at = element.FirstAttribute(); at != nullptr; at = at->Next()) {
    if (nearest_name(at->Name(), {name}) != nullptr) return printable(at->Name());
  }
  return "";
}

}  // namespace

XmlError::XmlError(const ReadWarning& fault)
    : FileError(fault.path, fault.line, clause(fault)), fault(fault) {}

std::string described(const XMLElement& element) { return "<" + printable(element.Name()) + ">"; }

void XmlElements::refuse(int line, const std::string& message) const {
  throw FileError(path_, line, message);
}

void XmlElements::refuse(const XMLElement& element, const char* attribute, ElementFault fault,
                         std::string_view value) const {
  const bool missing = fault == ElementFault::missing_attribute;
  throw XmlError(
      {.path = path_,
       .line = element.GetLineNum(),
       .element = described(element),
       .element_fault = fault,
       .attribute = attribute,
       .value = missing ? attribute_like(element, attribute) : with_escaped_bytes(value)});
}

std::string XmlElements::needed_text(const XMLElement& element, const char* attribute) const {
  const char* text = element.Attribute(attribute);
  if (text == nullptr) refuse(element, attribute, ElementFault::missing_attribute);
  return text;
}

std::string XmlElements::needed_name(const XMLElement& element, const char* attribute) const {
  return checked_name(element, attribute, needed_text(element, attribute));
}

std::string XmlElements::checked_name(const XMLElement& element, const char* attribute,
                                      std::string name) const {
  const ElementFault fault = name_fault(name);
  if (fault != ElementFault::none) refuse(element, attribute, fault, name);
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
    values.push_back(number(element, attribute, item, read_number));
    rest.remove_prefix(item.size());
  }
}

Vector3 XmlElements::vector(const XMLElement& element, const char* attribute,
                            const Vector3& otherwise) const {
  if (element.Attribute(attribute) == nullptr) return otherwise;
  const std::vector<double> values = numbers(element, attribute);
  if (values.size() != 3) {
    throw XmlError({.path = path_,
                    .line = element.GetLineNum(),
                    .element = described(element),
                    .element_fault = ElementFault::not_three_numbers,
                    .attribute = attribute,
                    .count = values.size()});
  }
  return {values[0], values[1], values[2]};
}

double XmlElements::number_or(const XMLElement& element, const char* attribute,
                              double otherwise) const {
  const char* text = element.Attribute(attribute);
  return text == nullptr ? otherwise : number(element, attribute, text, read_number);
}

double XmlElements::limit_or(const XMLElement& element, const char* attribute,
                             double otherwise) const {
  const char* text = element.Attribute(attribute);
  return text == nullptr ? otherwise : number(element, attribute, text, read_limit);
}

double XmlElements::number(const XMLElement& element, const char* attribute, std::string_view text,
                           Read read) const {
  double value = 0;
  const ElementFault fault = read(text, value);
  if (fault != ElementFault::none) refuse(element, attribute, fault, text);
  return value;
}

}  // namespace beeline::internal
