#include <memory>

#include <beeline/error.h>
#include <beeline/internal/letter_case.h>
#include <beeline/io/text/file.h>

namespace beeline {
namespace {

/// The new content of a file, written beside it but not yet renamed. A device has no file beside
/// it: its content is kept in memory.
class StagedFile {
 public:
  StagedFile(const std::string& path, std::string_view content) : file_(path) {
    if (file_.replaces()) {
      file_.append(content);
    } else {
      device_content_ = content;
    }
  }

  void commit() {
    file_.append(device_content_);
    file_.commit();
  }

 private:
  OutputFile file_;
  std::string device_content_;
};

}  // namespace

std::string read_file(const std::string& path) {
  InputFile file(path);
  std::string content;
  std::string buffer(std::size_t{1} << 16, '\0');
  while (const std::size_t count = file.read(buffer.data(), buffer.size())) {
    content.append(buffer, 0, count);
    if (content.size() > max_file_size) {
      throw FileError(path, 0, "is larger than " + std::to_string(max_file_size >> 20) + " MiB");
    }
  }
  return content;
}

void write_file(const std::string& path, std::string_view content) {
  StagedFile(path, content).commit();
}

void write_files(const std::vector<NewFile>& files) {
  std::vector<std::unique_ptr<StagedFile>> staged;
  for (const NewFile& file : files) {
    staged.push_back(std::make_unique<StagedFile>(file.path, file.content));
  }
  for (const auto& file : staged) file->commit();
}

std::string shell_word(std::string_view text) {
  constexpr std::string_view plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.,/:+@%";
  if (!text.empty() && text.find_first_not_of(plain) == std::string_view::npos) {
    return std::string(text);
  }
  std::string word = "'";
  for (const char letter : text) word += letter == '\'' ? "'\\''" : std::string(1, letter);
  return word + "'";
}

std::string extension(std::string_view path) {
  const std::string_view name = path.substr(path.find_last_of('/') + 1);
  const std::size_t dot = name.find_last_of('.');
  return dot == std::string_view::npos ? "" : internal::lower_case(name.substr(dot + 1));
}

}  // namespace beeline
