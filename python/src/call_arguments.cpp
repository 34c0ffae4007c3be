#include "call_arguments.h"

#include <deque>

#include <beeline/error.h>

#include "value.h"

namespace beeline::python {

void CallNames::refuse_missing(std::size_t i) const {
  if (overloaded_) throw nb::next_overload();
  throw nb::type_error((function_ + "() needs the argument " + all_[i]).c_str());
}

void CallNames::refuse_positional(std::size_t accepted, std::size_t further) const {
  if (overloaded_) throw nb::next_overload();
  const std::string most = accepted == 0 ? "no positional arguments"
                           : accepted == 1
                               ? "at most 1 positional argument"
                               : "at most " + std::to_string(accepted) + " positional arguments";
  throw nb::type_error((function_ + "() takes " + most + ", not " +
                        std::to_string(accepted + further) +
                        (known_.size() > accepted ? "; give the others by name" : ""))
                           .c_str());
}

void CallNames::refuse_keywords(const nb::kwargs& keywords) const {
  const auto first = *keywords.begin();
  const std::string name = Value<std::string>::from(first.first, "keyword");
  if (known_.empty()) throw nb::type_error((function_ + "() takes no arguments").c_str());
  throw nb::type_error(unknown_name("argument of " + function_ + "()", name, known_).what());
}

const CallNames* kept_names(CallNames names) {
  static std::deque<CallNames> all;
  return &all.emplace_back(std::move(names));
}

}  // namespace beeline::python
