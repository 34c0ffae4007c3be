#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include <beeline/io/text/internal/mjcf_document.h>

namespace beeline::internal {

/// The attributes that give an orientation.
inline constexpr const char* mjcf_orientations[] = {"quat", "axisangle", "xyaxes", "zaxis",
                                                    "euler"};

/// The default classes of an MJCF file: `<default class="a"><joint .../><default class="b">...`.
/// A class has the attributes of the class around it, except those that it gives itself.
class MjcfDefaults {
 public:
  static constexpr std::size_t main_class = 0;

  /// `document` must outlive this object. Throws FileError for a class without a name, a name given
  /// twice, more than 10,000 classes, and classes nested deeper than 20.
  explicit MjcfDefaults(const MjcfDocument& document);

  /// Returns the class that an attribute, `class` or `childclass`, names; without it `otherwise`.
  /// Throws FileError for an unknown name.
  std::size_t class_of(const tinyxml2::XMLElement& element, const char* attribute,
                       std::size_t otherwise) const;

  /// An element that gives an attribute.
  struct Source {
    const tinyxml2::XMLElement* element = nullptr;
    std::size_t level = 0;  ///< 0: itself; 1: its class; 2: the class around that; and so on
  };

  /// Returns the elements of a class and of those around it that give an attribute of elements with
  /// a tag, the innermost first.
  std::vector<Source> sources(std::string_view tag, std::size_t of_class,
                              std::string_view attribute) const;

 private:
  using Key = std::pair<std::string_view, std::string_view>;  ///< tag and attribute
  struct Class {
    std::string name;  ///< empty: the class main as it was
    std::optional<std::size_t> around;
    std::map<Key, const tinyxml2::XMLElement*> elements = {};
  };

  void keep_main(const tinyxml2::XMLElement& next);
  void read(const tinyxml2::XMLElement& element, std::size_t own, int depth);

  const MjcfDocument* document_;
  std::vector<Class> classes_;
  int copies_ = 0;  ///< of main, among the classes
  std::unordered_map<std::string, std::size_t> by_name_;
};

/// The attributes of an element of an MJCF file, its own and the attributes of its default class.
/// Errors name the line of the element that gives the attribute.
class MjcfAttributes {
 public:
  /// All arguments must outlive this object. Without defaults the element has its own attributes.
  MjcfAttributes(const tinyxml2::XMLElement& element, const MjcfDefaults* defaults = nullptr,
                 std::size_t of_class = MjcfDefaults::main_class)
      : element_(&element), defaults_(defaults), class_(of_class) {}

  const tinyxml2::XMLElement& element() const { return *element_; }
  int line() const;
  /// Returns the element that gives an attribute; null if none does.
  const tinyxml2::XMLElement* source(const char* attribute) const;
  /// Returns the level of the source; none without one.
  std::optional<std::size_t> level(const char* attribute) const;
  int line_of(const char* attribute) const;  ///< of the source; without one the element's

  std::string text_or(const char* attribute, const std::string& otherwise) const;
  double number_or(const char* attribute, double otherwise) const;
  Vector3 vector(const char* attribute, const Vector3& otherwise) const;
  /// Returns exactly `count` numbers, or none if the attribute is not given.
  std::vector<double> numbers(const char* attribute, std::size_t count) const;
  /// Returns `values` with those replaced that the attribute gives, at most all. As in MuJoCo, an
  /// element that gives fewer keeps the others of its class.
  std::vector<double> some_numbers(const char* attribute, std::vector<double> values) const;
  /// Returns the index of the attribute's text in `choices`, or of `otherwise`. Throws FileError.
  std::string choice(const char* attribute, const std::vector<std::string>& choices,
                     const std::string& otherwise) const;

  /// Throws FileError at the line of the attribute's source, or of the element.
  [[noreturn]] void refuse(const char* attribute, const std::string& message) const;

 private:
  /// The element, its class and the classes around it, as far as they give the attribute.
  std::vector<MjcfDefaults::Source> sources(const char* attribute) const;

  const tinyxml2::XMLElement* element_;
  const MjcfDefaults* defaults_;
  std::size_t class_;
};

/// Refuses an attribute that MJCF does not have and that resembles one of `known`, which would
/// otherwise be ignored. Other unknown ones are of another version of MuJoCo.
void refuse_misspelt_attribute(const tinyxml2::XMLElement& element,
                               const std::vector<std::string>& known);

/// The same of the tag of an element.
void refuse_misspelt_tag(const tinyxml2::XMLElement& element,
                         const std::vector<std::string>& known);

}  // namespace beeline::internal
