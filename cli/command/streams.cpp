#include "streams.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <string>

#include <beeline/error.h>
#include <beeline/io/text/file.h>

#include <fcntl.h>
#include <unistd.h>

namespace beeline::command {

void prepare_streams() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // a write beyond the limit of the shell fails with an error
  const auto fill = [](int stream, int mode) {
    if (fcntl(stream, F_GETFD) != -1) return;
    const int opened = open("/dev/null", mode);  // the lowest free number, which is `stream`
    if (opened != stream && opened >= 0) close(opened);
  };
  // Opened in the opposite direction, so that using the stream fails, as for a closed one.
  fill(STDIN_FILENO, O_WRONLY);
  fill(STDOUT_FILENO, O_RDONLY);
  fill(STDERR_FILENO, O_WRONLY);
}

void write_stderr(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

void print_error(std::string_view text) {
  write_stderr(std::string("beeline: ") + Error(std::string(text)).what() + "\n");
}

void warn(std::string_view text) { print_error("warning: " + std::string(text)); }

void write_stdout(std::string_view text) {
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (written && std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  if (errno == EPIPE) throw ClosedPipe("stdout");
  throw FileError("stdout", 0, std::string("cannot be written: ") + std::strerror(errno));
}

}  // namespace beeline::command
