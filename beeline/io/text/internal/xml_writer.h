#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace beeline::internal {

/// Stands in a file for a position limit that its format cannot omit, rad or m: readers take it for
/// none, see no_upper_limit().
constexpr double no_limit = 1e9;

/// Writes XML, an element a line, indented by two blanks.
class XmlWriter {
 public:
  /// An element that is open as long as this object lives.
  class Element {
   public:
    Element(XmlWriter& xml, const char* tag) : xml_(xml) { xml_.open(tag); }
    ~Element() { xml_.close(); }
    Element(const Element&) = delete;
    Element& operator=(const Element&) = delete;

   private:
    XmlWriter& xml_;
  };

  /// Adds an attribute to the element that has been opened last, before its children.
  void add(const char* attribute, std::string_view value);
  void comment(const char* text);
  const std::string& text() const { return text_; }

 private:
  void open(const char* tag);
  void close();
  void begin_line();

  std::string text_ = "<?xml version=\"1.0\"?>\n";
  std::vector<std::string> tags_ = {};  ///< of the open elements
  bool in_tag_ = false;                 ///< the last tag is not complete
};

}  // namespace beeline::internal
