#include "bindings.h"
#include "doctor_fields.h"
#include "interruption.h"

namespace beeline::python {
namespace {

Diagnosis diagnosis_of(nb::handle model, nb::handle base, nb::handle tip) {
  const ChainEnds ends{Value<std::optional<std::string>>::from(base, "base").value_or(""),
                       Value<std::optional<std::string>>::from(tip, "tip").value_or("")};
  const Arm* arm = nullptr;
  if (nb::try_cast<const Arm*>(model, arm) && arm) {
    const LockRelease release;
    return diagnose(*arm);
  }
  const std::string text = path_from(model, "model");
  const LockRelease release;
  return diagnose(text, ends);
}

nb::object faults_of(nb::handle path) {
  const std::string text = path_from(path, "path");
  std::vector<Finding> found;
  {
    const LockRelease release;
    found = file_faults(text);
  }
  return Value<std::vector<Finding>>::to(found);
}

void bind_exemptions(nb::module_& m) {
  bind_record<Exemption>(m);
  Signature signature("examine_exemptions", "list[Exemption]", comment("examine_exemptions"));
  signature.takes_arm()
      .takes("links", argument_type<std::vector<LinkShapes>>(), "Shapes of its links.")
      .takes("scene", "Scene | None", "The obstacles.", "None")
      .takes("pairs", argument_type<std::vector<NamedPair>>() + " | None",
             "The pairs. Default: `exempted_pairs` of the scene.", "None")
      .options<ExemptionOptions>();
  define(
      m,
      [](const Arm& arm, nb::handle links, nb::handle scene, nb::handle pairs,
         const nb::kwargs& keywords) {
        auto asked = options<ExemptionOptions>(keywords);
        const auto shapes = Value<std::vector<LinkShapes>>::from(links, "links");
        const auto around = Value<std::optional<Scene>>::from(scene, "scene").value_or(Scene());
        const auto given = Value<std::optional<std::vector<NamedPair>>>::from(pairs, "pairs");
        const std::vector<NamedPair> examined = given.value_or(around.exempted_pairs);
        return Value<std::vector<Exemption>>::to(unlocked(asked.budget, [&] {
          return examine_exemptions(arm, shapes, around, examined, asked);
        }));
      },
      signature, nb::arg("arm"), nb::arg("links"), nb::arg("scene") = nb::none(),
      nb::arg("pairs") = nb::none(), nb::arg("keywords"));
}

}  // namespace

void bind_doctor(nb::module_& m) {
  bind_exemptions(m);
  bind_record<Finding>(m);
  bind_record<Diagnosis>(m);
  bind_record<ModelDifference>(m);
  bind_record<ArmComparison>(m);

  Signature one(
      "diagnose", "Diagnosis",
      "Looks for numbers of a model that are likely mistakes: units, rounded right angles, axes "
      "that nearly have a closed form of inverse kinematics, joints that move alike, limits. Of a "
      "file also what its text alone shows: a missing <axis>, an axis not of unit length.");
  one.takes("model", std::string("Arm | ") + path_like, "An arm, or what `Arm.load` takes.")
      .keywords()
      .takes("base", "str | None", "Of a URDF file: link that the chain begins at.", "None")
      .takes("tip", "str | None", "Link that it ends at.", "None");
  define(m, &diagnosis_of, one, nb::arg("model"), nb::kw_only(), nb::arg("base") = nb::none(),
         nb::arg("tip") = nb::none());

  Signature faults(
      "file_faults", "list[Finding]",
      "Returns all faults of a URDF file, on every chain, in the order of its lines. It needs no "
      "chain: a file that `Arm.load` refuses for its first fault shows all.");
  faults.takes("path", path_like, "The file.");
  define(m, &faults_of, faults, nb::arg("path"));

  Signature two("compare_arms", "ArmComparison", comment("compare_arms"));
  two.takes("a", arm_like, "One arm.")
      .takes("b", arm_like, "The other.")
      .options<ComparisonOptions>();
  define(
      m,
      [](const Arm& a, const Arm& b, const nb::kwargs& keywords) {
        const auto asked = options<ComparisonOptions>(keywords);
        const LockRelease release;
        return compare_arms(a, b, asked);
      },
      two, nb::arg("a"), nb::arg("b"), nb::arg("keywords"));
}

}  // namespace beeline::python
