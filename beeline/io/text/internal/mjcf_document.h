#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include <beeline/io/text/internal/xml_elements.h>

namespace beeline::internal {

/// The elements of an MJCF file and of the files that it includes.
///
/// `<include file="PATH"/>` stands for the children of the root of another file. PATH is relative
/// to the folder of the model or, if no file is there, to the folder of the file that includes it.
/// It must be in the folder of the model, also after its symbolic links have been followed. Meshes
/// may be elsewhere. As in MuJoCo, each file can be included once.
class MjcfDocument {
 public:
  /// Throws FileError for text that parse_xml() refuses or whose root is not `<mujoco>`; for an
  /// include without a file, with children, of a file that is not found, empty, outside of the
  /// folder or included before; and for more than 100 files, 10 levels of includes or 8 MiB of all
  /// files.
  MjcfDocument(std::string_view text, const std::string& path);
  ~MjcfDocument();
  MjcfDocument(MjcfDocument&&) noexcept;
  MjcfDocument& operator=(MjcfDocument&&) = delete;

  const std::string& path() const;
  const tinyxml2::XMLElement& root() const;

  /// Returns the children of an element; an include is replaced by the children of its root.
  std::vector<const tinyxml2::XMLElement*> children(const tinyxml2::XMLElement& parent) const;
  /// Returns the children of all root elements called `section`, in their order.
  std::vector<const tinyxml2::XMLElement*> in_sections(std::string_view section) const;
  /// The same of the children with this tag.
  std::vector<const tinyxml2::XMLElement*> in_sections(std::string_view section,
                                                       std::string_view tag) const;

  /// Returns the reader of an element's attributes, whose errors name the element's own file.
  static const XmlElements& reader_of(const tinyxml2::XMLElement& element);

 private:
  struct File;

  File& parse(std::string_view text, const std::string& path);
  void find_includes(const File& file, int depth);
  std::string included_path(const tinyxml2::XMLElement& include) const;
  void append_children(const tinyxml2::XMLElement& parent,
                       std::vector<const tinyxml2::XMLElement*>& children) const;

  std::vector<std::unique_ptr<File>> files_;  ///< the first one is the model
  std::size_t size_ = 0;                      ///< bytes of all files
  std::unordered_set<std::string> included_paths_;
  /// The root of the included file, by the element.
  std::unordered_map<const tinyxml2::XMLElement*, const tinyxml2::XMLElement*> included_;
};

}  // namespace beeline::internal
