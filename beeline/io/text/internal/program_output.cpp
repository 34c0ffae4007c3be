#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <thread>

#include <beeline/error.h>
#include <beeline/io/text/internal/program_output.h>

#ifdef __EMSCRIPTEN__  // a web page starts no programs

namespace beeline::internal {

std::optional<std::string> program_in_path(const std::string& /*name*/) { return std::nullopt; }

ProgramOutput run_program(const std::vector<std::string>& command, const std::string& /*folder*/,
                          const ProgramBounds& /*bounds*/) {
  throw Error("the program " + command.front() + " cannot be run here");
}

}  // namespace beeline::internal

#else

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;  // NOLINT: of POSIX

namespace beeline::internal {
namespace {

using ProgramClock = std::chrono::steady_clock;
using Ending = ProgramOutput::Ending;

constexpr std::size_t max_messages = std::size_t{64} << 10;

/// The two ends of a pipe, which close themselves. Their numbers differ from the numbers of the
/// standard streams, which the host may have closed.
class Pipe {
 public:
  Pipe() {
    std::array<int, 2> made{-1, -1};
    bool works = ::pipe(made.data()) == 0;
    for (std::size_t i = 0; i < made.size(); ++i) {
      ends_[i] = works ? ::fcntl(made[i], F_DUPFD_CLOEXEC, 3) : -1;
      works = works && ends_[i] >= 0;
    }
    const int fault = errno;
    for (const int end : made) {
      if (end >= 0) ::close(end);
    }
    if (works) return;
    close_end(0);
    throw Error("a pipe cannot be created: " + std::generic_category().message(fault));
  }
  ~Pipe() {
    close_end(0);
    close_end(1);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int from() const { return ends_[0]; }
  int to() const { return ends_[1]; }
  void close_end(std::size_t which) {
    if (ends_[which] >= 0) ::close(ends_[which]);
    ends_[which] = -1;
  }

 private:
  std::array<int, 2> ends_{-1, -1};
};

pid_t started(const std::vector<std::string>& command, const std::string& folder,
              const Pipe& output, const Pipe& messages) {
  std::vector<char*> list;
  for (const std::string& word : command) list.push_back(const_cast<char*>(word.c_str()));
  list.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, output.to(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, messages.to(), STDERR_FILENO);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  // The host's treatment of signals is not the program's.
  sigset_t none, pipes;
  sigemptyset(&none);
  sigemptyset(&pipes);
  sigaddset(&pipes, SIGPIPE);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setsigdefault(&attributes, &pipes);
  pid_t process = 0;
  const int fault = posix_spawn(&process, list[0], &actions, &attributes, list.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (fault != 0) {
    throw Error("the program " + command.front() +
                " cannot be run: " + std::generic_category().message(fault));
  }
  return process;
}

/// Appends a block of a pipe to a text, of which bytes beyond `most` are dropped. Returns whether
/// the pipe may have more.
bool read_block(int from, std::size_t most, std::string& text, bool& is_cut) {
  std::array<char, 65536> block;
  const ssize_t count = ::read(from, block.data(), block.size());
  if (count < 0 && (errno == EINTR || errno == EAGAIN)) return true;
  if (count <= 0) return false;
  const std::size_t kept = std::min(most - text.size(), static_cast<std::size_t>(count));
  text.append(block.data(), kept);
  is_cut = is_cut || kept < static_cast<std::size_t>(count);
  return true;
}

/// Reads both pipes to their ends. Returns early with the bound that is exceeded.
Ending read_all(Pipe& output, Pipe& messages, std::size_t most, ProgramClock::time_point deadline,
                ProgramOutput& read) {
  bool too_much = false, cut = false;
  while (output.from() >= 0 || messages.from() >= 0) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - ProgramClock::now());
    if (left.count() <= 0) return Ending::out_of_time;
    std::array<pollfd, 2> ready{pollfd{output.from(), POLLIN, 0},
                                pollfd{messages.from(), POLLIN, 0}};  // -1 is ignored
    const int found = ::poll(ready.data(), ready.size(), static_cast<int>(left.count()));
    if (found < 0 && errno != EINTR) return Ending::failed;
    if (found <= 0) continue;
    if (ready[0].revents != 0 && !read_block(output.from(), most, read.output, too_much)) {
      output.close_end(0);
    }
    if (too_much) return Ending::too_much_output;
    if (ready[1].revents != 0 && !read_block(messages.from(), max_messages, read.messages, cut)) {
      messages.close_end(0);
    }
  }
  return Ending::succeeded;
}

/// Waits for the end of a process, which is killed at the deadline; returns how it ended. If the
/// host ignores SIGCHLD, the system keeps no status.
Ending end_of(pid_t process, ProgramClock::time_point deadline) {
  int status = 0;
  bool is_killed = false;
  while (true) {
    const bool is_late = ProgramClock::now() >= deadline;
    if (is_late && !is_killed) is_killed = ::kill(process, SIGKILL) == 0;
    const pid_t found = ::waitpid(process, &status, is_late ? 0 : WNOHANG);
    if (found == process) break;
    if (found < 0 && errno != EINTR) return Ending::succeeded;
    if (found == 0) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  if (WIFEXITED(status)) return WEXITSTATUS(status) == 0 ? Ending::succeeded : Ending::failed;
  return is_killed ? Ending::out_of_time : Ending::failed;
}

}  // namespace

std::optional<std::string> program_in_path(const std::string& name) {
  const char* const value = std::getenv("PATH");
  std::string rest = value == nullptr ? "" : value;
  while (!rest.empty()) {
    const std::size_t colon = std::min(rest.find(':'), rest.size());
    const std::filesystem::path folder = rest.substr(0, colon);
    rest.erase(0, colon + 1);
    const std::filesystem::path file = folder / name;
    std::error_code fault;
    if (folder.is_absolute() && std::filesystem::is_regular_file(file, fault) &&
        ::access(file.c_str(), X_OK) == 0) {
      return file.string();
    }
  }
  return std::nullopt;
}

ProgramOutput run_program(const std::vector<std::string>& command, const std::string& folder,
                          const ProgramBounds& bounds) {
  Pipe output, messages;
  const pid_t process = started(command, folder, output, messages);
  output.close_end(1);
  messages.close_end(1);
  const ProgramClock::time_point deadline = ProgramClock::now() + bounds.time;
  ProgramOutput read;
  try {
    read.ending = read_all(output, messages, bounds.output, deadline, read);
  } catch (...) {  // no memory
    end_of(process, ProgramClock::time_point::min());
    throw;
  }
  const bool is_read = read.ending == Ending::succeeded;
  const Ending ending = end_of(process, is_read ? deadline : ProgramClock::time_point::min());
  if (is_read) read.ending = ending;
  return read;
}

}  // namespace beeline::internal

#endif
