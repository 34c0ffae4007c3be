#include <memory>

#include <beeline/error.h>
#include <beeline/read/file.h>
#include <beeline/read/file_stream.h>

namespace beeline {
namespace {

/// A file's new content beside it, not yet in its place; for a device, kept until then.
class Staged {
 public:
  Staged(const std::string& path, std::string_view content) : file_(path) {
    if (file_.replaces()) {
      file_.append(content);
    } else {
      straight_ = content;
    }
  }

  void put_in_place() {
    file_.append(straight_);
    file_.put_in_place();
  }

 private:
  OutputFile file_;
  std::string straight_;
};

}  // namespace

std::string read_file(const std::string& path) {
  InputFile file(path);
  std::string content;
  std::string buffer(std::size_t{1} << 16, '\0');
  while (const std::size_t count = file.read(buffer.data(), buffer.size())) {
    content.append(buffer, 0, count);
    if (content.size() > largest_file) {
      throw FileError(path, 0, "is larger than " + std::to_string(largest_file >> 20) + " MiB");
    }
  }
  return content;
}

void write_file(const std::string& path, std::string_view content) {
  Staged(path, content).put_in_place();
}

void write_files(const std::vector<NewFile>& files) {
  std::vector<std::unique_ptr<Staged>> staged;
  for (const NewFile& file : files) {
    staged.push_back(std::make_unique<Staged>(file.path, file.content));
  }
  for (const auto& file : staged) file->put_in_place();
}

std::string extension(std::string_view path) {
  const std::string_view name = path.substr(path.find_last_of('/') + 1);
  const std::size_t dot = name.find_last_of('.');
  std::string text(dot == std::string_view::npos ? "" : name.substr(dot + 1));
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c + 32);
  }
  return text;
}

}  // namespace beeline
