#include <algorithm>
#include <filesystem>
#include <system_error>
#include <tinyxml2.h>

#include <beeline/error.h>
#include <beeline/io/text/file.h>
#include <beeline/io/text/internal/mjcf_document.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/xml.h>

namespace beeline::internal {
namespace {

using tinyxml2::XMLElement;

constexpr std::size_t max_mjcf_files = 100;
constexpr std::size_t max_mjcf_size = std::size_t{8} << 20;  // as of one file, see parse_xml()
constexpr int max_include_depth = 10;

/// The folder of a file, which the included files must not leave.
std::filesystem::path folder_of(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  return folder.empty() ? "." : folder;
}

/// Whether a path without symbolic links is below a folder without symbolic links.
bool is_inside(const std::filesystem::path& path, const std::filesystem::path& folder) {
  const auto [end, unused] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  return end == folder.end();
}

bool is_include(const XMLElement& element) { return std::string_view(element.Name()) == "include"; }

}  // namespace

struct MjcfDocument::File {
  explicit File(std::string of_file) : path(std::move(of_file)), reader(path) {}

  std::string path;
  XmlElements reader;
  tinyxml2::XMLDocument document;
};

MjcfDocument::MjcfDocument(std::string_view text, const std::string& path) {
  const File& model = parse(text, path);
  const XMLElement* const found = model.document.RootElement();
  if (found == nullptr || std::string_view(found->Name()) != "mujoco") {
    model.reader.refuse(found == nullptr ? 0 : found->GetLineNum(),
                        "is not MJCF: its root must be <mujoco>, not " +
                            (found == nullptr ? "nothing" : described(*found)));
  }
  find_includes(model, 0);
}

MjcfDocument::~MjcfDocument() = default;
MjcfDocument::MjcfDocument(MjcfDocument&&) noexcept = default;

const std::string& MjcfDocument::path() const { return files_.front()->path; }

const XMLElement& MjcfDocument::root() const { return *files_.front()->document.RootElement(); }

const XmlElements& MjcfDocument::reader_of(const XMLElement& element) {
  return *static_cast<const XmlElements*>(element.GetDocument()->GetUserData());
}

MjcfDocument::File& MjcfDocument::parse(std::string_view text, const std::string& path) {
  size_ += text.size();
  if (size_ > max_mjcf_size) {
    throw FileError(files_.empty() ? path : this->path(), 0,
                    "is larger than 8 MiB, with the files that it includes");
  }
  files_.push_back(std::make_unique<File>(path));
  File& file = *files_.back();
  parse_xml(file.document, text, file.path);
  file.document.SetUserData(&file.reader);
  return file;
}

/// Parses the files that a file includes, and theirs.
void MjcfDocument::find_includes(const File& file, int depth) {
  std::vector<const XMLElement*> pending{file.document.RootElement()};
  while (!pending.empty()) {
    const XMLElement* const parent = pending.back();
    pending.pop_back();
    for (const XMLElement* at = parent->FirstChildElement(); at; at = at->NextSiblingElement()) {
      pending.push_back(at);
      if (!is_include(*at)) continue;
      const int line = at->GetLineNum();
      if (at->FirstChildElement() != nullptr) file.reader.refuse(line, "<include> has children");
      if (depth == max_include_depth) {
        file.reader.refuse(line, "includes are nested deeper than " +
                                     std::to_string(max_include_depth) + " files");
      }
      if (files_.size() > max_mjcf_files) {
        file.reader.refuse(line,
                           "more than " + std::to_string(max_mjcf_files) + " files are included");
      }
      const std::string path = included_path(*at);
      if (!included_paths_.insert(path).second) {
        file.reader.refuse(line, in_quotes(at->Attribute("file")) +
                                     " is included twice; a file can be included once");
      }
      const File& included = parse(read_file(path), path);
      const XMLElement* const root = included.document.RootElement();
      if (root == nullptr || root->FirstChildElement() == nullptr) {
        included.reader.refuse(0, "has no element to include");
      }
      included_.emplace(at, root);
      find_includes(included, depth + 1);
    }
  }
}

/// Returns the path of an included file without symbolic links. Refuses one outside the folder.
std::string MjcfDocument::included_path(const XMLElement& include) const {
  const XmlElements& reader = reader_of(include);
  const std::string name = reader.needed_text(include, "file");
  std::error_code fault;
  const std::filesystem::path folder = std::filesystem::canonical(folder_of(path()), fault);
  bool outside = false;
  for (const std::string& from : {path(), reader.path()}) {
    if (fault) break;
    const std::filesystem::path at = std::filesystem::canonical(folder_of(from) / name, fault);
    if (!fault && std::filesystem::is_regular_file(at, fault)) {
      if (is_inside(at, folder)) return at.string();
      outside = true;
    }
    fault.clear();
  }
  reader.refuse(include.GetLineNum(),
                "the included file " + in_quotes(name) +
                    (outside ? " is outside of the folder of the model; copy the "
                               "model and what it includes into one folder"
                             : " is not found in the folder of the model"));
}

void MjcfDocument::append_children(const XMLElement& parent,
                                   std::vector<const XMLElement*>& children) const {
  for (const XMLElement* at = parent.FirstChildElement(); at; at = at->NextSiblingElement()) {
    const auto found = included_.find(at);
    found == included_.end() ? children.push_back(at) : append_children(*found->second, children);
  }
}

std::vector<const XMLElement*> MjcfDocument::children(const XMLElement& parent) const {
  std::vector<const XMLElement*> found;
  append_children(parent, found);
  return found;
}

std::vector<const XMLElement*> MjcfDocument::in_sections(std::string_view section) const {
  std::vector<const XMLElement*> found;
  for (const XMLElement* of_root : children(root())) {
    if (of_root->Name() == section) append_children(*of_root, found);
  }
  return found;
}

std::vector<const XMLElement*> MjcfDocument::in_sections(std::string_view section,
                                                         std::string_view tag) const {
  std::vector<const XMLElement*> found;
  for (const XMLElement* at : in_sections(section)) {
    if (at->Name() == tag) found.push_back(at);
  }
  return found;
}

}  // namespace beeline::internal
