#include <beeline/model/arm.h>

#include "arm_fields.h"
#include "bindings.h"

namespace beeline::python {
namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, 6>;

/// Swaps the linear and the angular part.
Twist swapped(const Twist& twist) {
  Twist other;
  other << twist.tail<3>(), twist.head<3>();
  return other;
}

/// Screws [v w] of rows whose angular parts come first or last.
std::vector<Twist> twists_of(nb::handle value, bool angular_first) {
  std::vector<Twist> twists;
  const Rows rows = finite_from<Rows>(value, "screws");
  for (const auto& row : rows.rowwise()) {
    const Twist twist = row.transpose();
    twists.push_back(angular_first ? swapped(twist) : twist);
  }
  return twists;
}

/// Whether the order "wv" is named, and not "vw".
bool is_angular_first(nb::handle order) {
  const std::string name = Value<std::string>::from(order, "order");
  if (name != "wv" && name != "vw") throw unknown_name("order", name, {"wv", "vw"});
  return name == "wv";
}

/// Rows of screws [v w].
nb::object rows_of(const std::vector<Twist>& twists, bool angular_first) {
  Rows rows(static_cast<Index>(twists.size()), 6);
  for (std::size_t i = 0; i < twists.size(); ++i) {
    rows.row(static_cast<Index>(i)) = angular_first ? swapped(twists[i]) : twists[i];
  }
  return Value<Rows>::to(rows);
}

constexpr const char* order_type = "typing.Literal['wv', 'vw']";
constexpr const char* order_doc =
    "Whether the angular part of a row comes first, as in Lynch & Park, or last, as in Jacobians.";

}  // namespace

void bind_screws(nb::class_<Arm>& arm) {
  Signature of_screws(
      "from_screws", "Arm",
      "Returns the arm of a product of exponentials (Lynch & Park, sections 4.1.1 and "
      "4.1.3), exp(S1 q1) ... exp(Sn qn) M, with the joints joint1, joint2 and so "
      "on. Raises Error for a screw that is not of unit length to 0.001, and for a "
      "pitch that may be rounding.");
  of_screws
      .takes("screws", array_like,
             "One row for each joint (n, 6): the transpose of a matrix Slist.")
      .takes("home", array_like,
             "M, the pose of the tool in the world at zero joint values (4, 4).")
      .keywords()
      .choice<ScrewFrame>("frame", "The numbers do not show which one is meant.")
      .takes("order", order_type, order_doc)
      .takes("name", "str", "Name of the arm.", "'arm'")
      .takes("limits", "list[Limits] | None", "One for each joint.", "None");
  define_static(
      arm,
      [](nb::handle screws, nb::handle home, nb::handle frame, nb::handle order, nb::handle name,
         nb::handle limits) {
        const auto list = Value<std::optional<std::vector<Limits>>>::from(limits, "limits");
        if (list && list->empty()) throw Error("limits is empty; omit it");
        return arm_from_screws(
            Value<std::string>::from(name, "name"), twists_of(screws, is_angular_first(order)),
            Value<Pose>::from(home, "home"), Value<ScrewFrame>::from(frame, "frame"),
            list.value_or(std::vector<Limits>()));
      },
      of_screws, nb::arg("screws"), nb::arg("home"), nb::kw_only(), nb::arg("frame"),
      nb::arg("order"), nb::arg("name") = "arm", nb::arg("limits") = nb::none());

  Signature screws(
      "screws", "numpy.ndarray",
      "Returns the screws of all joints at zero joint values: what Arm.from_screws() takes.");
  screws.takes("self")
      .keywords()
      .choice<ScrewFrame>("frame", "")
      .takes("order", order_type, order_doc)
      .returns("One row for each joint (n, 6).");
  define(
      arm,
      [](const Arm& self, nb::handle frame, nb::handle order) {
        return rows_of(beeline::screws(self, Value<ScrewFrame>::from(frame, "frame")),
                       is_angular_first(order));
      },
      screws, nb::kw_only(), nb::arg("frame"), nb::arg("order"));
}

}  // namespace beeline::python
