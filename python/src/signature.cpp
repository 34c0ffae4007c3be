#include "signature.h"

#include <deque>

#include "interruption.h"

namespace beeline::python {

const char* kept_text(std::string text) {
  static std::deque<std::string> texts;
  return texts.emplace_back(std::move(text)).c_str();
}

std::string default_text(nb::handle value) {
  if (PyFloat_Check(value.ptr()) && std::isinf(nb::cast<double>(value))) {
    return nb::cast<double>(value) > 0 ? "float('inf')" : "float('-inf')";
  }
  const bool simple = value.is_none() || PyFloat_Check(value.ptr()) || PyLong_Check(value.ptr()) ||
                      PyUnicode_Check(value.ptr());
  return simple ? nb::repr(value).c_str() : "...";
}

Signature::Signature(std::string name, std::string returns, std::string summary)
    : name_(std::move(name)), returns_(std::move(returns)), summary_(std::move(summary)) {}

Signature& Signature::takes(const std::string& name, const std::string& type,
                            const std::string& doc, const std::string& fallback) {
  if (!parameters_.empty()) parameters_ += ", ";
  parameters_ += name;
  if (!type.empty()) parameters_ += ": " + type;
  if (!fallback.empty()) parameters_ += " = " + fallback;
  if (doc.empty()) return *this;
  documented_ += name + " : " + type +
                 (fallback.empty() || fallback == "..." ? "" : ", default " + fallback) + "\n    " +
                 doc + "\n";
  return *this;
}

Signature& Signature::keywords() {
  if (!keywords_) parameters_ += parameters_.empty() ? "*" : ", *";
  keywords_ = true;
  return *this;
}

Signature& Signature::returns(std::string doc) {
  returned_ = std::move(doc);
  return *this;
}

void Signature::budget() {
  takes("time_limit", "float | None",
        "Seconds after which the search ends. What it ends depends "
        "on the machine.",
        "None");
  takes("max_work", "int | None",
        "Units of work, of some microseconds each, after which the "
        "search ends.",
        "None");
  takes("progress", "bool | collections.abc.Callable[[float], object]",
        "Called with the fraction computed, from 0 to 1; True shows a progress bar.", "False");
}

const char* Signature::text(const char* decorator) const {
  return kept_text((decorator ? "@" + std::string(decorator) + "\n" : "") + "def " + name_ + "(" +
                   parameters_ + ") -> " + returns_);
}

const char* Signature::doc() const {
  std::string doc = summary_ + "\n";
  if (!documented_.empty()) doc += "\nParameters\n----------\n" + documented_;
  if (!returned_.empty()) doc += "\nReturns\n-------\n" + returns_ + "\n    " + returned_ + "\n";
  return kept_text(std::move(doc));
}

bool set_budget(Budget& budget, const std::string& keyword, nb::handle value) {
  if (keyword == "time_limit") {
    budget.time_limit = Value<std::optional<double>>::from(value, "time_limit");
  } else if (keyword == "max_work") {
    budget.max_work = Value<std::optional<std::int64_t>>::from(value, "max_work");
  } else if (keyword == "progress") {
    budget.progress = progress_of(value);
  } else {
    return false;
  }
  return true;
}

}  // namespace beeline::python
