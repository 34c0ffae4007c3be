#include "option.h"

#include <algorithm>
#include <charconv>
#include <limits>

#include <beeline/error.h>
#include <beeline/read/internal/numbers.h>

using namespace beeline;

namespace {

template <class Integer>
Integer whole_number(const std::string& text, const std::string& name) {
  Integer value = 0;  // counts and seeds: none is negative
  const char* const last = text.data() + text.size();
  const auto [end, fault] = std::from_chars(text.data(), last, value);
  if (fault == std::errc() && end == last && !text.starts_with('-')) return value;
  throw Error(name + " must be a whole number from 0 to " +
              std::to_string(std::numeric_limits<Integer>::max()) + ", not " + text);
}

}  // namespace

void assign(const Option& option, const std::string& name, const std::string& text) {
  if (text.empty()) throw Error(name + " needs a value that is not empty");
  const auto& choices = option.choices;
  const bool known = std::find(choices.begin(), choices.end(), text) != choices.end();
  if (!choices.empty() && !known && !option.other_values) {
    throw unknown_name("value of " + name, text, choices);
  }
  if (auto* const* target = std::get_if<int*>(&option.target)) {
    **target = whole_number<int>(text, name);
  } else if (auto* const* large = std::get_if<std::uint64_t*>(&option.target)) {
    **large = whole_number<std::uint64_t>(text, name);
  } else if (auto* const* real = std::get_if<double*>(&option.target)) {
    **real = internal::parse_number(text, name);
  } else if (auto* const* optional = std::get_if<std::optional<double>*>(&option.target)) {
    **optional = internal::parse_number(text, name);
  } else {
    *std::get<std::string*>(option.target) = text;
  }
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
