#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <beeline/error.h>
#include <beeline/io/text/file.h>
#include <beeline/io/text/scene.h>
#include <beeline/io/trajectory_file.h>

#include "arm_argument.h"
#include "command/interrupt.h"
#include "command/streams.h"
#include "page_server.h"
#include "recording_argument.h"
#include "result_files.h"
#include "saved_page.h"
#include "scene_argument.h"
#include "verbs.h"

#include <fcntl.h>
#include <unistd.h>

namespace beeline::command {
namespace {

constexpr const char* loopback = "127.0.0.1";

/// The sections of the page.
std::vector<std::string> page_sections() {
  return {"pose", "control", "line", "obstacles", "workspace", "lessons"};
}

struct ViewArguments {
  ArmArgument arm;
  UnitArgument unit;
  std::string file, save;
  RecordingArgument recording;
  SceneArgument scene;
  std::string section, folder, host = loopback;
  int port = 8642;
  bool no_browser = false;
  bool json = false;
};

/// The folder of the built page: --page, what was installed beside the command, or where `make web`
/// puts it.
std::string page_folder(const std::string& given) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  std::vector<fs::path> folders{program.parent_path() / "../share/beeline/web",
                                program.parent_path() / "web"};
  if (!given.empty()) folders = {given};
  for (const fs::path& folder : folders) {
    if (fs::is_regular_file(folder / "index.html", ignored)) return folder.string();
  }
  throw Error(given.empty() ? "the page is not built: `make web` builds it, --page FOLDER names it"
                            : "--page " + given + ": there is no index.html");
}

/// Opens the address in the user's browser, where there is a screen.
void open_browser(const std::string& address) {
  if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) return;
  if (fork() != 0) return;
  setsid();  // Ctrl-C ends the command, and not a browser that this starts
  const int nowhere = open("/dev/null", O_RDWR);  // who reads our stdout must see its end
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nowhere, stream);
  execlp("xdg-open", "xdg-open", address.c_str(), nullptr);
  _exit(1);
}

Answer save_page(const std::string& path, const PageSession& session, const std::string& folder) {
  write_file(path, saved_page(folder, session));
  return {.text = "page    " + path + "\n", .document = Json{{"page", path}}};
}

/// Adds the shapes of the links and the obstacles to what the page asks for. It knows neither SRDF
/// files nor --no-self.
void add_scene(const ViewArguments& arguments, PageSession& session) {
  const std::optional<CheckedScene> checked = arguments.scene.read(arguments.arm, session.arm);
  if (!checked) return;
  CollisionFiles files = collision_files(checked->model);
  session.shaped_arm = std::move(files.arm);
  session.scene = std::move(files.scene);
  session.clearance = arguments.scene.clearance;
}

Answer view(const ViewArguments& arguments) {
  if (!arguments.save.empty()) {
    if (!arguments.save.ends_with(".html")) {
      throw Error("--save " + arguments.save + ": a page is written to a .html file");
    }
    std::vector<std::string> inputs = arguments.scene.inputs();
    inputs.push_back(arguments.file);
    refuse_overwriting(arguments.save, inputs);
  }
  PageSession session{.arm = arguments.arm.read(arguments.unit), .section = arguments.section};
  add_scene(arguments, session);
  if (!arguments.file.empty()) {
    const Recording recording =
        arguments.recording.read_unwrapped(arguments.file, session.arm, arguments.unit);
    session.trajectory = trajectory_text(recording.trajectory, TrajectoryFormat::csv);
    if (session.section.empty()) session.section = "line";  // which plays it
  }
  if (!arguments.save.empty()) {
    return save_page(arguments.save, session, page_folder(arguments.folder));
  }
  const std::set<std::string> loopbacks{loopback, "localhost", "::1"};
  if (!loopbacks.contains(arguments.host)) {
    warn("--host " + arguments.host + ": others on the network can see the arm and move it");
  }
  catch_interrupt();
  catch_termination();
  PageServer server(std::move(session), page_folder(arguments.folder), arguments.host);
  const bool six = arguments.host.find(':') != std::string::npos;  // an IPv6 address
  const std::string host = six ? "[" + arguments.host + "]" : arguments.host;
  const std::string address = fmt::format("http://{}:{}/", host, server.bind(arguments.port));
  write_stdout(arguments.json ? Json{{"address", address}}.text() + "\n" : address + "\n");
  if (!arguments.no_browser) open_browser(address);
  std::future<void> serving = std::async(std::launch::async, [&server] { server.run(); });
  const auto ended = [&serving] {
    return serving.wait_for(std::chrono::milliseconds(50)) == std::future_status::ready;
  };
  while (!interrupted() && !ended()) continue;
  // Again, where the interrupt comes before the server answers requests.
  do server.stop();
  while (!ended());
  serving.get();  // throws what ended it
  return {.text_on_stderr = true};
}

}  // namespace

Verb view_verb() {
  const auto arguments = std::make_shared<ViewArguments>();
  return {.name = "view",
          .summary = "Show an arm in the browser, and a running program's joint values live",
          .description =
              "Serves the page on this computer and opens it with the arm, and with a trajectory "
              "to play. Prints the address; Ctrl-C and SIGTERM end it with exit code 0. A program "
              "that is running posts joint values, in radians and metres, to api/joints; the page "
              "follows. Requests of other sites are refused.\n\n"
              "With --scene or --self the page has the obstacles and the shapes of the links.",
          .arguments = {arguments->arm.argument(),
                        file_argument("FILE", "A trajectory to play, .csv, .json or .yaml.",
                                      &arguments->file, false)},
          .options =
              joined({{Option("--port N", "The port, or the next one that is free.",
                              &arguments->port, {.range = {.lowest = 1, .highest = 65535}}),
                       Option("--host ADDRESS",
                              "The address to listen on; others than 127.0.0.1 let the network in.",
                              &arguments->host),
                       Option("--section SECTION",
                              "The section of the page to begin with. Default: pose, or line with "
                              "a trajectory.",
                              &arguments->section, {.choices = page_sections()}),
                       Option("--save FILE.html",
                              "Serve nothing: write page, arm and trajectory as one HTML file, "
                              "which opens from a disk without a network.",
                              &arguments->save),
                       Option("--no-browser", "Do not open a browser.", &arguments->no_browser),
                       Option("--page FOLDER",
                              "The folder of the built page. Default: the one that was installed "
                              "with the command, or the one that make web built.",
                              &arguments->folder)},
                      arguments->recording.options(),
                      arguments->scene.distance_options(),
                      arguments->unit.options(),
                      arguments->arm.options()}),
          .examples = {{"A UR5 in the browser", "beeline view ur5"},
                       {"The planar arm of the lessons", "beeline view rrr --section lessons"},
                       {"Joint values from a shell; a program does the same 60 times a second",
                        "beeline view ur5 --no-browser &\n"
                        "curl -H 'Content-Type: application/json' -d '{\"q\": [0, -1, 1, 0, 1, "
                        "0]}' http://127.0.0.1:8642/api/joints"}},
          .json = {arguments, &arguments->json},
          .run = [arguments] { return view(*arguments); }};
}

}  // namespace beeline::command
