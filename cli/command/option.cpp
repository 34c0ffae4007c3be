#include "option.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include <beeline/error.h>
#include <beeline/io/text/numbers.h>

namespace beeline::command {
namespace {

template <class Integer>
Integer whole_number(const Option& option, const std::string& text, const std::string& name) {
  Integer value = 0;  // counts and seeds: none is negative
  const char* const last = text.data() + text.size();
  const auto [end, fault] = std::from_chars(text.data(), last, value);
  const bool whole = fault == std::errc() && end == last && !text.starts_with('-');
  const auto [lowest, highest, excludes_lowest] = option.range;
  if (whole && static_cast<double>(value) >= lowest && static_cast<double>(value) <= highest) {
    return value;
  }
  Option bounded = option;
  bounded.range.lowest = std::max(lowest, 0.0);
  std::string accepted = range_text(bounded);
  if (!std::isfinite(highest)) {
    accepted = "from " + number(bounded.range.lowest) + " to " +
               std::to_string(std::numeric_limits<Integer>::max());
  }
  throw Error(name + " must be a whole number " + accepted + ", not " + text);
}

double real_number(const Option& option, const std::string& text, const std::string& name) {
  const double value = parse_number(text, name);
  const auto [lowest, highest, excludes_lowest] = option.range;
  if (value >= lowest && value <= highest && !(excludes_lowest && value == lowest)) return value;
  throw Error(name + " must be " + range_text(option) + ", not " + text);
}

/// A bound with all its digits if it is a whole number.
std::string bound_text(double bound) {
  const bool whole = bound == std::floor(bound) && std::abs(bound) < 1e15;
  return whole ? std::to_string(static_cast<std::int64_t>(bound)) : number(bound);
}

}  // namespace

Option::Option(const std::string& heading, std::string help, Target target, OptionRules rules)
    : OptionRules(std::move(rules)),
      name(heading.substr(0, heading.find(' '))),
      value(name == heading ? "" : heading.substr(name.size() + 1)),
      help(std::move(help)),
      target(target) {
  const bool names_file = value.starts_with("FILE") || value.starts_with("FOLDER");
  if (names_file) completes = Completes::file;
}

void check_choice(const std::string& what, const std::string& text,
                  const std::vector<std::string>& choices) {
  if (std::find(choices.begin(), choices.end(), text) != choices.end()) return;
  throw unknown_name("value of " + what, text, choices);
}

void assign(const Option& option, const std::string& name, const std::string& text) {
  if (text.empty()) throw Error(name + " needs a value that is not empty");
  if (!option.choices.empty() && !option.other_values) check_choice(name, text, option.choices);
  if (auto* const* target = std::get_if<int*>(&option.target)) {
    **target = whole_number<int>(option, text, name);
  } else if (auto* const* large = std::get_if<std::uint64_t*>(&option.target)) {
    **large = whole_number<std::uint64_t>(option, text, name);
  } else if (auto* const* count = std::get_if<std::optional<std::int64_t>*>(&option.target)) {
    **count = whole_number<std::int64_t>(option, text, name);
  } else if (auto* const* real = std::get_if<double*>(&option.target)) {
    **real = real_number(option, text, name);
  } else if (auto* const* optional = std::get_if<std::optional<double>*>(&option.target)) {
    **optional = real_number(option, text, name);
  } else if (is_list(option)) {
    std::get<std::vector<std::string>*>(option.target)->push_back(text);
  } else {
    *std::get<std::string*>(option.target) = text;
  }
}

std::string range_text(const Option& option) {
  const auto [lowest, highest, excludes_lowest] = option.range;
  const bool from = std::isfinite(lowest), to = std::isfinite(highest);
  if (!from) return to ? "at most " + bound_text(highest) : "";
  if (to && !excludes_lowest) return "from " + bound_text(lowest) + " to " + bound_text(highest);
  return (excludes_lowest ? "above " : "at least ") + bound_text(lowest) +
         (to ? " and at most " + bound_text(highest) : "");
}

std::string default_text(const Option& option) {
  if (option.required) return "";
  if (const auto* target = std::get_if<int*>(&option.target)) return std::to_string(**target);
  if (const auto* large = std::get_if<std::uint64_t*>(&option.target)) {
    return std::to_string(**large);
  }
  if (const auto* real = std::get_if<double*>(&option.target)) return number(**real);
  if (const auto* text = std::get_if<std::string*>(&option.target)) return **text;
  return "";
}

bool is_flag(const Option& option) { return std::holds_alternative<bool*>(option.target); }

bool is_list(const Option& option) {
  return std::holds_alternative<std::vector<std::string>*>(option.target);
}

}  // namespace beeline::command
