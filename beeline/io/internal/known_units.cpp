#include <algorithm>

#include <beeline/error.h>
#include <beeline/io/internal/joint_unit.h>
#include <beeline/io/internal/known_units.h>
#include <beeline/io/text/internal/name.h>

namespace beeline::internal {
namespace {

bool slides(const Joint& joint) { return kind(joint) == JointKind::prismatic; }

/// A column as its name says.
struct NamedColumn {
  std::string name = {};
  const Unit* unit = nullptr;
  int power = 0;  ///< of 1 / s
};

NamedColumn column_of(const ColumnsInUnits& columns, Eigen::Index i) {
  const auto k = static_cast<std::size_t>(i);
  return {columns.given[k], columns.units[k], columns.powers[k]};
}

/// Throws Error for a unit that the joint does not have, or that is not one of this derivative.
void check_unit(const Joint& joint, const NamedColumn& column, int order) {
  if (column.unit == nullptr) return;
  const std::string is_in = "column " + in_quotes(column.name) + " is in " + name_of(*column.unit);
  if (slides(joint) == (column.unit->quantity == Quantity::angle)) {
    throw Error(is_in + ", but joint " + joint.name +
                (slides(joint) ? " slides: m or mm" : " turns: rad or deg"));
  }
  if (column.power == 0 || column.power == order) return;
  const char* const quantities[] = {"a position", "a velocity", "an acceleration"};
  throw Error(is_in + (column.power == 1 ? "/s" : "/s^2") + ", but it is " + quantities[order]);
}

/// Throws Error if a comment gives another unit than the column's name.
void check_comment(const NamedColumn& column, const Unit* in_comment) {
  if (column.unit == nullptr || in_comment == nullptr || column.unit == in_comment) return;
  throw Error("column " + in_quotes(column.name) + " is in " + name_of(*column.unit) +
              ", but a comment says " + name_of(*in_comment));
}

/// Finds the units of one recording.
class UnitFinder {
 public:
  UnitFinder(const Arm& arm, const std::string& path, const RecordedColumns& columns,
             const JointColumns& order, const RecordingOptions& options,
             std::vector<RecordingNote>& notes)
      : arm_(arm),
        path_(path),
        columns_(columns),
        order_(order),
        options_(options),
        notes_(notes),
        first_note_(notes.size()) {
    units_.column_units.resize(columns.joints.names.size());
  }

  KnownUnits find(const JointMap& joint_map, const std::array<bool, 2>& has_rates) {
    units_.joints = joint_map;
    units_.joints.resize(order_.positions.size());
    for (std::size_t k = 0; k < order_.positions.size(); ++k) {
      const Joint& joint = arm_.joint_of(static_cast<Eigen::Index>(k));
      const bool mapped = units_.joints[k].unit.has_value();
      const Unit* const unit = mapped ? nullptr : unit_of_positions(joint, k);
      for (const int order : {1, 2}) {
        if (has_rates[static_cast<std::size_t>(order - 1)]) {
          set_rate(joint, k, order, unit, mapped);
        }
      }
    }
    list_joints_without_unit();
    return std::move(units_);
  }

 private:
  const OrderedUnits& in_comments(const Joint& joint) const {
    return slides(joint) ? columns_.stated.length : columns_.stated.angle;
  }

  static Quantity quantity_of(const Joint& joint) {
    return slides(joint) ? Quantity::length : Quantity::angle;
  }

  /// Returns the unit that a name or a comment gives for joint k, with a note; null for none.
  const Unit* unit_of_positions(const Joint& joint, std::size_t k) {
    const NamedColumn column = column_of(columns_.joints, order_.positions[k]);
    const Unit* const in_comment = in_comments(joint).of(0);
    check_unit(joint, column, 0);
    check_comment(column, in_comment);
    if (column.unit == nullptr) check_read(columns_.stated, quantity_of(joint), 0, path_);
    const Unit* const unit = column.unit != nullptr ? column.unit : in_comment;
    if (unit == nullptr) return nullptr;
    units_.joints[k].unit = unit->si;
    units_.column_units[static_cast<std::size_t>(order_.positions[k])] = unit->si;
    add_note(RecordingNoteKind::named_unit, *unit, column.unit != nullptr ? column.name : "");
    return unit;
  }

  /// The column of the rates of coordinate k; without a name if the file has no names of rates.
  NamedColumn column_of_rates(std::size_t k, int order) const {
    const auto& own = order == 1 ? order_.velocities : order_.accelerations;
    if (!own.empty()) return column_of(columns_.joints, own[k]);
    const ColumnsInUnits& rates = columns_.rates[static_cast<std::size_t>(order - 1)];
    return rates.names.empty() ? NamedColumn() : column_of(rates, order_.positions[k]);
  }

  void set_rate(const Joint& joint, std::size_t k, int order, const Unit* positions, bool mapped) {
    const NamedColumn column = column_of_rates(k, order);
    const OrderedUnits& comments = in_comments(joint);
    const Unit* const stated = comments.of_order[static_cast<std::size_t>(order)];
    check_unit(joint, column, order);
    check_comment(column, stated != nullptr || mapped ? stated : comments.all);
    if (column.unit == nullptr) check_read(columns_.stated, quantity_of(joint), order, path_);
    const Unit* const unit = column.unit != nullptr ? column.unit : stated;
    auto& rates = units_.rates[static_cast<std::size_t>(order - 1)];
    rates.push_back(unit != nullptr ? std::optional(unit->si) : std::nullopt);
    const auto& own = order == 1 ? order_.velocities : order_.accelerations;
    if (!own.empty() && positions != nullptr) {  // matched_to() converts all columns of a joint
      units_.column_units[static_cast<std::size_t>(own[k])] = positions->si;
    }
    if (unit == nullptr) return;
    if (positions == nullptr && !mapped && unit->si != 1) check_positions(joint, k, column, *unit);
    if (column.unit == nullptr && unit != positions) {
      add_note(RecordingNoteKind::named_rate_unit, *unit,
               column.name.empty() ? joint.name : column.name);
    }
  }

  /// Throws Error if nothing gives the unit of positions whose rates are in `unit`.
  void check_positions(const Joint& joint, std::size_t k, const NamedColumn& rates,
                       const Unit& unit) const {
    if (!slides(joint) && is_given()) return;
    const std::string name = column_of(columns_.joints, order_.positions[k]).name;
    throw Error("column " + in_quotes(name) + " has no unit, but " +
                (rates.unit != nullptr ? "column " + in_quotes(rates.name) + " is"
                                       : "its rates are, as a comment says,") +
                " in " + name_of(unit) + "/s" +
                (slides(joint) ? "; a unit behind its name, as in " + in_quotes(name + "_mm") +
                                     ", or a joint map (joint_map, --joint-map) gives it"
                               : "; a unit behind its name, as in " + in_quotes(name + "_deg") +
                                     ", or the option angle_unit (--angle-unit) gives it"));
  }

  /// Whether the options give the unit of angles.
  bool is_given() const { return options_.angle_unit_is_known || options_.match.angle_unit != 1; }

  /// Adds a note on a unit, or the column to such a note.
  void add_note(RecordingNoteKind note_kind, const Unit& unit, const std::string& column) {
    const JointUnit joint_unit = joint_unit_of(unit);
    auto note = std::find_if(notes_.begin() + static_cast<std::ptrdiff_t>(first_note_),
                             notes_.end(), [&](const RecordingNote& other) {
                               return other.kind == note_kind && other.joint_unit == joint_unit &&
                                      other.columns.empty() == column.empty();
                             });
    if (note == notes_.end()) {
      notes_.push_back({.kind = note_kind, .path = path_, .joint_unit = joint_unit});
      note = std::prev(notes_.end());
    }
    if (!column.empty()) note->columns.push_back(column);
  }

  void list_joints_without_unit() {
    std::array<bool, 2> any_named = {};
    for (std::size_t k = 0; k < order_.positions.size(); ++k) {
      const NamedColumn column = column_of(columns_.joints, order_.positions[k]);
      if (column.unit != nullptr)
        any_named[column.unit->quantity == Quantity::length ? 1 : 0] = true;
    }
    for (std::size_t k = 0; k < order_.positions.size(); ++k) {
      const bool length = slides(arm_.joint_of(static_cast<Eigen::Index>(k)));
      if (units_.joints[k].unit || !any_named[length ? 1 : 0]) continue;
      auto& names = length ? units_.lengths_without_unit : units_.angles_without_unit;
      names.push_back(column_of(columns_.joints, order_.positions[k]).name);
    }
  }

  const Arm& arm_;
  const std::string& path_;
  const RecordedColumns& columns_;
  const JointColumns& order_;
  const RecordingOptions& options_;
  std::vector<RecordingNote>& notes_;
  std::size_t first_note_;
  KnownUnits units_;
};

}  // namespace

KnownUnits known_units(const Arm& arm, const std::string& path, const RecordedColumns& columns,
                       const JointColumns& order, const JointMap& joint_map,
                       const Trajectory& recorded, const RecordingOptions& options,
                       std::vector<RecordingNote>& notes) {
  const std::array<bool, 2> has_rates{
      !order.velocities.empty() || !recorded.velocities.empty(),
      !order.accelerations.empty() || !recorded.accelerations.empty()};
  return UnitFinder(arm, path, columns, order, options, notes).find(joint_map, has_rates);
}

void convert_rates(const Arm& arm, const KnownUnits& units, double angle_unit,
                   Trajectory& trajectory) {
  for (const std::size_t order : {1, 2}) {
    auto& values = order == 1 ? trajectory.velocities : trajectory.accelerations;
    const auto& rates = units.rates[order - 1];
    for (std::size_t k = 0; k < rates.size(); ++k) {
      const auto index = static_cast<Eigen::Index>(k);
      const double by_default = slides(arm.joint_of(index)) ? 1 : angle_unit;
      const double own = units.joints[k].unit.value_or(by_default);
      if (!rates[k] || *rates[k] == own) continue;
      for (Configuration& row : values) row[index] *= *rates[k] / own;
    }
  }
}

void note_missing_units(const Arm& arm, const std::string& path, const KnownUnits& units,
                        const StatedUnits& stated, const MissingUnits& missing,
                        std::vector<RecordingNote>& notes) {
  const JointUnit angle = missing.angle_unit == 1 ? JointUnit::radians : JointUnit::degrees;
  for (const bool length : {false, true}) {
    if (!length && !missing.angle_unit_is_assumed) continue;
    const JointUnit unit = length ? JointUnit::metres : angle;
    const auto& columns = length ? units.lengths_without_unit : units.angles_without_unit;
    if (!columns.empty()) {
      notes.push_back({.kind = RecordingNoteKind::no_unit,
                       .path = path,
                       .columns = columns,
                       .joint_unit = unit});
    }
    bool any = false;
    for (std::size_t k = 0; k < units.joints.size(); ++k) {
      any = any ||
            (slides(arm.joint_of(static_cast<Eigen::Index>(k))) == length && !units.joints[k].unit);
    }
    for (const UnclearComment& unclear : stated.unclear) {
      if (!any || !(length ? unclear.lengths : unclear.angles)) continue;
      notes.push_back({.kind = RecordingNoteKind::unclear_comment,
                       .path = path,
                       .joint_unit = unit,
                       .comment = unclear.comment.text});
    }
  }
}

}  // namespace beeline::internal
