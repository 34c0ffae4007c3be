#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <beeline/io/text/internal/column_unit.h>
#include <beeline/io/text/internal/comment.h>

namespace beeline::internal {

/// The units of angles, or of lengths; null where none is stated.
struct OrderedUnits {
  const Unit* all = nullptr;  ///< of positions, and of rates per second
  /// Of positions, velocities and accelerations, where these are stated apart.
  std::array<const Unit*, 3> of_order{};

  const Unit* of(int order) const {
    const Unit* const own = of_order[static_cast<std::size_t>(order)];
    return own != nullptr ? own : all;
  }
};

/// A comment that names a unit in which no numbers are read.
struct UnreadUnit {
  Comment comment;
  std::string unit;          ///< as the comment has it
  bool times = false;        ///< of times; otherwise of positions or rates
  std::optional<int> order;  ///< of the derivative; none: of all
};

/// A comment that names units, but not clearly of which columns or whether of these.
struct UnclearComment {
  Comment comment;
  bool angles = false, lengths = false, times = false;  ///< to which of them it may apply

  bool is_on(Quantity quantity) const;
};

/// The unit that a comment gives for one column.
struct UnitOfColumn {
  std::size_t column = 0;
  const Unit* unit = nullptr;
  std::string text;  ///< as the comment has it, also per second
};

/// The units that the comments of a table give.
struct StatedUnits {
  OrderedUnits angle, length;
  const Unit* time = nullptr;
  std::vector<UnitOfColumn> columns = {};
  std::vector<UnreadUnit> unread = {};
  std::vector<UnclearComment> unclear = {};

  /// Whether each unit that is given here for a quantity is given by `other` too.
  bool is_within(const StatedUnits& other) const;
};

/// Returns the units in comments: `units: degrees`, `unit = mm, deg`, `positions in rad, velocities
/// in deg/s`, `joint1: deg, joint2: rad`, `angle_unit: deg`, a single unit, or `SI`.
///
/// A unit belongs to the subject before it: to angles, positions, velocities, times, single
/// columns and the like. Units of other subjects, such as torques, limits and, in a table of
/// joints, the tool, are ignored, and so is a unit behind a number, as in `step 1 deg`. Any other
/// unit makes the comment unclear, and so do negations, conversions (`converted from deg`),
/// settings (`degrees: false`), names of files (`data_deg.csv`), options of commands
/// (`--angle-unit deg`) and statements on some of the joints. Comments of files that Beeline writes
/// are left out: see own_comment. Throws FileError for two units
/// of one quantity.
StatedUnits stated_units(const std::vector<Comment>& comments,
                         const std::vector<std::string>& columns, const std::string& path);

/// Writes the units of single columns behind their names: `joint1 [deg]`. Throws Error for times
/// whose name has another unit.
void name_units(const StatedUnits& stated, std::vector<std::string>& columns);

/// Throws FileError for a comment on this quantity, of this derivative, with a unit that is not
/// read.
void check_read(const StatedUnits& stated, Quantity quantity, int order, const std::string& path);

/// Throws FileError for a comment on this quantity that is not clear.
void check_clear(const StatedUnits& stated, Quantity quantity, const std::string& path);

/// Returns what multiplies the numbers of each column to get the unit `wanted`, which is empty for
/// a column without a unit. Names give units, else comments do. Throws Error for a unit of another
/// quantity, for a comment that contradicts a wanted unit other than radians and metres, which an
/// option has asked for, and, where a column's name gives none, FileError for units in comments
/// that are not read or not clear.
std::vector<double> factors_to(const std::vector<std::string>& wanted,
                               const ColumnsInUnits& columns, const StatedUnits& stated,
                               const std::string& path);

/// Returns the names of the units, mm and deg, that comments give to columns. `factors` come from
/// factors_to() with metres and radians.
std::vector<std::string> commented_units(const ColumnsInUnits& columns, const StatedUnits& stated,
                                         const std::vector<double>& factors);

}  // namespace beeline::internal
