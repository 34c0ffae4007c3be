#include <cerrno>
#include <cstring>
#include <filesystem>
#include <vector>

#include <beeline/draw/internal/movie.h>
#include <beeline/error.h>
#include <beeline/io/text/file.h>

#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;  // NOLINT: of POSIX

namespace beeline::internal {
namespace {

/// An empty file in the folder for temporary files, removed at the end.
class ScratchFile {
 public:
  ScratchFile() : path_((std::filesystem::temp_directory_path() / "beeline-XXXXXX").string()) {
    const int file = mkstemp(path_.data());
    if (file < 0) throw Error("no temporary file could be made in " + path_ + ": " + reason(errno));
    close(file);
  }
  ~ScratchFile() { unlink(path_.c_str()); }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;

  const std::string& path() const { return path_; }
  static std::string reason(int error) { return std::generic_category().message(error); }

 private:
  std::string path_;
};

/// The program `ffmpeg`, which reads from a socket.
class Encoder {
 public:
  explicit Encoder(const std::vector<std::string>& arguments) {
    int ends[2];
    // A socket: unlike a pipe, it can report the end of the program without a signal.
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) fail(errno);
    input_ = ends[0];
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], 0);
    posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 2, messages_.path().c_str(), O_WRONLY, 0);
    std::vector<char*> list;
    for (const std::string& argument : arguments)
      list.push_back(const_cast<char*>(argument.data()));
    list.push_back(nullptr);
    const int error = posix_spawnp(&process_, list[0], &actions, nullptr, list.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    if (error == 0) return;
    close(input_);
    fail(error);
  }
  ~Encoder() {
    if (process_ > 0) finish();
  }
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;

  void write(const std::string& bytes) {
    for (std::size_t sent = 0; sent < bytes.size();) {
      const ssize_t count = send(input_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) return;  // it ended early: finish() gives the reason
      sent += static_cast<std::size_t>(count);
    }
  }

  /// Waits for the end. Returns what the program wrote on stderr, or "" when it succeeded.
  std::string finish() {
    close(input_);
    int status = 0;
    while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = 0;
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return "";
    const std::string messages = read_file(messages_.path());
    const std::size_t end = messages.find_last_not_of("\n");
    if (end == std::string::npos) return "no message";
    const std::size_t begin = messages.find_last_of('\n', end);
    return messages.substr(begin == std::string::npos ? 0 : begin + 1,
                           end - (begin == std::string::npos ? 0 : begin + 1) + 1);
  }

 private:
  [[noreturn]] static void fail(int error) {
    if (error == ENOENT) {
      throw Error(
          "the program ffmpeg, which writes .gif, .mp4 and .webp, was not found; install it "
          "(Debian: apt install ffmpeg), or write .svg, which needs no program");
    }
    throw Error("the program ffmpeg could not be started: " + ScratchFile::reason(error));
  }

  ScratchFile messages_;
  pid_t process_ = 0;
  int input_ = -1;
};

using Arguments = std::vector<std::string>;

void append(Arguments& arguments, const Arguments& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
}

/// Returns the arguments that describe the standard input.
Arguments input_arguments(const MovieFrames& frames) {
  return {"ffmpeg",     "-y",
          "-loglevel",  "error",
          "-f",         "rawvideo",
          "-pix_fmt",   "bgr0",
          "-s",         std::to_string(frames.width) + "x" + std::to_string(frames.height),
          "-framerate", number(frames.per_second),
          "-i",         "pipe:0"};
}

void run(const Arguments& arguments, const MovieFrames& frames, int first) {
  Encoder encoder(arguments);
  for (int i = first; i < frames.count; ++i) encoder.write(frames.pixels(i));
  const std::string message = encoder.finish();
  if (!message.empty()) throw Error("ffmpeg could not write the animation: " + message);
}

}  // namespace

std::string movie(const MovieFrames& frames, AnimationFormat format) {
  const ScratchFile out, palette;
  Arguments arguments = input_arguments(frames);
  if (format == AnimationFormat::gif) {
    // The last frame contains the colours of all frames, because everything has appeared.
    Arguments colours = arguments;
    append(colours, {"-vf", "palettegen=max_colors=128", "-c:v", "png", "-f", "image2", "-update",
                     "1", palette.path()});
    run(colours, frames, frames.count - 1);
    append(arguments, {"-f", "png_pipe", "-i", palette.path(), "-filter_complex",
                       "paletteuse=dither=none:diff_mode=rectangle", "-loop", "0", "-f", "gif"});
  } else if (format == AnimationFormat::webp) {
    append(arguments, {"-c:v", "libwebp_anim", "-lossless", "1", "-loop", "0", "-f", "webp"});
  } else {  // the pixel format that every player has
    append(arguments, {"-pix_fmt", "yuv420p", "-movflags", "+faststart", "-f", "mp4"});
  }
  arguments.push_back(out.path());
  run(arguments, frames, 0);
  std::string bytes = read_file(out.path());
  if (bytes.empty()) throw Error("ffmpeg could not write the animation: its file is empty");
  return bytes;
}

}  // namespace beeline::internal
