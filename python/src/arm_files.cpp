#include <beeline/io/text/arm.h>
#include <beeline/io/text/urdf.h>

#include "arm_fields.h"
#include "bindings.h"
#include "warning_category.h"

namespace beeline::python {
namespace {

/// Issues the warnings of a reader.
void issue(const std::vector<ReadWarning>& warnings) {
  for (const ReadWarning& warning : warnings) {
    nb::object instance = model_warning()(sentence(warning));
    instance.attr("kind") = name(warning.kind);
    instance.attr("line") = warning.line;
    instance.attr("joint") = warning.joint;
    instance.attr("link") = warning.link;
    instance.attr("others") = Value<std::vector<std::string>>::to(warning.others);
    instance.attr("element") = warning.element;
    instance.attr("element_fault") = name(warning.element_fault);
    instance.attr("attribute") = warning.attribute;
    instance.attr("value") = warning.value;
    instance.attr("numbers") = Value<std::vector<double>>::to(warning.numbers);
    instance.attr("count") = warning.count;
    instance.attr("program") = warning.program;
    issue_warning(instance);
  }
}

ChainEnds ends_of(nb::handle base, nb::handle tip) {
  return {Value<std::optional<std::string>>::from(base, "base").value_or(""),
          Value<std::optional<std::string>>::from(tip, "tip").value_or("")};
}

}  // namespace

XacroArguments xacro_arguments(nb::handle values) {
  if (!nb::isinstance<nb::dict>(values)) raise_type("xacro", "a dict", values);
  XacroArguments arguments;
  for (const auto& [name, value] : nb::borrow<nb::dict>(values)) {
    arguments.insert_or_assign(Value<std::string>::from(name, "xacro"),
                               nb::cast<std::string>(nb::str(value)));
  }
  return arguments;
}

nb::object model_warning() {
  static PyObject* const type = new_warning_category(
      "ModelWarning",
      "What a reader of a file selected among several, or left out because of a fault beside the "
      "chain: its text, with the attributes kind, line, joint, link, others, element, "
      "element_fault, attribute, value, numbers, count and program.");
  return nb::borrow(type);
}

void bind_arm_files(nb::class_<Arm>& arm) {
  const auto chain = [](Signature& signature) -> Signature& {
    return signature.keywords()
        .takes("base", "str | None", "Name of the link that the chain begins at.", "None")
        .takes("tip", "str | None", "Name of the link that it ends at.", "None")
        .takes("xacro", xacro_type, xacro_text, "{}");
  };
  Signature load(
      "load", "Arm",
      "Returns the arm that `source` names: a built-in arm (`panda`), a joint string "
      "(`RRR:3.5,3.5,2`), or a file (`.urdf`, `.xacro`, MuJoCo's `.xml`, `.json`). Issues a "
      "ModelWarning for what was "
      "selected or left out. Raises FileError for an invalid file, whose line it names.");
  chain(load.takes("source", path_like, "Name, joint string or path."));
  define_static(
      arm,
      [](nb::handle text, nb::handle base, nb::handle tip, nb::handle xacro) {
        std::vector<ReadWarning> warnings;
        const KeptExpansions expansions(xacro_arguments(xacro));
        const Arm read = read_arm(path_from(text, "source"), ends_of(base, tip), &warnings);
        issue(warnings);
        return read;
      },
      load, nb::arg("source"), nb::kw_only(), nb::arg("base") = nb::none(),
      nb::arg("tip") = nb::none(), nb::arg("xacro") = nb::dict());

  Signature urdf(
      "from_urdf", "Arm",
      "Reads the chain from `base` to `tip` of a URDF or MJCF file, or of the text of one. The "
      "world is the base link's frame. Issues a ModelWarning for what was selected or "
      "left out. Raises FileError for an invalid file, whose line it names.");
  chain(urdf.takes("source", path_like, "Path, or text that begins with `<`."));
  define_static(
      arm,
      [](nb::handle source, nb::handle base, nb::handle tip, nb::handle xacro) {
        const KeptExpansions expansions(xacro_arguments(xacro));
        const std::string text = path_from(source, "source");
        std::vector<ReadWarning> warnings;
        const std::size_t begin = text.find_first_not_of(" \t\r\n\xef\xbb\xbf");
        const Arm read = begin != std::string::npos && text[begin] == '<'
                             ? arm_from_urdf(text, "URDF", ends_of(base, tip), &warnings)
                             : read_urdf(text, ends_of(base, tip), &warnings);
        issue(warnings);
        return read;
      },
      urdf, nb::arg("source"), nb::kw_only(), nb::arg("base") = nb::none(),
      nb::arg("tip") = nb::none(), nb::arg("xacro") = nb::dict());
}

}  // namespace beeline::python
