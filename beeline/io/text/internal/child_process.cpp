#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <system_error>

#include <beeline/error.h>
#include <beeline/io/text/internal/child_process.h>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace beeline::internal {
namespace {

// The answer of the child: one of the first two, then text, then the last: a shorter answer is cut.
constexpr char is_result = 'r', is_error = 'e', is_whole = '.';

/// Bytes of address space of this process.
std::uint64_t address_space() {
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

void set_limits(const ChildLimits& limits) {
  const auto set = [](auto which, rlim_t value) {
    rlimit limit{};
    ::getrlimit(which, &limit);
    limit.rlim_cur = std::min(value, limit.rlim_max);
    ::setrlimit(which, &limit);
  };
  set(RLIMIT_CORE, 0);
  set(RLIMIT_CPU, limits.seconds);
  set(RLIMIT_AS, address_space() + limits.memory);
  for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGXCPU, SIGPIPE}) {
    std::signal(signal, SIG_DFL);
  }
  const int nothing = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nothing >= 0) ::dup2(nothing, STDERR_FILENO);
}

std::string answer_of(const std::function<std::string()>& work) {
  try {
    return is_result + work() + is_whole;
  } catch (const FileError& error) {
    return is_error + error.fault() + is_whole;
  } catch (const std::bad_alloc&) {
    return {};  // a limit
  } catch (const std::exception& error) {
    return is_error + std::string(error.what()) + is_whole;
  }
}

void write_all(int to, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(to, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

std::string read_all(int from) {
  std::string bytes;
  std::array<char, 65536> block;
  for (;;) {
    const ssize_t count = ::read(from, block.data(), block.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return bytes;
    bytes.append(block.data(), static_cast<std::size_t>(count));
  }
}

[[noreturn]] void refuse_process(int reason) {
  throw Error("a process cannot be created: " + std::generic_category().message(reason));
}

}  // namespace

std::optional<std::string> in_child_process(const std::function<std::string()>& work,
                                            const ChildLimits& limits) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) refuse_process(errno);
  const pid_t child = ::fork();
  if (child == 0) {
    set_limits(limits);
    write_all(ends[1], answer_of(work));
    ::_exit(0);
  }
  const int reason = errno;
  ::close(ends[1]);
  std::string answer = child < 0 ? "" : read_all(ends[0]);
  ::close(ends[0]);
  if (child < 0) refuse_process(reason);
  while (::waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
  }
  if (answer.size() < 2 || answer.back() != is_whole) return std::nullopt;
  const char kind = answer.front();
  answer = answer.substr(1, answer.size() - 2);
  if (kind == is_error) throw Error(answer);
  return answer;
}

}  // namespace beeline::internal
