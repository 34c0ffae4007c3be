#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <beeline/error.h>
#include <beeline/pose/so3.h>

namespace tinyxml2 {
class XMLElement;
}

namespace beeline::internal {

/// Returns the element's tag for a message: `<joint>`.
std::string described(const tinyxml2::XMLElement& element);

/// Refuses an element of an XML file.
class XmlError : public FileError {
 public:
  XmlError(std::string_view path, int line, const std::string& clause)
      : FileError(path, line, clause), line(line), clause(clause) {}

  int line;
  std::string clause;  ///< the message without the file and the line
};

/// Reads attributes of the elements of one XML file. Every error is an XmlError that names the file
/// and the element's line.
class XmlElements {
 public:
  /// `path` must outlive this object.
  explicit XmlElements(const std::string& path) : path_(path) {}

  [[noreturn]] void refuse(int line, const std::string& message) const;

  std::string needed_text(const tinyxml2::XMLElement& element, const char* attribute) const;
  /// A text that check_name() accepts.
  std::string needed_name(const tinyxml2::XMLElement& element, const char* attribute) const;

  /// Reads three numbers separated by blanks; returns `otherwise` when the attribute is missing.
  Vector3 vector(const tinyxml2::XMLElement& element, const char* attribute,
                 const Vector3& otherwise) const;
  /// Reads numbers separated by blanks; the attribute must be there.
  std::vector<double> numbers(const tinyxml2::XMLElement& element, const char* attribute) const;
  double number_or(const tinyxml2::XMLElement& element, const char* attribute,
                   double otherwise) const;
  /// The same for a limit, which parse_limit() parses.
  double limit_or(const tinyxml2::XMLElement& element, const char* attribute,
                  double otherwise) const;

 private:
  using Parse = double (*)(std::string_view text, std::string_view what);
  double number(const tinyxml2::XMLElement& element, const char* attribute, std::string_view text,
                Parse parse) const;

  const std::string& path_;
};

}  // namespace beeline::internal
