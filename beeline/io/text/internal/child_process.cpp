#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <exception>
#include <fstream>
#include <new>
#include <system_error>

#include <beeline/error.h>
#include <beeline/io/text/internal/child_process.h>

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#if __has_include(<sys/prctl.h>)
#include <sys/prctl.h>
#endif

namespace beeline::internal {
namespace {

// The answer of the child: its length, then one of these, then text.
constexpr char is_result = 'r', is_error = 'e';
using Length = std::uint64_t;
using Clock = std::chrono::steady_clock;

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
  for (const int signal :
       {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGXCPU, SIGPIPE, SIGINT, SIGTERM}) {
    std::signal(signal, SIG_DFL);
  }
  const int nothing = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nothing >= 0) ::dup2(nothing, STDERR_FILENO);
}

/// Ends this process when its parent ends, where the system can.
void end_with(pid_t parent) {
#ifdef PR_SET_PDEATHSIG
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
  if (::getppid() != parent) ::_exit(1);  // it ended before
}

std::string answer_of(const std::function<std::string()>& work) {
  try {
    return is_result + work();
  } catch (const FileError& error) {
    return is_error + error.fault();
  } catch (const std::bad_alloc&) {
    return {};  // a limit
  } catch (const std::exception& error) {
    return is_error + std::string(error.what());
  }
}

bool write_all(int to, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(to, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

/// What the child does. It must not return into the caller, of which it is a copy.
[[noreturn]] void run_child(int to, pid_t parent, const std::function<std::string()>& work,
                            const ChildLimits& limits) noexcept {
  bool is_written = false;
  try {
    end_with(parent);
    set_limits(limits);
    const std::string answer = answer_of(work);
    const Length length = answer.size();
    is_written = write_all(to, {reinterpret_cast<const char*>(&length), sizeof length}) &&
                 write_all(to, answer);
  } catch (...) {  // exceptions of other types, and no memory for the answer
  }
  ::_exit(is_written ? 0 : 1);
}

/// Appends what the child writes until `bytes` has this size. Returns false at the end or deadline.
bool read_up_to(std::size_t size, int from, Clock::time_point deadline, std::string& bytes) {
  std::array<char, 65536> block;
  while (bytes.size() < size) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now());
    if (left.count() <= 0) return false;
    pollfd ready{.fd = from, .events = POLLIN, .revents = 0};
    const int found = ::poll(&ready, 1, static_cast<int>(left.count()));
    if (found == 0 || (found < 0 && errno == EINTR)) continue;
    if (found < 0) return false;
    const ssize_t count = ::read(from, block.data(), std::min(block.size(), size - bytes.size()));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes.append(block.data(), static_cast<std::size_t>(count));
  }
  return true;
}

std::optional<std::string> read_answer(int from, const ChildLimits& limits) {
  const Clock::time_point deadline = Clock::now() + std::chrono::seconds(limits.seconds);
  std::string front, answer;
  Length length = 0;
  if (!read_up_to(sizeof length, from, deadline, front)) return std::nullopt;
  std::memcpy(&length, front.data(), sizeof length);
  if (length == 0 || !read_up_to(length, from, deadline, answer)) return std::nullopt;
  return answer;
}

/// Waits for the end of the child; returns whether it succeeded, as far as is known: if the host
/// ignores SIGCHLD, the system keeps no status.
bool has_succeeded(pid_t child) {
  int status = 0;
  pid_t found = -1;
  do {
    found = ::waitpid(child, &status, 0);
  } while (found < 0 && errno == EINTR);
  return found < 0 ? errno == ECHILD : WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

[[noreturn]] void refuse_process(int reason) {
  throw Error("a process cannot be created: " + std::generic_category().message(reason));
}

}  // namespace

std::optional<std::string> in_child_process(const std::function<std::string()>& work,
                                            const ChildLimits& limits) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) refuse_process(errno);
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(ends[0]);  // or a write would not fail when the parent has ended
    run_child(ends[1], parent, work, limits);
  }
  const int reason = errno;
  ::close(ends[1]);
  if (child < 0) {
    ::close(ends[0]);
    refuse_process(reason);
  }
  std::optional<std::string> answer;
  std::exception_ptr fault;
  try {
    answer = read_answer(ends[0], limits);
  } catch (...) {  // no memory
    fault = std::current_exception();
  }
  ::close(ends[0]);
  if (!answer) ::kill(child, SIGKILL);
  const bool succeeded = has_succeeded(child);
  if (fault) std::rethrow_exception(fault);
  if (!answer || !succeeded) return std::nullopt;
  const char kind = answer->front();
  answer->erase(0, 1);
  if (kind == is_error) throw Error(*answer);
  return answer;
}

}  // namespace beeline::internal
