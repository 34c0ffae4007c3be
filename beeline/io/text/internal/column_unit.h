#pragma once

#include <cstddef>
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

/// The units of joints, then the units of times.
const std::vector<Unit>& all_units();

/// The name that options have.
std::string name_of(const Unit& unit);

/// Returns the unit that has this name; null if there is none. `text` is in lower case.
const Unit* unit_called(std::string_view text);

/// Whether a text, in brackets or not, is a unit, also of a rate, or one in which no numbers are
/// read.
bool states_unit(std::string_view item);

/// Whether the name of a column, in lower case, says without a unit that it has times.
bool is_time_name(std::string_view name);

/// Returns the unit of this quantity that has the name. Throws Error about `what`, listing the
/// names that options have.
const Unit& unit_among(Quantity quantity, const std::string& text, const std::string& what);

/// The units in which numbers are read, for the end of a message.
inline constexpr const char* units_that_are_read =
    "units that are read are rad, deg, m and mm, for rates rad/s and rad/s^2 and the like, and for "
    "times s, ms, us and ns";

/// The power of 1 / s in a text behind a unit, as in `deg/s`.
struct RateText {
  int power = 0;
  std::size_t size = 0;  ///< of the text
};

/// Returns the longest text of a rate at the front of a text; none if it has no end of a word
/// there.
RateText rate_at_front(std::string_view text);

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
  std::vector<std::string> names;    ///< without the units
  std::vector<std::string> given;    ///< as the table has them
  std::vector<const Unit*> units{};  ///< of angles and lengths that the names give, or null
  std::vector<int> powers{};         ///< of 1 / s in these units
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

/// The names of a header with the units of a row below it.
struct UnitRow {
  std::vector<std::string> names;  ///< `q1 [deg]` of `q1` and `deg`; empty if it is no such row
  std::string fault;               ///< of a row of units with one that is not read; empty: none
};

/// Reads a row of units, in brackets or not, of which one at least is of all_units(); others may be
/// `-`, `1`, `Nm` and the like, which leave a name as it is.
UnitRow with_units(std::vector<std::string> names, const std::vector<std::string>& items);

}  // namespace beeline::internal
