#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fmt/core.h>
#include <utility>
#include <vector>

#include <beeline/error.h>

#include "verb.h"

namespace {

struct Verb {
  const char* name;
  const char* summary;
  Run (*declare)(CLI::App&);
};

constexpr Verb verbs[] = {
    {"arms", "List the built-in arms", declare_arms},
    {"show", "Print an arm as a table: joints, limits, frames, reach", declare_show},
    {"fk", "Forward kinematics: the tool's pose, or every link's", declare_fk},
    {"jacobian", "The Jacobian, its singular values and manipulability", declare_jacobian},
    {"ik", "Inverse kinematics: the configurations that reach a pose", declare_ik},
    {"batch", "fk, jacobian or ik of any number of rows in files: CSV, numpy's .npy",
     declare_batch},
    {"move", "Joint-space motion control from one configuration to another", declare_move},
    {"line", "Move the tool in straight lines through poses", declare_line},
    {"check", "Prove that a trajectory keeps its lines and limits, whoever made it", declare_check},
    {"replay", "Play a recorded trajectory on an arm, checked against its limits", declare_replay},
    {"diff", "Compare two recordings of an arm, such as commanded and measured", declare_diff},
    {"time", "Give the way of a recording new times: as quick as the limits allow", declare_time},
    {"draw", "Draw an arm or a motion as SVG, PNG or PDF", declare_draw},
    {"figure", "Redraw a figure of the chapter", declare_figure},
};

/// A verb may have verbs of its own, as batch has.
void check_verbs(const CLI::App& app, int argc, char** argv) {
  const std::vector<const CLI::App*> verbs_of_app = app.get_subcommands({});
  if (verbs_of_app.empty() || argc < 2 || argv[1][0] == '-') return;
  std::vector<std::string> names;
  for (const CLI::App* verb : verbs_of_app) {
    if (verb->get_name() == argv[1]) return check_verbs(*verb, argc - 1, argv + 1);
    names.push_back(verb->get_name());
  }
  throw beeline::unknown_name("verb", argv[1], names);
}

int fail(Exit exit, const std::string& message) {
  fmt::print(stderr, "beeline: {}\n", message);
  return static_cast<int>(exit);
}

/// Output that could not be written (a full disk, a closed pipe) is no success.
int flushed(Exit exit) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return static_cast<int>(exit);
  return fail(Exit::file, std::string("cannot write to stdout: ") + std::strerror(errno));
}

/// An empty value is a shell variable that was not set, most likely.
std::string not_empty(const std::string& value) {
  return value.empty() ? "needs a value that is not empty" : "";
}

void refuse_empty_values(CLI::App& verb) {
  for (CLI::Option* option : verb.get_options()) {
    if (option->get_items_expected_max() > 0) option->check(not_empty);
  }
  for (CLI::App* part : verb.get_subcommands({})) refuse_empty_values(*part);
}

int run(int argc, char** argv) {
  CLI::App app("Moves serial-link robot arms, and proves that they go where they were told to go.",
               "beeline");
  app.set_version_flag("--version", "beeline " BEELINE_VERSION);
  app.require_subcommand(1);
  app.footer(
      "`beeline VERB --help` tells a verb's options, with examples.\n"
      "ARM is a built-in name (panda), a joint string with link lengths (RRR:3.5,3.5,2) or a\n"
      "file (.urdf, .json). Radians and metres; --degrees for angles, both ways.\n"
      "Exit codes: 0 yes, 1 the computed answer is no, 2 bad usage, 3 bad input file.");
  std::vector<std::pair<CLI::App*, Run>> declared;
  for (const Verb& verb : verbs) {
    CLI::App* subcommand = app.add_subcommand(verb.name, verb.summary);
    declared.emplace_back(subcommand, verb.declare(*subcommand));
    refuse_empty_values(*subcommand);
  }
  check_verbs(app, argc, argv);
  try {
    app.parse(argc, argv);
    for (const auto& [subcommand, run_verb] : declared) {
      if (subcommand->parsed()) return flushed(run_verb());
    }
  } catch (const CLI::Success& help_or_version) {
    app.exit(help_or_version);
    return flushed(Exit::yes);
  } catch (const CLI::ParseError& error) {
    return fail(Exit::usage, std::string(error.what()) + " (beeline --help)");
  }
  return static_cast<int>(Exit::usage);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const beeline::FileError& error) {
    return fail(Exit::file, error.what());
  } catch (const beeline::Error& error) {
    return fail(Exit::usage, error.what());
  } catch (const std::bad_alloc&) {
    return fail(Exit::file, "the input needs more memory than there is");
  } catch (const std::exception& error) {
    return fail(Exit::usage, std::string("internal error, please report it: ") + error.what());
  }
}
