#include <beeline/io/text/arm.h>
#include <beeline/io/text/file.h>

#include "arm_fields.h"
#include "bindings.h"
#include "warning_category.h"

namespace beeline::python {

template <>
struct Fields<DhMisfit> : Members<&DhMisfit::joint, &DhMisfit::helical, &DhMisfit::distance> {};

template <>
struct Fields<DhTable> : Members<&DhTable::convention, &DhTable::base, &DhTable::rows,
                                 &DhTable::tool, &DhTable::freedom, &DhTable::misfits> {};

namespace {

/// The text of a format, which messages call `where`. Throws Error, which names all gaps, and
/// issues warnings of what the text does not say.
std::string text_of(const Arm& arm, ArmFileFormat format, const std::string& where = "the text") {
  const ArmFile file = arm_file(arm, format);
  std::string reasons;
  for (const ArmGap& gap : file.gaps) {
    reasons += (reasons.empty() ? "" : "; ") + sentence(gap, format);
  }
  if (!file) throw Error("the arm is not written: " + reasons);
  for (const std::string& note : file_notes(file, where)) warn_of_input(note);
  return file.text;
}

}  // namespace

void bind_written_arms(nb::module_& m, nb::class_<Arm>& arm) {
  bind_record<DhMisfit>(m);
  bind_record<DhTable>(m);
  Signature urdf("to_urdf", "str",
                 "Returns the arm as URDF, which Arm.from_urdf() reads as the same arm. Raises "
                 "Error for what URDF cannot describe: helical joints.");
  define(
      arm, [](const Arm& self) { return text_of(self, ArmFileFormat::urdf); }, urdf.takes("self"));
  Signature mjcf("to_mjcf", "str",
                 "Returns the arm as MuJoCo's MJCF, which Arm.from_urdf() reads as the same arm "
                 "without its limits of rates: MJCF has none, and an InputWarning names the "
                 "joints. Raises Error for what MJCF cannot describe: helical joints, and equal "
                 "position limits.");
  define(
      arm, [](const Arm& self) { return text_of(self, ArmFileFormat::mjcf); }, mjcf.takes("self"));
  Signature save("save", "None",
                 "Writes the arm to a file, by its ending as to_json(), to_urdf() or to_mjcf() do. "
                 "The file is replaced as a whole, or not at all.");
  save.takes("self").takes("path", path_like, "A .json, .urdf, .xml or .mjcf file.");
  define(
      arm,
      [](const Arm& self, nb::handle path) {
        const std::string file = path_from(path, "path");
        write_file(file, text_of(self, arm_file_format(file), file));
      },
      save, nb::arg("path"));
  Signature table("dh_table", "DhTable", comment("dh_table"));
  table.takes("self").choice<DhConvention>("convention",
                                           "The tables of the two conventions differ.");
  define(
      arm,
      [](const Arm& self, nb::handle convention) {
        return dh_table(self, Value<DhConvention>::from(convention, "convention"));
      },
      table, nb::arg("convention"));
}

}  // namespace beeline::python
