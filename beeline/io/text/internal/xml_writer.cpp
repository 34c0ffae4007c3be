#include <beeline/io/text/internal/xml_writer.h>

namespace beeline::internal {
namespace {

const char* xml_entity(char c) {
  switch (c) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    default:
      return nullptr;
  }
}

}  // namespace

void XmlWriter::add(const char* attribute, std::string_view value) {
  text_ += std::string(" ") + attribute + "=\"";
  for (const char c : value) {
    const char* const entity = xml_entity(c);
    entity == nullptr ? text_ += c : text_ += entity;
  }
  text_ += '"';
}

void XmlWriter::comment(const char* text) {
  begin_line();
  text_ += std::string("<!-- ") + text + " -->\n";
}

/// Completes the tag before, and indents.
void XmlWriter::begin_line() {
  if (in_tag_) text_ += ">\n";
  in_tag_ = false;
  text_.append(2 * tags_.size(), ' ');
}

void XmlWriter::open(const char* tag) {
  begin_line();
  text_ += std::string("<") + tag;
  tags_.emplace_back(tag);
  in_tag_ = true;
}

void XmlWriter::close() {
  const std::string tag = tags_.back();
  tags_.pop_back();
  if (in_tag_) {
    text_ += "/>\n";
    in_tag_ = false;
    return;
  }
  begin_line();
  text_ += "</" + tag + ">\n";
}

}  // namespace beeline::internal
