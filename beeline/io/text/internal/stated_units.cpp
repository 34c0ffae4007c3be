#include <algorithm>

#include <beeline/error.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/numbers.h>
#include <beeline/io/text/internal/stated_units.h>
#include <beeline/io/text/internal/unit_clause.h>

namespace beeline::internal {
namespace {

/// Collects the units of comments.
class StatementReader {
 public:
  StatementReader(const std::vector<std::string>& columns, const std::string& path)
      : words_(columns), path_(path) {}

  void read(const Comment& comment) {
    const std::vector<CommentWord> words = words_.words_of(comment.text);
    UnclearComment unclear{comment};
    for (auto begin = words.begin(); begin != words.end();) {
      const auto end = std::find_if(
          begin, words.end(), [](const CommentWord& word) { return word.kind == WordKind::end; });
      const std::span<const CommentWord> words_of_clause(words.data() + (begin - words.begin()),
                                                         static_cast<std::size_t>(end - begin));
      const UnitClause clause = unit_clause(words_of_clause);
      for (const UnitClaim& claim : clause.claims) add(claim, comment);
      unclear.angles = unclear.angles || clause.unclear.angles;
      unclear.lengths = unclear.lengths || clause.unclear.lengths;
      unclear.times = unclear.times || clause.unclear.times;
      begin = end == words.end() ? end : end + 1;
    }
    if (unclear.angles || unclear.lengths || unclear.times) stated_.unclear.push_back(unclear);
  }

  StatedUnits finish() { return std::move(stated_); }

 private:
  void add(const UnitClaim& claim, const Comment& comment) {
    if (claim.unit == nullptr) {
      const bool all = claim.order < 0;
      stated_.unread.push_back(
          {comment, claim.text, claim.times, all ? std::nullopt : std::optional(claim.order)});
      return;
    }
    for (const std::size_t column : claim.columns) {
      stated_.columns.push_back({column, claim.unit, claim.text});
    }
    if (!claim.columns.empty()) return;
    if (claim.times) return set(stated_.time, *claim.unit, "times", comment);
    const bool angles = claim.unit->quantity == Quantity::angle;
    OrderedUnits& units = angles ? stated_.angle : stated_.length;
    constexpr const char* names[] = {"positions", "velocities", "accelerations"};
    if (claim.order < 0) {
      set(units.all, *claim.unit, angles ? "angles" : "lengths", comment);
    } else {
      set(units.of_order[static_cast<std::size_t>(claim.order)], *claim.unit, names[claim.order],
          comment);
    }
    const Unit* positions = units.of_order[0];
    if (units.all != nullptr && positions != nullptr) {
      set(positions, *units.all, "positions", comment);
    }
  }

  void set(const Unit*& stated, const Unit& unit, const char* what, const Comment& comment) const {
    if (stated != nullptr && stated != &unit) {
      throw FileError(path_, comment.line,
                      std::string("the comments give ") + what + " in " + name_of(*stated) +
                          " and in " + name_of(unit) +
                          "; write the unit behind each column's name");
    }
    stated = &unit;
  }

  ColumnWords words_;
  const std::string& path_;
  StatedUnits stated_;
};

/// The unit that comments give for a column in `target`; null for none.
const Unit* unit_in_comments(const std::string& column, const Unit& target,
                             const StatedUnits& stated, const std::string& path) {
  check_read(stated, target.quantity, 0, path);
  const bool angles = target.quantity == Quantity::angle;
  const Unit* const unit = (angles ? stated.angle : stated.length).of(0);
  if (unit == nullptr && target.si == 1) check_clear(stated, target.quantity, path);
  if (unit != nullptr && target.si != 1 && unit != &target) {
    throw Error("column " + printable(column) + " is in " + name_of(*unit) +
                ", as a comment says, but is asked for in " + name_of(target));
  }
  return unit;
}

/// Returns the comments without those that Beeline has written, which are not about units. A
/// statement that someone has added below them, such as `units: deg`, stays.
std::vector<Comment> comments_of_others(const std::vector<Comment>& comments) {
  std::vector<Comment> others;
  int own_line = -1;  // the last of Beeline's comments
  for (const Comment& comment : comments) {
    const std::string_view text = trimmed(comment.text);
    const bool continues = own_line >= 0 && comment.line == own_line + 1;
    if (text.starts_with(own_comment) || continues) own_line = comment.line;
    const bool is_own = own_line == comment.line && !text.starts_with("unit");
    if (!is_own) others.push_back(comment);
  }
  return others;
}

}  // namespace

bool UnclearComment::is_on(Quantity quantity) const {
  if (quantity == Quantity::time) return times;
  return quantity == Quantity::angle ? angles : lengths;
}

bool StatedUnits::is_within(const StatedUnits& other) const {
  const auto same = [](const Unit* own, const Unit* given) {
    return own == nullptr || own == given;
  };
  const auto are_same = [&](const OrderedUnits& own, const OrderedUnits& given) {
    return same(own.all, given.all) &&
           std::equal(own.of_order.begin(), own.of_order.end(), given.of_order.begin(), same);
  };
  return are_same(angle, other.angle) && are_same(length, other.length) && same(time, other.time) &&
         columns.empty();
}

StatedUnits stated_units(const std::vector<Comment>& comments,
                         const std::vector<std::string>& columns, const std::string& path) {
  if (comments.empty()) return {};
  StatementReader reader(columns, path);
  for (const Comment& comment : comments_of_others(comments)) reader.read(comment);
  return reader.finish();
}

void name_units(const StatedUnits& stated, std::vector<std::string>& columns) {
  for (const auto& [column, unit, text] : stated.columns) {
    std::string& name = columns[column];
    const Unit* const own = unit->quantity == Quantity::time
                                ? split_at_time_unit(name).unit
                                : columns_in_units({name}, {}).units.front();
    if (own != nullptr && own != unit && unit->quantity == Quantity::time) {
      throw Error("column " + printable(name) + " is in " + name_of(*own) +
                  ", but a comment says " + name_of(*unit));
    }
    if (own != unit) name += " [" + text + "]";
  }
}

void check_read(const StatedUnits& stated, Quantity quantity, int order, const std::string& path) {
  const bool times = quantity == Quantity::time;
  for (const UnreadUnit& unread : stated.unread) {
    if (unread.times != times || (!times && unread.order.value_or(order) != order)) continue;
    throw FileError(path, unread.comment.line,
                    "the comment " + in_quotes(unread.comment.text) + " gives the unit " +
                        in_quotes(unread.unit) + ", which is not read; " + units_that_are_read);
  }
}

void check_clear(const StatedUnits& stated, Quantity quantity, const std::string& path) {
  for (const UnclearComment& unclear : stated.unclear) {
    if (!unclear.is_on(quantity)) continue;
    const char* const examples[] = {"roll_rad or roll_deg", "x_m or x_mm", "time_s or time_ms"};
    throw FileError(path, unclear.comment.line,
                    "the comment " + in_quotes(unclear.comment.text) +
                        " does not say clearly in which unit the columns are; write it behind "
                        "their names, as " +
                        examples[static_cast<int>(quantity)]);
  }
}

std::vector<double> factors_to(const std::vector<std::string>& wanted,
                               const ColumnsInUnits& columns, const StatedUnits& stated,
                               const std::string& path) {
  std::vector<double> factors;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const Unit* unit = columns.units[i];
    const Unit* const target = unit_called(wanted[i]);
    if (unit != nullptr && (target == nullptr || target->quantity != unit->quantity)) {
      const char* const units = target == nullptr                     ? "has no unit"
                                : target->quantity == Quantity::angle ? "is an angle: rad or deg"
                                                                      : "is a length: m or mm";
      throw Error("column " + printable(columns.given[i]) + " is in " + name_of(*unit) +
                  ", but it " + units);
    }
    if (unit == nullptr && target != nullptr) {
      unit = unit_in_comments(columns.given[i], *target, stated, path);
    }
    factors.push_back(unit == nullptr ? 1 : unit->si / target->si);
  }
  return factors;
}

std::vector<std::string> commented_units(const ColumnsInUnits& columns, const StatedUnits& stated,
                                         const std::vector<double>& factors) {
  const auto is_commented = [&](std::size_t i) {
    return columns.units[i] == nullptr ||
           std::any_of(stated.columns.begin(), stated.columns.end(),
                       [i](const UnitOfColumn& of_column) { return of_column.column == i; });
  };
  std::vector<std::string> names;
  for (const Unit& unit : all_units()) {
    bool any = false;
    for (std::size_t i = 0; i < factors.size(); ++i) {
      any = any || (is_commented(i) && factors[i] != 1 && factors[i] == unit.si);
    }
    if (any && unit.quantity != Quantity::time) names.push_back(name_of(unit));
  }
  return names;
}

}  // namespace beeline::internal
