#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <system_error>
#include <vector>

#include <beeline/error.h>
#include <beeline/io/text/file.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/package_folder.h>
#include <beeline/io/text/internal/program_output.h>
#include <beeline/io/text/internal/xacro.h>
#include <beeline/io/text/urdf.h>

namespace beeline::internal {
namespace {

constexpr ProgramBounds xacro_bounds{.output = std::size_t{8} << 20,
                                     .time = std::chrono::minutes(1)};

bool contains(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

/// Whether a text has elements or expressions of xacro.
bool needs_xacro(std::string_view text) {
  return contains(text, "<xacro:") || contains(text, "${") || contains(text, "$(");
}

/// Removes the first line from the text and returns it.
std::string_view take_line(std::string_view& text) {
  const std::string_view line = text.substr(0, text.find('\n'));
  text.remove_prefix(std::min(line.size() + 1, text.size()));
  return line;
}

/// The message without the warnings before its error, which are followed by their locations.
std::string_view without_warnings(std::string_view message) {
  constexpr std::string_view locations[] = {"when ", "in file", "instantiated from",
                                            "included from"};
  bool warns = false;
  for (std::string_view rest = message, left = message; !rest.empty(); rest = left) {
    const std::string_view line = take_line(left);
    const bool is_location =
        warns && std::any_of(std::begin(locations), std::end(locations),
                             [&](std::string_view of) { return line.starts_with(of); });
    warns = line.starts_with("warning: ") || is_location;
    if (!warns) return rest;
  }
  return message;  // there is no error
}

/// The message of a program, in one line of at most 400 bytes.
std::string one_line(std::string_view message) {
  constexpr std::size_t longest = 400;
  std::string line;
  while (!message.empty() && line.size() < longest) {
    std::string_view part = take_line(message);
    while (!part.empty() && part.back() == ' ') part.remove_suffix(1);
    if (!part.empty()) line += (line.empty() ? "" : "; ") + std::string(part);
  }
  if (line.size() > longest) line.resize(longest);
  for (char& c : line) c = static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
  return with_escaped_bytes(line);
}

/// Whether a text may be the name of a package or of an argument: a program does not take it for an
/// option.
bool is_word(std::string_view name) {
  return !name.empty() && name.front() != '-' &&
         std::all_of(name.begin(), name.end(),
                     [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; });
}

/// Adds the names between `opening` and `closing` in a text that may be names of packages.
void add_package_names(std::string_view text, std::string_view opening, char closing,
                       std::set<std::string>& names) {
  constexpr std::size_t max_names = 100;
  for (std::size_t at = text.find(opening);
       at != std::string_view::npos && names.size() < max_names; at = text.find(opening, at + 1)) {
    const std::size_t begin = at + opening.size();
    const std::size_t end = std::min(text.find(closing, begin), text.size());
    const std::string_view name = text.substr(begin, end - begin);
    if (is_word(name)) names.emplace(name);
  }
}

/// The options of xacrodoc with the folders of packages: of those that a text names in `$(find
/// NAME)` and `package://NAME/` and, as included files may name others, of those that the folders
/// above the file and in ROS_PACKAGE_PATH are called; and with the folder around the file's own
/// package. Without them, xacrodoc finds packages above the file that have a package.xml, and those
/// that ROS knows.
std::vector<std::string> package_options(std::string_view text, const std::string& path) {
  std::error_code fault;
  std::set<std::string> names;
  add_package_names(text, "$(find ", ')', names);
  add_package_names(text, "package://", '/', names);
  for (const std::string& name : names_of_folders(path)) {
    if (is_word(name)) names.insert(name);
  }
  std::vector<std::string> options;
  for (const std::string& name : names) {
    for (const std::filesystem::path& folder : package_folders(name, path)) {
      if (!std::filesystem::is_directory(folder, fault)) continue;
      options.insert(options.end(), {"-p", name + ":=" + folder.string()});
      break;
    }
  }
  const std::filesystem::path around = folder_around_package(path);
  if (!around.empty()) options.insert(options.end(), {"-d", around.string()});
  return options;
}

/// What the user may do about a message of xacro or xacrodoc.
std::string_view advice(std::string_view message) {
  if (contains(message, "ackage") && contains(message, "not found")) {
    return " (a package is looked for by the name of its folder, or of a link to it, above the "
           "file and in the folders of ROS_PACKAGE_PATH)";
  }
  if (contains(message, "Undefined substitution argument")) {
    return " (NAME:=VALUE beside the file gives it a value; in Python xacro={NAME: VALUE})";
  }
  return "";
}

/// Refuses a file that its program could not expand.
[[noreturn]] void refuse_output(const std::string& path, const std::string& program,
                                const ProgramOutput& read) {
  switch (read.ending) {
    case ProgramOutput::Ending::out_of_time:
      throw FileError(path, 0, program + " has not ended after a minute");
    case ProgramOutput::Ending::too_much_output:
      throw FileError(path, 0, program + " writes more than 8 MiB");
    default:
      break;
  }
  const std::string message =
      one_line(without_warnings(read.messages.empty() ? read.output : read.messages));
  throw FileError(
      path, 0,
      program + " fails" + (message.empty() ? "" : ": " + message).append(advice(message)));
}

}  // namespace

/// Arguments of xacro, and the texts that were expanded with them, by the path and the text of the
/// file.
struct Expansions {
  struct Text {
    std::string text, program;
  };
  std::vector<std::string> arguments;  ///< `NAME:=VALUE`
  std::map<std::pair<std::string, std::string>, Text> texts;
};

namespace {
thread_local Expansions* kept_expansions = nullptr;
}

ExpandedText::ExpandedText(std::string_view text, const std::string& path) : text_(text) {
  if (extension(path) != "xacro" || !needs_xacro(text)) return;
  const std::pair key(path, std::string(text));
  if (kept_expansions != nullptr) {
    const auto kept = kept_expansions->texts.find(key);
    if (kept != kept_expansions->texts.end()) {
      expanded_ = kept->second.text;
      program_ = kept->second.program;
      return;
    }
  }
  expand(path);
  if (kept_expansions != nullptr) {
    kept_expansions->texts.emplace(key, Expansions::Text{expanded_, program_});
  }
}

void ExpandedText::expand(const std::string& path) {
  std::error_code fault;
  std::optional<std::string> found;
  if (std::filesystem::is_regular_file(path, fault)) {
    for (const char* const name : {"xacrodoc", "xacro"}) {
      program_ = name;
      found = program_in_path(name);
      if (found) break;
    }
  }
  if (!found) {
    throw FileError(path, 0,
                    "is a xacro file, which needs the program xacrodoc or xacro; install one "
                    "(pip install xacrodoc, or apt install ros-DISTRO-xacro), or run xacro first "
                    "and pass the URDF that it writes");
  }
  const std::string absolute = std::filesystem::absolute(path).string();  // begins with no dash
  // xacrodoc looks for included files without a folder in its own one.
  const std::string folder = std::filesystem::path(absolute).parent_path().string();
  std::vector<std::string> file{absolute};
  if (kept_expansions != nullptr) {
    const std::vector<std::string>& arguments = kept_expansions->arguments;
    file.insert(file.end(), arguments.begin(), arguments.end());
  }
  const auto run_with = [&](std::vector<std::string> command) {
    command.insert(command.begin(), *found);
    command.insert(command.end(), file.begin(), file.end());
    return run_program(command, folder, xacro_bounds);
  };
  ProgramOutput read = run_with({});
  if (read.ending == ProgramOutput::Ending::failed && program_ == "xacrodoc") {
    const std::vector<std::string> options = package_options(text_, path);
    if (!options.empty()) {
      ProgramOutput second = run_with(options);
      if (second.ending != ProgramOutput::Ending::out_of_time) read = std::move(second);
    }
  }
  if (read.ending != ProgramOutput::Ending::succeeded || read.output.empty()) {
    refuse_output(path, program_, read);
  }
  expanded_ = std::move(read.output);
}

}  // namespace beeline::internal

namespace beeline {

KeptExpansions::KeptExpansions(const XacroArguments& arguments)
    : around_(internal::kept_expansions) {
  if (around_ != nullptr && arguments.empty()) return;
  own_ = std::make_unique<internal::Expansions>();
  for (const auto& [name, value] : arguments) {
    if (!internal::is_word(name)) {
      throw Error(
          "\"" + internal::with_escaped_bytes(name) +
          "\" is no name of an argument of xacro; it has letters, digits, _ and, but not first, -");
    }
    own_->arguments.push_back(name + ":=" + value);
  }
  internal::kept_expansions = own_.get();
}

KeptExpansions::~KeptExpansions() { internal::kept_expansions = around_; }

}  // namespace beeline
