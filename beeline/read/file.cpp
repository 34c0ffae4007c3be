#include <atomic>
#include <cerrno>
#include <filesystem>
#include <memory>
#include <system_error>

#include <beeline/error.h>
#include <beeline/read/file.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace beeline {
namespace {

FileError refused(const std::string& path, const std::string& what, int reason) {
  return {path, 0, what + ": " + std::generic_category().message(reason)};
}

/// An open file that is closed again, whatever happens.
struct Descriptor {
  explicit Descriptor(int opened) : number(opened) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
  int number;
};

/// 0, or the system's reason.
int write_all(int descriptor, std::string_view content) {
  while (!content.empty()) {
    const ssize_t count = ::write(descriptor, content.data(), content.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno;
    content.remove_prefix(static_cast<std::size_t>(count));
  }
  return 0;
}

/// The file behind a symbolic link, so that a rename replaces the file and not the link.
std::string target_of(const std::string& path) {
  std::error_code unresolved;
  const std::filesystem::path target = std::filesystem::canonical(path, unresolved);
  return unresolved ? path : target.string();
}

void write_straight(const std::string& path, std::string_view content) {
  const Descriptor file(::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC));
  const int reason = file.number < 0 ? errno : write_all(file.number, content);
  if (reason != 0) throw refused(path, "cannot be written", reason);
}

/// A file's new content beside it, not yet in its place; gone again unless it is put there.
class Staged {
 public:
  Staged(const std::string& path, std::string_view content) : path_(path) {
    struct stat status {};
    const bool exists = ::stat(path.c_str(), &status) == 0;
    if (exists && S_ISDIR(status.st_mode)) {
      throw FileError(path, 0, "cannot be written: it is a folder");
    }
    // Devices and pipes cannot be replaced; /dev/stdout may be a regular file others fill too.
    if (exists && (!S_ISREG(status.st_mode) || path.starts_with("/dev/"))) {
      straight_ = content;
      return;
    }
    // A rename would get round the file's own write protection.
    if (exists && ::faccessat(AT_FDCWD, path.c_str(), W_OK, AT_EACCESS) != 0) {
      throw refused(path, "cannot be written", errno);
    }
    static std::atomic<unsigned> written{0};
    target_ = target_of(path);
    beside_ =
        target_ + "." + std::to_string(::getpid()) + "-" + std::to_string(written++) + ".part";
    const int reason = write_beside(exists ? &status : nullptr, content);
    if (reason != 0) throw refused(path, "cannot be written", reason);
  }
  Staged(const Staged&) = delete;
  Staged& operator=(const Staged&) = delete;
  ~Staged() {
    if (!beside_.empty()) ::unlink(beside_.c_str());
  }

  void put_in_place() {
    if (beside_.empty()) return write_straight(path_, straight_);
    if (::rename(beside_.c_str(), target_.c_str()) != 0) {
      throw refused(path_, "cannot be written", errno);
    }
    beside_.clear();
  }

 private:
  /// 0, or the system's reason; then nothing is left behind.
  int write_beside(const struct stat* old, std::string_view content) {
    Descriptor file(::open(beside_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (file.number < 0) return errno;
    if (old != nullptr) (void)!::fchmod(file.number, old->st_mode & 07777);
    int reason = write_all(file.number, content);
    if (::close(file.number) != 0 && reason == 0) reason = errno;
    file.number = -1;
    if (reason != 0) ::unlink(beside_.c_str());
    return reason;
  }

  std::string path_, target_, beside_;
  std::string straight_;  ///< for a device
};

}  // namespace

std::string read_file(const std::string& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat status {};
  if (file.number < 0 || ::fstat(file.number, &status) != 0) {
    throw refused(path, "cannot be read", errno);
  }
  if (S_ISDIR(status.st_mode)) throw FileError(path, 0, "is a folder, not a file");
  std::string content;
  std::string buffer(std::size_t{1} << 16, '\0');
  for (;;) {
    const ssize_t count = ::read(file.number, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw refused(path, "cannot be read", errno);
    if (count == 0) return content;
    content.append(buffer, 0, static_cast<std::size_t>(count));
    if (content.size() > largest_file) {
      throw FileError(path, 0, "is larger than " + std::to_string(largest_file >> 20) + " MiB");
    }
  }
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
