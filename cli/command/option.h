#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <beeline/error.h>
#include <beeline/path/tool_path.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline::command {

/// The variable that an option sets. Its value before parsing is the option's default. Whole
/// numbers are not negative, real numbers are finite; bool makes the option a flag, and a list
/// makes it one that may be given several times.
using Target = std::variant<bool*, int*, std::uint64_t*, double*, std::optional<double>*,
                            std::optional<std::int64_t>*, std::string*, std::vector<std::string>*>;

/// The numbers that an option accepts.
struct Range {
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
  bool excludes_lowest = false;  ///< the lowest number itself is not accepted
};
constexpr Range above_zero{.lowest = 0, .excludes_lowest = true};
constexpr Range zero_or_more{.lowest = 0};
constexpr Range sample_rates{.lowest = lowest_rate};
constexpr Range tool_speeds{.lowest = slowest_tool};

/// What a value names, for shell completion.
enum class Completes { nothing, arm, file };

/// An argument without a dash, by its position.
struct Positional {
  std::string name;  ///< as the help shows it: ARM
  std::string help = {};
  std::string* target = nullptr;
  Completes completes = Completes::nothing;
  bool required = true;
  std::vector<std::string> choices = {};  ///< the accepted values; empty: any
  bool other_values = false;              ///< the choices are not all accepted values
  /// Instead of `target`, of the last argument, which takes one word or more.
  std::vector<std::string>* targets = nullptr;
};

/// What an option accepts, and with which others.
struct OptionRules {
  bool required = false;
  std::string alias = {};                 ///< a second name
  std::vector<std::string> choices = {};  ///< the accepted values; empty: any
  bool other_values = false;              ///< the choices are not all accepted values
  Range range = {};                       ///< the accepted numbers
  std::vector<std::string> methods = {};  ///< needs --method with one of these values
  std::string needs = {};                 ///< another option that it needs
  std::string excludes = {};              ///< an option that it cannot be combined with
  /// The names of C++ arguments that this option sets, see Error::argument(), if they differ from
  /// its own: --from sets `start`.
  std::vector<std::string> arguments = {};
};

/// An option of a verb. The parser, the help, the man page and the shell completions read these
/// fields alone.
struct Option : OptionRules {
  /// `heading` is the name with the placeholder of its value: "--rate HZ"; of a flag, the name.
  Option(const std::string& heading, std::string help, Target target, OptionRules rules = {});

  std::string name;   ///< "--kp"
  std::string value;  ///< placeholder of the value, such as N or FILE; empty for a flag
  std::string help;   ///< one or more sentences, with the unit
  Target target;      ///< of a flag, null if it sets nothing
  Completes completes = Completes::nothing;  ///< file if the placeholder is a file or a folder
};

/// Sets the target from the text typed for `name`, or appends the text to a list. Throws Error
/// naming the option if the text is empty, is not such a number, or is not among the choices.
void assign(const Option& option, const std::string& name, const std::string& text);

/// Returns what `read` makes of an option's value. An Error of it begins with the option.
template <class Read>
auto for_option(const std::string& option, const Read& read) {
  try {
    return read();
  } catch (const FileError&) {
    throw;
  } catch (const Error& error) {
    throw Error(option + ": " + error.what());
  }
}

/// Throws Error if `text`, given for `what`, is not among the choices.
void check_choice(const std::string& what, const std::string& text,
                  const std::vector<std::string>& choices);

/// The default as the help shows it; empty if there is none.
std::string default_text(const Option& option);

/// The accepted numbers as the help and errors show them: "above 0"; empty if there is no bound.
std::string range_text(const Option& option);

bool is_flag(const Option& option);
bool is_list(const Option& option);  ///< whether it may be given several times

}  // namespace beeline::command
