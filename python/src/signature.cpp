#include "signature.h"

#include <cctype>
#include <deque>
#include <utility>

#include "interruption.h"

namespace beeline::python {

const char* kept_text(std::string text) {
  static std::deque<std::string> texts;
  return texts.emplace_back(std::move(text)).c_str();
}

std::string source_of(nb::handle value) {
  if (PyFloat_Check(value.ptr()) && std::isinf(nb::cast<double>(value))) {
    return nb::cast<double>(value) > 0 ? "float('inf')" : "float('-inf')";
  }
  const bool simple = value.is_none() || PyFloat_Check(value.ptr()) || PyLong_Check(value.ptr()) ||
                      PyUnicode_Check(value.ptr()) || PyTuple_Check(value.ptr());
  return simple ? nb::repr(value).c_str() : "...";
}

namespace {

/// Whether an annotation has the text, and not as a part of a longer name: `int` of `JointPath`.
bool has_word(std::string_view annotation, std::string_view text) {
  const auto continues = [&](std::size_t i) {
    return i < annotation.size() &&
           (std::isalnum(static_cast<unsigned char>(annotation[i])) != 0 || annotation[i] == '_');
  };
  for (std::size_t at = annotation.find(text); at != std::string_view::npos;
       at = annotation.find(text, at + 1)) {
    if (!(at > 0 && continues(at - 1)) && !continues(at + text.size())) return true;
  }
  return false;
}

}  // namespace

Signature::Signature(std::string name, std::string returns, std::string summary)
    : name_(std::move(name)), returns_(std::move(returns)), summary_(std::move(summary)) {
  const std::size_t end = summary_.rfind("Raises ");
  if (end == std::string::npos || end == 0) return;
  refused_ = summary_.substr(end + 7);
  summary_.erase(summary_.find_last_not_of(" \n", end - 1) + 1);
}

void Signature::refuses(const std::string& name, const std::string& type) {
  const auto among = [&](std::string& names) {
    names += (names.empty() ? "`" : ", `") + name + "`";
  };
  const auto has = [&](std::string_view text) { return has_word(type, text); };
  if (type == arm_like) {
    has_arm_ = true;
  } else if (has("Trajectory")) {
    among(motions_);
  } else if (name == "out" || name == "solutions") {
    among(outputs_);
  } else if (has(array_like) || has("numpy.typing.NDArray")) {
    among(arrays_);
  } else if (has(path_like)) {
    among(files_);
  } else if (has("Callable") || has("dict") || has("list") || has("Sequence")) {
    return;
  } else if (has("JointPath") || has("typing.Literal") || has("int") || has("float") ||
             has("str")) {
    among(values_);
  }
}

std::string Signature::raised() const {
  std::string text, others;
  const auto add = [&](const std::string& names, const char* what) {
    if (!names.empty()) text += (text.empty() ? "For " : "; for ") + names + what;
  };
  add(arrays_, any_values_ ? " of another shape" : " of another shape or not finite");
  add(outputs_, " of another shape or read-only");
  add(files_, " that cannot be read or written");
  if (!any_values_) add(values_, " other than described");
  if (has_arm_ && !summary_has_motions_) add(motions_, " that does not fit the arm");
  const std::size_t end = refused_.find_first_of(" ,");
  const std::string kind = refused_.substr(0, end);
  if (end != std::string::npos) {
    others = refused_.substr(refused_.find_first_not_of(" ,", end));
    if (others.ends_with('.')) others.pop_back();
    if (kind == "Error") {
      text += (text.empty() ? "" : "; ") + std::exchange(others, "");
    }
  }
  if (!text.empty()) {
    text[0] = static_cast<char>(std::toupper(text[0]));
    text = "beeline.Error\n    " + text + ".\n";
  }
  if (!others.empty()) {
    others[0] = static_cast<char>(std::toupper(others[0]));
    text += "beeline." + kind + "\n    " + others + ".\n";
  }
  return text.empty() ? "" : "\nRaises\n------\n" + text;
}

Signature Signature::of_arm() const {
  const std::string like = arm_like, parameter = "arm: " + like,
                    documented = "arm : " + like + "\n    " + arm_doc + "\n";
  Signature method = *this;
  method.parameters_.replace(0, parameter.size(), "self");
  method.documented_.erase(0, documented.size());
  method.names_.erase(method.names_.begin());
  return method;
}

Signature& Signature::any_values() {
  any_values_ = true;
  return *this;
}

Signature& Signature::summary_has_motions() {
  summary_has_motions_ = true;
  return *this;
}

Signature& Signature::takes(const std::string& name, const std::string& type,
                            const std::string& doc, const std::string& fallback) {
  if (!parameters_.empty()) parameters_ += ", ";
  parameters_ += name;
  if (name != "self") names_.push_back(name);
  if (!type.empty()) parameters_ += ": " + type;
  if (!fallback.empty()) parameters_ += " = " + fallback;
  refuses(name, type);
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

void Signature::budget(bool reports) {
  takes("time_limit", "float | None",
        "Seconds after which the search ends; with 0 at its first check, within a millisecond. "
        "What it ends depends on the machine.",
        "None");
  takes("max_work", "int | None",
        "Units of work, of some microseconds each, after which the search ends.", "None");
  if (reports) progress();
}

Signature& Signature::progress() {
  return takes("progress", "bool | collections.abc.Callable[[float], object]",
               "Called with the fraction computed, from 0 to 1; True shows a progress bar.",
               "False");
}

const char* Signature::text(const char* decorator) const {
  return kept_text((decorator ? "@" + std::string(decorator) + "\n" : "") + "def " + name_ + "(" +
                   parameters_ + ") -> " + returns_);
}

const char* Signature::doc() const {
  std::string doc = summary_ + "\n";
  if (!documented_.empty()) doc += "\nParameters\n----------\n" + documented_;
  if (!returned_.empty()) doc += "\nReturns\n-------\n" + returns_ + "\n    " + returned_ + "\n";
  doc += raised();
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
