#include <beeline/reach/surface.h>

#include "bindings.h"
#include "comparison_fields.h"
#include "draw_fields.h"
#include "placement_fields.h"

namespace beeline::python {
namespace {

constexpr const char* not_comparable =
    "for maps of which one has headings, directions, or one orientation and the other another "
    "kind, for an incomplete one, ";

Signature of_two_maps(const char* name, const std::string& returns, const std::string& summary) {
  Signature signature(name, returns, summary);
  signature.takes("first", "ReachMap", "A map.")
      .takes("second", "ReachMap", "Another one, in the same world.");
  return signature;
}

}  // namespace

void bind_comparison(nb::module_& m) {
  bind_record<ReachSide>(m);
  bind_record<ReachComparison>(m);
  Signature compare = of_two_maps(
      "compare_reach", "ReachComparison",
      std::string(
          "Compares the maps of two arms, or of one with two mounts or tools, in the same world: "
          "at the centres of cells that cover both, each map with the position that contains the "
          "point. Maps of the same box are compared cell by cell. Raises Error ") +
          not_comparable + "and for more than 1e8 points.");
  define(
      m,
      [](const ReachMap& first, const ReachMap& second) {
        return without_lock([&] { return compare_reach(first, second); });
      },
      compare, nb::arg("first"), nb::arg("second"));

  Signature slices = of_two_maps("slices_of", "tuple[ReachSlice, ReachSlice]",
                                 std::string("Returns the slices of two maps at the same cells, "
                                             "the cells of compare_reach(). Raises Error ") +
                                     not_comparable + "and for a coordinate outside both.");
  SlicePlane::takes(slices);
  define(
      m,
      [](const ReachMap& first, const ReachMap& second, nb::handle axis, nb::handle at,
         nb::handle measure) {
        const SlicePlane plane(axis, at, measure);
        const auto both = without_lock(
            [&] { return slices_of(first, second, plane.normal, plane.at, plane.measure); });
        return nb::make_tuple(arrays_of(both[0]), arrays_of(both[1]));
      },
      slices, nb::arg("first"), nb::arg("second"), nb::arg("axis"), nb::arg("at"),
      nb::arg("measure") = "directions");
}

}  // namespace beeline::python
