#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <beeline/error.h>
#include <beeline/io/text/arm.h>
#include <beeline/pose/so3.h>

namespace tinyxml2 {
class XMLElement;
}

namespace beeline::internal {

/// Returns the element's tag for a message: `<joint>`.
std::string described(const tinyxml2::XMLElement& element);

/// Refuses an element of an XML file that cannot be read.
class XmlError : public FileError {
 public:
  explicit XmlError(const ReadWarning& fault);

  ReadWarning fault;  ///< the reason, of the kind malformed
};

/// Reads attributes of the elements of one XML file. Errors of the elements are XmlErrors; all name
/// the file and the element's line.
class XmlElements {
 public:
  /// `path` must outlive this object.
  explicit XmlElements(const std::string& path) : path_(path) {}

  const std::string& path() const { return path_; }

  /// Throws FileError.
  [[noreturn]] void refuse(int line, const std::string& message) const;
  /// Throws XmlError.
  [[noreturn]] void refuse(const tinyxml2::XMLElement& element, const char* attribute,
                           ElementFault fault, std::string_view value = "") const;

  std::string needed_text(const tinyxml2::XMLElement& element, const char* attribute) const;
  /// A text that check_name() accepts.
  std::string needed_name(const tinyxml2::XMLElement& element, const char* attribute) const;
  /// Returns `name`, which the attribute gives.
  std::string checked_name(const tinyxml2::XMLElement& element, const char* attribute,
                           std::string name) const;

  /// Reads three numbers separated by blanks; returns `otherwise` when the attribute is missing.
  Vector3 vector(const tinyxml2::XMLElement& element, const char* attribute,
                 const Vector3& otherwise) const;
  /// Reads numbers separated by blanks; the attribute must be there.
  std::vector<double> numbers(const tinyxml2::XMLElement& element, const char* attribute) const;
  double number_or(const tinyxml2::XMLElement& element, const char* attribute,
                   double otherwise) const;
  /// The same for a limit, which read_limit() parses.
  double limit_or(const tinyxml2::XMLElement& element, const char* attribute,
                  double otherwise) const;

 private:
  using Read = ElementFault (*)(std::string_view text, double& value);
  double number(const tinyxml2::XMLElement& element, const char* attribute, std::string_view text,
                Read read) const;

  const std::string& path_;
};

}  // namespace beeline::internal
