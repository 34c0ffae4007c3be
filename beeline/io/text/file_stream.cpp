#include <atomic>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include <beeline/error.h>
#include <beeline/io/text/file.h>
#include <beeline/io/text/internal/temporary_file.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace beeline {
namespace {

FileError refused(const std::string& path, const std::string& what, int reason) {
  return {path, 0, what + ": " + std::generic_category().message(reason)};
}

/// Returns the path by which the system names an open file.
std::string descriptor_path(int descriptor) {
  return "/proc/self/fd/" + std::to_string(descriptor);
}

/// Opens a file without a name, which the system deletes when the program ends early. Returns -1
/// where this is not possible, or where the file could not be named later.
int open_nameless(const std::string& target) {
#ifdef O_TMPFILE
  const std::string folder = std::filesystem::path(target).parent_path().string();
  const int descriptor =
      ::open(folder.empty() ? "." : folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
  if (descriptor < 0 || ::access(descriptor_path(descriptor).c_str(), F_OK) == 0) return descriptor;
  ::close(descriptor);
#else
  (void)target;
#endif
  return -1;
}

}  // namespace

std::string internal::file_replaced_at(const std::string& path) {
  std::error_code unresolved;
  const std::filesystem::path target = std::filesystem::canonical(path, unresolved);
  if (!unresolved) return target.string();
  // A link whose target does not exist: the target is created, and the link stays.
  const std::filesystem::path link(path), there = std::filesystem::read_symlink(link, unresolved);
  return unresolved ? path : (link.parent_path() / there).string();
}

std::string internal::temporary_beside(const std::string& target) {
  static std::atomic<unsigned> written{0};
  char host[65] = "";
  ::gethostname(host, sizeof host - 1);
  return target + "." + host + "-" + std::to_string(::getpid()) + "-" + std::to_string(written++) +
         ".part";
}

InputFile::InputFile(const std::string& path, Dash dash) : path_(path) {
  const bool standard = path == "-" && dash == Dash::standard;
  if (standard) path_ = "stdin";
  descriptor_ = standard ? ::dup(STDIN_FILENO) : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  struct stat status {};
  if (descriptor_ < 0 || ::fstat(descriptor_, &status) != 0) {
    const int reason = errno;
    if (descriptor_ >= 0) ::close(descriptor_);
    throw refused(path_, "cannot be read", reason);
  }
  if (S_ISDIR(status.st_mode)) {
    ::close(descriptor_);
    throw FileError(path_, 0, "is a folder, not a file");
  }
  if (S_ISREG(status.st_mode) && !standard) size_ = static_cast<std::uint64_t>(status.st_size);
}

InputFile::~InputFile() { ::close(descriptor_); }

std::size_t InputFile::read(char* bytes, std::size_t wanted) {
  const std::size_t peeked = peeked_.copy(bytes, wanted);
  peeked_.erase(0, peeked);
  const std::size_t count = peeked + read_from_system(bytes + peeked, wanted - peeked);
  position_ += count;
  return count;
}

std::string_view InputFile::peek(std::size_t wanted) {
  const std::size_t before = peeked_.size();
  if (before < wanted) {
    peeked_.resize(wanted);
    peeked_.resize(before + read_from_system(peeked_.data() + before, wanted - before));
  }
  return std::string_view(peeked_).substr(0, wanted);
}

std::size_t InputFile::read_from_system(char* bytes, std::size_t wanted) {
  std::size_t filled = 0;
  while (filled < wanted) {
    const ssize_t count = ::read(descriptor_, bytes + filled, wanted - filled);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw refused(path_, "cannot be read", errno);
    if (count == 0) break;
    filled += static_cast<std::size_t>(count);
  }
  return filled;
}

OutputFile::OutputFile(const std::string& path, Dash dash)
    : path_(path), standard_(path == "-" && dash == Dash::standard) {
  const bool standard = standard_;
  if (standard) path_ = "stdout";
  struct stat status {};
  const bool exists = standard || ::stat(path.c_str(), &status) == 0;
  if (!standard && exists && S_ISDIR(status.st_mode)) {
    throw FileError(path_, 0, "cannot be written: it is a folder");
  }
  // Devices and pipes cannot be replaced; /dev/stdout may be a regular file with other writers.
  if (standard || (exists && (!S_ISREG(status.st_mode) || path.starts_with("/dev/")))) {
    replaces_ = false;
    descriptor_ =
        standard ? ::dup(STDOUT_FILENO) : ::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
    if (descriptor_ < 0) throw refused(path_, "cannot be written", errno);
    return;
  }
  // A rename would ignore the write protection of the file itself.
  if (exists && ::faccessat(AT_FDCWD, path.c_str(), W_OK, AT_EACCESS) != 0) {
    throw refused(path_, "cannot be written", errno);
  }
  target_ = internal::file_replaced_at(path);
  descriptor_ = open_nameless(target_);
  if (descriptor_ < 0) {
    temporary_ = internal::temporary_beside(target_);
    descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0) throw refused(path_, "cannot be written", errno);
  }
  if (exists) (void)!::fchmod(descriptor_, status.st_mode & 07777);
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void OutputFile::append(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && errno == EPIPE && standard_) throw ClosedPipe(path_);
    if (count < 0) throw refused(path_, "cannot be written", errno);
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

void OutputFile::overwrite_front(std::string_view bytes) {
  const ssize_t count = ::pwrite(descriptor_, bytes.data(), bytes.size(), 0);
  if (count < 0) throw refused(path_, "cannot be written", errno);
  if (static_cast<std::size_t>(count) != bytes.size()) {
    throw refused(path_, "cannot be written", ENOSPC);
  }
}

void OutputFile::commit() {
  if (replaces_ && temporary_.empty()) {
    const std::string temporary = internal::temporary_beside(target_);
    if (::linkat(AT_FDCWD, descriptor_path(descriptor_).c_str(), AT_FDCWD, temporary.c_str(),
                 AT_SYMLINK_FOLLOW) != 0) {
      throw refused(path_, "cannot be written", errno);
    }
    temporary_ = temporary;
  }
  const int descriptor = descriptor_;
  descriptor_ = -1;
  if (::close(descriptor) != 0) throw refused(path_, "cannot be written", errno);
  if (!replaces_) return;
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) {
    throw refused(path_, "cannot be written", errno);
  }
  temporary_.clear();
}

}  // namespace beeline
