#include <algorithm>
#include <tinyxml2.h>

#include <beeline/error.h>
#include <beeline/internal/nearest_name.h>
#include <beeline/io/text/internal/mjcf_attributes.h>
#include <beeline/io/text/internal/name.h>

namespace beeline::internal {
namespace {

using tinyxml2::XMLElement;

constexpr std::size_t max_classes = 10'000;
constexpr int max_class_depth = 20;  // bounds the time of a look-up

const XmlElements& reader_of(const XMLElement& element) { return MjcfDocument::reader_of(element); }

}  // namespace

MjcfDefaults::MjcfDefaults(const MjcfDocument& document) : document_(&document) {
  classes_.push_back({.name = "main", .around = std::nullopt});
  by_name_.emplace("main", main_class);
  for (const XMLElement* at : document.children(document.root())) {
    if (std::string_view(at->Name()) != "default") continue;
    const char* const name = at->Attribute("class");
    if (name != nullptr && std::string_view(name) != "main") {
      reader_of(*at).refuse(at->GetLineNum(), "the outermost <default> has the class " +
                                                  in_quotes(name) +
                                                  "; its class is main, and others are inside it");
    }
    keep_main(*at);
    read(*at, main_class, 0);
  }
}

/// In MuJoCo a class keeps what main had when the class began, also if a further <default> changes
/// main: the classes inside it get a copy of it around them.
void MjcfDefaults::keep_main(const XMLElement& next) {
  constexpr int max_copies = 100;
  const auto is_inside_main = [](const Class& of_file) { return of_file.around == main_class; };
  const std::vector<const XMLElement*> children = document_->children(next);
  const bool changes_main = std::any_of(children.begin(), children.end(), [](const XMLElement* at) {
    return std::string_view(at->Name()) != "default";
  });
  if (!changes_main || std::none_of(classes_.begin(), classes_.end(), is_inside_main)) return;
  if (++copies_ > max_copies) {
    reader_of(next).refuse(next.GetLineNum(),
                           "the class main is changed more than 100 times after other classes");
  }
  const std::size_t copy = classes_.size();
  classes_.push_back({"", std::nullopt, classes_[main_class].elements});
  for (Class& of_file : classes_) {
    if (is_inside_main(of_file)) of_file.around = copy;
  }
}

void MjcfDefaults::read(const XMLElement& element, std::size_t own, int depth) {
  const XmlElements& reader = reader_of(element);
  for (const XMLElement* at : document_->children(element)) {
    if (std::string_view(at->Name()) == "default") continue;
    auto& elements = classes_[own].elements;
    // An orientation replaces an earlier one in any form.
    if (std::any_of(std::begin(mjcf_orientations), std::end(mjcf_orientations),
                    [&](const char* form) { return at->Attribute(form) != nullptr; })) {
      for (const char* form : mjcf_orientations) elements.erase({at->Name(), form});
    }
    for (const auto* given = at->FirstAttribute(); given != nullptr; given = given->Next()) {
      elements[{at->Name(), given->Name()}] = at;
    }
  }
  for (const XMLElement* at : document_->children(element)) {
    if (std::string_view(at->Name()) != "default") continue;
    const std::string name = reader_of(*at).needed_name(*at, "class");
    if (depth == max_class_depth || classes_.size() >= max_classes) {
      reader.refuse(at->GetLineNum(), depth == max_class_depth
                                          ? "classes of defaults are nested deeper than 20"
                                          : "has more than 10000 classes of defaults");
    }
    if (!by_name_.emplace(name, classes_.size()).second) {
      reader_of(*at).refuse(at->GetLineNum(), "two classes of defaults have the name " + name);
    }
    classes_.push_back({.name = name, .around = own});
    read(*at, classes_.size() - 1, depth + 1);
  }
}

std::size_t MjcfDefaults::class_of(const XMLElement& element, const char* attribute,
                                   std::size_t otherwise) const {
  const char* const name = element.Attribute(attribute);
  if (name == nullptr) return otherwise;
  const auto found = by_name_.find(name);
  if (found != by_name_.end()) return found->second;
  std::vector<std::string> known;
  for (const Class& of_file : classes_) {
    if (!of_file.name.empty()) known.push_back(of_file.name);
  }
  reader_of(element).refuse(
      element.GetLineNum(),
      described(element) + " has an " +
          unknown_name(std::string(attribute) + " of defaults", printable(name), known).what());
}

std::vector<MjcfDefaults::Source> MjcfDefaults::sources(std::string_view tag, std::size_t of_class,
                                                        std::string_view attribute) const {
  std::vector<Source> found;
  std::size_t level = 1;
  for (std::optional<std::size_t> at = of_class; at; at = classes_[*at].around, ++level) {
    const auto given = classes_[*at].elements.find({tag, attribute});
    if (given != classes_[*at].elements.end()) found.push_back({given->second, level});
  }
  return found;
}

int MjcfAttributes::line() const { return element_->GetLineNum(); }

std::vector<MjcfDefaults::Source> MjcfAttributes::sources(const char* attribute) const {
  std::vector<MjcfDefaults::Source> found;
  if (defaults_ != nullptr) found = defaults_->sources(element_->Name(), class_, attribute);
  if (element_->Attribute(attribute) != nullptr) found.insert(found.begin(), {element_, 0});
  return found;
}

const XMLElement* MjcfAttributes::source(const char* attribute) const {
  const auto found = sources(attribute);
  return found.empty() ? nullptr : found.front().element;
}

std::optional<std::size_t> MjcfAttributes::level(const char* attribute) const {
  const auto found = sources(attribute);
  return found.empty() ? std::nullopt : std::optional(found.front().level);
}

int MjcfAttributes::line_of(const char* attribute) const {
  const XMLElement* const from = source(attribute);
  return from == nullptr ? line() : from->GetLineNum();
}

std::string MjcfAttributes::text_or(const char* attribute, const std::string& otherwise) const {
  const XMLElement* const from = source(attribute);
  return from == nullptr ? otherwise : from->Attribute(attribute);
}

double MjcfAttributes::number_or(const char* attribute, double otherwise) const {
  const XMLElement* const from = source(attribute);
  return from == nullptr ? otherwise : reader_of(*from).number_or(*from, attribute, otherwise);
}

Vector3 MjcfAttributes::vector(const char* attribute, const Vector3& otherwise) const {
  const XMLElement* const from = source(attribute);
  return from == nullptr ? otherwise : reader_of(*from).vector(*from, attribute, otherwise);
}

std::vector<double> MjcfAttributes::numbers(const char* attribute, std::size_t count) const {
  const XMLElement* const from = source(attribute);
  if (from == nullptr) return {};
  std::vector<double> values = reader_of(*from).numbers(*from, attribute);
  if (values.size() != count) {
    refuse(attribute, "has " + std::to_string(values.size()) + " numbers; it must have " +
                          std::to_string(count));
  }
  return values;
}

std::vector<double> MjcfAttributes::some_numbers(const char* attribute,
                                                 std::vector<double> values) const {
  auto from = sources(attribute);
  std::reverse(from.begin(), from.end());
  for (const auto& [at, level] : from) {
    const std::vector<double> given = reader_of(*at).numbers(*at, attribute);
    if (given.size() > values.size()) {
      reader_of(*at).refuse(at->GetLineNum(), described(*at) + ": " + attribute + " has " +
                                                  std::to_string(given.size()) +
                                                  " numbers; it has at most " +
                                                  std::to_string(values.size()));
    }
    std::copy(given.begin(), given.end(), values.begin());
  }
  return values;
}

std::string MjcfAttributes::choice(const char* attribute, const std::vector<std::string>& choices,
                                   const std::string& otherwise) const {
  const std::string text = text_or(attribute, otherwise);
  if (std::find(choices.begin(), choices.end(), text) != choices.end()) return text;
  refuse(attribute, "is " + in_quotes(text) + "; known are " + listed(choices));
}

void MjcfAttributes::refuse(const char* attribute, const std::string& message) const {
  const XMLElement* const from = source(attribute);
  const XMLElement& at = from == nullptr ? *element_ : *from;
  reader_of(at).refuse(at.GetLineNum(), described(at) + ": " + attribute + " " + message);
}

void refuse_misspelt_attribute(const XMLElement& element, const std::vector<std::string>& known) {
  for (const auto* at = element.FirstAttribute(); at != nullptr; at = at->Next()) {
    if (std::find(known.begin(), known.end(), at->Name()) != known.end()) continue;
    const std::string* const meant = nearest_name(at->Name(), known);
    if (meant == nullptr) continue;
    reader_of(element).refuse(element.GetLineNum(),
                              described(element) + " has an unknown attribute " +
                                  printable(at->Name()) + "; " + *meant + " may be meant");
  }
}

void refuse_misspelt_tag(const XMLElement& element, const std::vector<std::string>& known) {
  if (std::find(known.begin(), known.end(), element.Name()) != known.end()) return;
  const std::string* const meant = nearest_name(element.Name(), known);
  if (meant == nullptr) return;
  reader_of(element).refuse(element.GetLineNum(), "has an unknown element " + described(element) +
                                                      "; <" + *meant + "> may be meant");
}

}  // namespace beeline::internal
