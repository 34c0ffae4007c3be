#include "bindings.h"
#include "formula_fields.h"
#include "interruption.h"

namespace beeline::python {
namespace {

SharedArm name_arm(const Arm& arm, const SymbolicOptions& options) {
  const LockRelease release;
  return std::make_shared<NamedArm>(NamedArm{arm, options, symbolic_arm(arm, options)});
}

void bind_symbolic_arm(nb::module_& m) {
  nb::class_<NamedArm> bound(m, "SymbolicArm", comment("SymbolicArm"));
  bound.def_prop_ro(
      "arm", [](const NamedArm& self) { return self.arm; }, getter("arm", "Arm"), "The arm.");
  bind_part<SymbolicArm>(
      bound, [](const NamedArm& self) -> auto& { return self.symbolic; });
  bound.def("__repr__", [](const NamedArm& self) {
    std::string symbols;
    for (const Symbol& symbol : self.symbolic.symbols) {
      if (symbol.kind != SymbolKind::rate) symbols += ' ' + symbol.name();
    }
    return "SymbolicArm(" + self.symbolic.name + ", " + spelling(self.symbolic.convention) + ":" +
           symbols + ")";
  });
  bound.def(
      "__reduce__",
      [](const NamedArm& self) {
        return nb::make_tuple(
            nb::module_::import_("beeline._formulas").attr("named_again"),
            nb::make_tuple(self.arm, self.options.angle_tolerance, self.options.max_symbols));
      },
      nb::sig("def __reduce__(self) -> tuple[object, ...]"));
  bind_equality(bound, [](const NamedArm& a, const NamedArm& b) { return same_arm(a, b); });
  Signature named("symbolic_arm", "SymbolicArm",
                  "Names the dimensions of an arm. The transforms are compared with the arm's at "
                  "random configurations.");
  named.takes_arm().options<SymbolicOptions>();
  define(
      m,
      [](const Arm& arm, const nb::kwargs& values) {
        return name_arm(arm, options<SymbolicOptions>(values));
      },
      named, nb::arg("arm"), nb::arg("options"));
}

constexpr const char* named_doc = "The arm; an Arm is named with default options.";
constexpr const char* named_type = "SymbolicArm | Arm | str";

/// A formula of the whole arm.
template <class Derive>
void whole(nb::module_& m, const char* name, const char* doc, Derive derive) {
  Signature signature(name, "ExpressionMatrix", doc);
  signature.takes("arm", named_type, named_doc);
  define(
      m,
      [derive](nb::handle value) {
        const SharedArm arm = named_arm(value, "arm");
        const LockRelease release;
        return NamedMatrix{arm, derive(arm->symbolic)};
      },
      signature, nb::arg("arm"));
}

void bind_derivations(nb::module_& m) {
  whole(m, "tool_formula", "Returns world_T_tool in symbols, 4 x 4.", &tool_formula);
  whole(m, "base_formula", "Returns the pose of the base in the world, 4 x 4.", &base_formula);
  whole(m, "tool_offset_formula", "Returns the pose of the tool in the last link, 4 x 4.",
        &tool_offset_formula);
  Signature link("link_formula", "ExpressionMatrix",
                 "Returns the pose of link i in link k, 4 x 4; link 0 is the base.");
  link.takes("arm", named_type, named_doc)
      .takes("i", "int", "From 0 to the number of joints.")
      .takes("k", "int", "From 0 to i.");
  define(
      m,
      [](nb::handle value, nb::handle i, nb::handle k) {
        const SharedArm arm = named_arm(value, "arm");
        const auto index = [&](nb::handle given, const char* name, std::int64_t max) {
          return static_cast<std::size_t>(integer_from(given, name, 0, max));
        };
        const std::size_t to = index(i, "i", static_cast<std::int64_t>(arm->symbolic.links()));
        return NamedMatrix{
            arm, link_formula(arm->symbolic, to, index(k, "k", static_cast<std::int64_t>(to)))};
      },
      link, nb::arg("arm"), nb::arg("i"), nb::arg("k"));
  Signature columns("jacobian_formula", "ExpressionMatrix",
                    "Returns the Jacobian in symbols, 6 x n, rows [vx vy vz wx wy wz]: the matrix "
                    "that jacobian() has.");
  columns.takes("arm", named_type, named_doc)
      .takes("frame", Value<Frame>::type(), "Its frame.", "'base'");
  define(
      m,
      [](nb::handle value, nb::handle frame) {
        const SharedArm arm = named_arm(value, "arm");
        const Frame in = Value<Frame>::from(frame, "frame");
        const LockRelease release;
        return NamedMatrix{arm, jacobian_formula(arm->symbolic, in)};
      },
      columns, nb::arg("arm"), nb::arg("frame") = "base");
  Signature rate("time_derivative", "ExpressionMatrix",
                 "Returns the time derivative of each entry, with the symbols dq1, dq2, ....");
  rate.takes("matrix", "ExpressionMatrix", "A matrix without such symbols.");
  define(
      m,
      [](const NamedMatrix& matrix) {
        return NamedMatrix{matrix.arm, time_derivative(matrix.arm->symbolic, matrix.value)};
      },
      rate, nb::arg("matrix"));
}

}  // namespace

bool same_arm(const NamedArm& a, const NamedArm& b) {
  return &a == &b ||
         (a.options.angle_tolerance == b.options.angle_tolerance &&
          a.options.max_symbols == b.options.max_symbols && nb::cast(a.arm).equal(nb::cast(b.arm)));
}

SharedArm named_arm(nb::handle value, const char* name) {
  SharedArm named;
  if (nb::try_cast(value, named) && named) return named;
  if (const Arm* arm = arm_of(value)) return name_arm(*arm, {});
  raise_type(name, "an Arm or a SymbolicArm", value);
}

void bind_formulas(nb::module_& m) {
  bind_record<Symbol>(m);
  bind_symbolic_arm(m);
  bind_expressions(m);
  bind_derivations(m);
  bind_documents(m);
}

}  // namespace beeline::python
