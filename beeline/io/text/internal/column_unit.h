#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace beeline::internal {

enum class Quantity { angle, length, time };

/// A unit of numbers in a text.
struct Unit {
  Quantity quantity;
  double si;                            ///< radians, metres or seconds per unit
  std::vector<std::string_view> names;  ///< in lower case: the one of options first, a word last
};

/// The units, in the order of JointUnit, then of TimeUnit.
const std::vector<Unit>& all_units();

/// The name that options have.
std::string name_of(const Unit& unit);

/// Returns the unit of this quantity that has the name. Throws Error about `what`, listing the
/// names that options have.
const Unit& unit_among(Quantity quantity, const std::string& text, const std::string& what);

/// A name of a column as its stem and the unit behind it; no unit if it has none.
struct NameInUnit {
  std::string stem;
  const Unit* unit = nullptr;
  int power = 0;  ///< of 1 / s
};

/// Splits a name that ends in a unit of time: `time_ms`, `t [ms]`, `t/ms`.
NameInUnit split_at_time_unit(const std::string& name);

/// The columns of a table, as their names say.
struct ColumnsInUnits {
  std::vector<std::string> names;      ///< without the units
  std::vector<std::string> given;      ///< as the table has them
  std::vector<const Unit*> units{};    ///< of angles and lengths that the names give, or null
  std::vector<std::string> sources{};  ///< the columns whose names give the units
};

/// Splits names of columns into the quantity and its unit: `joint1_deg`, `joint1 (deg)`,
/// `joint1/deg`, `joint1[mm]`, `joint1_deg_vel`. Rates may have the unit of one, `joint1_vel
/// (deg/s)`; a name with such a unit that does not say its quantity, `joint1 (deg/s)`, becomes
/// `joint1_vel` or `joint1_acc`. A unit of angles elsewhere, `deg_joint1` or
/// `states_deg/joint1/position`, is accepted too and remains in the name. A name that one of
/// `known` has is not split. Names that would be equal without their units keep them. Throws Error
/// for a name with two units, as a header and the row of units below it may give.
ColumnsInUnits columns_in_units(const std::vector<std::string>& names,
                                const std::vector<std::string>& known);

/// Returns the names with the units of a row below them behind: `q1` and `deg` give `q1 [deg]`.
/// Empty unless the items are units, in brackets or not, and at least one is of all_units(); others
/// may be `-`, `1`, `Nm` and the like, which leave a name as it is.
std::vector<std::string> with_units(std::vector<std::string> names,
                                    const std::vector<std::string>& items);

/// The units that the comments at the head of a table give; null for a quantity without one.
struct StatedUnits {
  const Unit *angle = nullptr, *length = nullptr, *time = nullptr;
};

/// Returns the units in comments such as `units: degrees`, `unit = mm, deg`, `angles in deg`, or a
/// single unit. Other words may stand between the quantity and `in deg` unless they mean rates,
/// limits or conversions.
/// Throws Error for two units of one quantity.
StatedUnits stated_units(const std::vector<std::string>& comments);

/// Returns the factor that converts the numbers of each column to the unit `wanted`, which is empty
/// for a column without a unit. Names give units, else comments do. Throws Error for a unit of
/// another quantity, and for a comment that contradicts a wanted unit other than radians and
/// metres: an option has asked for it.
std::vector<double> factors_to(const std::vector<std::string>& wanted,
                               const ColumnsInUnits& columns, const StatedUnits& stated);

}  // namespace beeline::internal
