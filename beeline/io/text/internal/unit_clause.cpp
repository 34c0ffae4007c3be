#include <algorithm>

#include <beeline/io/text/internal/unit_clause.h>

namespace beeline::internal {
namespace {

/// Words that name what a unit belongs to, between separators.
struct Phrase {
  unsigned words = 0;  ///< of Subject
  std::vector<std::size_t> columns = {}, columns_of_times = {};

  bool has_columns() const { return !columns.empty() || !columns_of_times.empty(); }
  bool empty() const { return words == 0 && !has_columns(); }
  bool has(unsigned subjects) const { return (words & subjects) != 0; }
  bool is_other() const { return has(other_subject); }
  bool is_single() const {
    return has(single_subject) || (has_columns() && has(velocity_subject | acceleration_subject));
  }
  /// The derivative that the words name; -1 if they do not.
  int order() const {
    if (has(acceleration_subject)) return 2;
    if (has(velocity_subject)) return 1;
    return has(position_subject) ? 0 : -1;
  }
  bool is_of_times() const { return has(time_subject); }
};

/// The quantity of a unit; none if it may be of angles or lengths.
std::optional<Quantity> quantity_of(const CommentWord& word) {
  if (word.unit != nullptr) return word.unit->quantity;
  return word.foreign != nullptr ? word.foreign->quantity : std::nullopt;
}

/// The columns of the phrase that may have the unit: only columns of times may have a unit of
/// times.
const std::vector<std::size_t>& columns_for(const Phrase& phrase, const CommentWord& word) {
  const std::optional<Quantity> quantity = quantity_of(word);
  const bool times = quantity ? *quantity == Quantity::time : phrase.columns.empty();
  return times ? phrase.columns_of_times : phrase.columns;
}

/// Whether the phrase names the quantity of the unit.
bool takes(const Phrase& phrase, const CommentWord& word) {
  if (phrase.is_other() || phrase.empty()) return false;
  if (phrase.has_columns()) return !columns_for(phrase, word).empty();
  const std::optional<Quantity> quantity = quantity_of(word);
  if (quantity == Quantity::time) {
    return word.power == 0 && (phrase.is_of_times() || phrase.words == any_subject);
  }
  if (phrase.is_of_times()) return !quantity && word.power == 0;
  const bool angles = phrase.has(angle_subject), lengths = phrase.has(length_subject);
  if (quantity == Quantity::angle && lengths && !angles) return false;
  if (quantity == Quantity::length && angles && !lengths) return false;
  return phrase.order() < 0 || word.power == 0 || word.power == phrase.order();
}

/// Reads the words of a clause one by one.
class ClauseReader {
 public:
  explicit ClauseReader(std::span<const CommentWord> words) : words_(words) {
    if (has_units_only()) current_.words = any_subject;
  }

  UnitClause read() {
    for (; at_ < words_.size(); ++at_) take(words_[at_]);
    return finish();
  }

 private:
  /// Whether the clause is a list of units without a subject. Words that have other meanings too,
  /// such as counts, are units beside others alone.
  bool has_units_only() const {
    bool any = false;
    for (const CommentWord& word : words_) {
      switch (word.kind) {
        case WordKind::unit:
          any = true;
          break;
        case WordKind::unread_unit:
          any = any || word.foreign == nullptr || word.foreign->is_only_a_unit;
          break;
        case WordKind::other_unit:
        case WordKind::filler:
        case WordKind::link:
        case WordKind::separator:
        case WordKind::negation:
          break;
        default:
          return false;
      }
    }
    return any;
  }

  void take(const CommentWord& word) {
    switch (word.kind) {
      case WordKind::column:
      case WordKind::subject:
        return take_subject(word);
      case WordKind::separator:
        return take_separator(word);
      case WordKind::link:
        linked_ = true;
        return;
      case WordKind::filler:
      case WordKind::end:
        return;
      case WordKind::negation:
        return take_negation();
      case WordKind::before_former:
        doubtful_ = doubtful_ || next_unit() != nullptr;
        return take_other_word(word);
      case WordKind::doubt:
        doubtful_ = true;
        return take_other_word(word);
      case WordKind::unit:
      case WordKind::unread_unit:
      case WordKind::other_unit:
      case WordKind::all_si:
        return take_unit(word);
      case WordKind::number:
      case WordKind::truth:
        if (behind_unit_ && at_ > 0 && words_[at_ - 1].kind == WordKind::link) doubtful_ = true;
        return take_other_word(word);
      case WordKind::unknown:
        return take_other_word(word);
    }
  }

  void take_subject(const CommentWord& word) {
    const bool other = (word.subject & other_subject) != 0;
    if (behind_unit_ || (interrupted_ && (other || current_.is_other()))) {
      phrases_.clear();
      current_ = {};
    }
    behind_unit_ = interrupted_ = linked_ = false;
    current_.words |= word.subject;
    if (word.kind == WordKind::column) {
      (word.has_times ? current_.columns_of_times : current_.columns).push_back(word.column);
    }
    names_units_ = names_units_ || word.text == "unit" || word.text == "units";
  }

  void take_separator(const CommentWord& word) {
    linked_ = behind_unit_ || word.text == "/";
    if (behind_unit_ || current_.empty()) return;
    phrases_.push_back(std::move(current_));
    current_ = {};
  }

  /// A word that is neither a subject nor a unit.
  void take_other_word(const CommentWord& word) {
    const bool in_place_of_unit =
        (word.kind == WordKind::unknown || word.kind == WordKind::doubt) && linked_ &&
        !interrupted_;
    if (in_place_of_unit && !behind_unit_ && names_units_) has_strange_unit_ = true;
    interrupted_ = true;
    linked_ = false;
  }

  /// The unit that follows, behind fillers and `in`.
  const CommentWord* next_unit() const {
    for (std::size_t i = at_ + 1; i < words_.size(); ++i) {
      const CommentWord& word = words_[i];
      if (word.kind == WordKind::filler || word.text == "in") continue;
      const bool unit = word.kind == WordKind::unit || word.kind == WordKind::unread_unit;
      return unit ? &word : nullptr;
    }
    return nullptr;
  }

  /// `not in radians` denies a unit beside which another one must be stated.
  void take_negation() {
    const CommentWord* const denied = next_unit();
    if (denied == nullptr || denied->unit == nullptr) {
      doubtful_ = true;
      return;
    }
    denied_.push_back(denied);
    at_ = static_cast<std::size_t>(denied - words_.data());
  }

  /// `10 ms`, `45-deg`.
  bool is_amount() const {
    if (at_ > 0 && words_[at_ - 1].kind == WordKind::number) return true;
    return at_ > 1 && words_[at_ - 1].text == "-" && words_[at_ - 2].kind == WordKind::number;
  }

  void take_unit(const CommentWord& word) {
    const bool has_phrase = !current_.empty() || !phrases_.empty();
    const bool bound = has_phrase && (!interrupted_ || linked_);
    if (word.kind == WordKind::all_si) {
      has_si_ = true;
    } else if (is_amount()) {
      return take_other_word(word);
    } else if (word.kind == WordKind::other_unit) {
      has_other_unit_ = true;
    } else if (bound) {
      claim(word);
    } else {
      return take_loose(word);
    }
    behind_unit_ = true;
    interrupted_ = linked_ = false;
  }

  /// A unit without a subject. Single letters, and words with other meanings, are no units then.
  void take_loose(const CommentWord& word) {
    const ForeignUnit* const foreign = word.foreign;
    const bool is_foreign =
        foreign != nullptr && !foreign->is_only_a_unit && !(linked_ && foreign->counts_in_names);
    const bool has_other_meaning = word.text.size() == 1 || is_foreign;
    if (!has_other_meaning) add(word, loose_);
    take_other_word(word);
  }

  static void add(const CommentWord& word, QuantitySet& set) {
    const std::optional<Quantity> quantity = quantity_of(word);
    set.times = set.times || quantity == Quantity::time;
    set.angles = set.angles || !quantity || quantity == Quantity::angle;
    set.lengths = set.lengths || !quantity || quantity == Quantity::length;
  }

  void claim(const CommentWord& word) {
    std::vector<Phrase> phrases = phrases_;
    if (!current_.empty()) phrases.push_back(current_);
    std::vector<Phrase> takers;
    std::copy_if(phrases.begin(), phrases.end(), std::back_inserter(takers),
                 [&](const Phrase& phrase) { return takes(phrase, word) && !phrase.is_single(); });
    // In `positions, velocities in rad, deg/s` the first unit is not one of velocities.
    const auto is_of_positions = [](const Phrase& phrase) { return phrase.order() <= 0; };
    if (word.power == 0 && std::any_of(takers.begin(), takers.end(), is_of_positions)) {
      std::erase_if(takers, [&](const Phrase& phrase) { return !is_of_positions(phrase); });
    }
    for (const Phrase& phrase : takers) {
      const bool times = phrase.is_of_times() || quantity_of(word) == Quantity::time;
      const int order = phrase.order() >= 0 ? phrase.order() : word.power > 0 ? word.power : -1;
      claims_.push_back(
          {word.unit, word.text, word.power, times, order, columns_for(phrase, word)});
    }
    const auto is_other = [](const Phrase& phrase) { return phrase.is_other(); };
    const bool ignored = !interrupted_ && std::any_of(phrases.begin(), phrases.end(), is_other) &&
                         std::none_of(phrases.begin(), phrases.end(),
                                      [](const Phrase& phrase) { return phrase.is_single(); });
    if (takers.empty() && !ignored) add(word, loose_);
  }

  bool is_denied_clearly(const CommentWord& denied) const {
    const auto replaces = [&](const UnitClaim& claim) {
      return claim.unit != nullptr && claim.unit->quantity == denied.unit->quantity;
    };
    const auto is_same = [&](const UnitClaim& claim) { return claim.unit == denied.unit; };
    return std::any_of(claims_.begin(), claims_.end(), replaces) &&
           std::none_of(claims_.begin(), claims_.end(), is_same);
  }

  void claim_si() {
    for (const Unit& unit : all_units()) {
      if (unit.si != 1) continue;
      claims_.push_back(
          {.unit = &unit, .text = name_of(unit), .times = unit.quantity == Quantity::time});
    }
  }

  UnitClause finish() {
    if (has_si_ && names_units_) claim_si();
    for (const CommentWord* denied : denied_) doubtful_ = doubtful_ || !is_denied_clearly(*denied);
    UnitClause clause{.claims = std::move(claims_), .unclear = loose_};
    if (doubtful_) {
      for (const CommentWord* denied : denied_) add(*denied, clause.unclear);
      for (const UnitClaim& claim : clause.claims) {
        const bool length = claim.unit != nullptr && claim.unit->quantity == Quantity::length;
        clause.unclear.times = clause.unclear.times || claim.times;
        clause.unclear.lengths = clause.unclear.lengths || length;
        clause.unclear.angles = clause.unclear.angles || !(claim.times || length);
      }
      clause.claims.clear();
    }
    const bool only_others = has_other_unit_ && names_units_;
    if ((has_strange_unit_ || only_others) && clause.claims.empty()) {
      clause.unclear = {true, true, has_strange_unit_ || clause.unclear.times};
    }
    return clause;
  }

  std::span<const CommentWord> words_;
  std::size_t at_ = 0;
  std::vector<Phrase> phrases_;  ///< before the current one
  Phrase current_;
  bool behind_unit_ = false;  ///< a subject begins a new statement
  bool interrupted_ = false;  ///< by other words since the last subject or unit
  bool linked_ = false;       ///< by `in` or the like to the next word
  bool names_units_ = false, has_strange_unit_ = false, has_other_unit_ = false, has_si_ = false;
  bool doubtful_ = false;
  std::vector<const CommentWord*> denied_;
  std::vector<UnitClaim> claims_;
  QuantitySet loose_;
};

}  // namespace

UnitClause unit_clause(std::span<const CommentWord> words) { return ClauseReader(words).read(); }

}  // namespace beeline::internal
