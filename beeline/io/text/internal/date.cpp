#include <chrono>
#include <string>

#include <beeline/error.h>
#include <beeline/io/text/internal/date.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/numbers.h>

namespace beeline::internal {
namespace {

bool is_decimal(char c) { return c >= '0' && c <= '9'; }

/// Takes the parts of a date from the front of a text.
class DateText {
 public:
  explicit DateText(std::string_view text) : text_(text), rest_(text) {}

  bool ended() const { return rest_.empty(); }

  /// Takes one of these characters, if it is next.
  bool takes(std::string_view characters) {
    if (ended() || characters.find(rest_.front()) == std::string_view::npos) return false;
    rest_.remove_prefix(1);
    return true;
  }

  /// Takes a number of so many digits, from `least` to `most`.
  int number(std::size_t digits, int least, int most) {
    int value = 0;
    for (std::size_t i = 0; i < digits; ++i) {
      if (ended() || !is_decimal(rest_.front())) refuse();
      value = 10 * value + (rest_.front() - '0');
      rest_.remove_prefix(1);
    }
    if (value < least || value > most) refuse();
    return value;
  }

  /// Takes the digits of a fraction: its nanoseconds.
  int fraction() {
    int value = 0, digits = 0;
    for (; !ended() && is_decimal(rest_.front()) && digits < 9; ++digits) {
      value = 10 * value + (rest_.front() - '0');
      rest_.remove_prefix(1);
    }
    if (digits == 0) refuse();
    for (; digits < 9; ++digits) value *= 10;
    return value;
  }

  [[noreturn]] void refuse() const { throw Error(in_quotes(text_) + not_a_date); }

 private:
  std::string_view text_, rest_;
};

/// Takes a zone: its offset from UTC in minutes; none if there is none.
std::optional<int> take_zone(DateText& text) {
  if (text.takes("Zz")) return 0;
  const bool east = text.takes("+");
  if (!east && !text.takes("-")) return std::nullopt;
  constexpr int most_hours = 23, most_minutes = 59;
  int minutes = 60 * text.number(2, 0, most_hours);
  const bool colon = text.takes(":");
  if (colon || !text.ended()) minutes += text.number(2, 0, most_minutes);
  return east ? minutes : -minutes;
}

}  // namespace

std::optional<Date> parse_date(std::string_view given) {
  constexpr std::string_view form = "0000-00-00";
  const std::string_view trimmed_text = trimmed(given);
  if (trimmed_text.size() < form.size()) return std::nullopt;
  for (std::size_t i = 0; i < form.size(); ++i) {
    const char c = trimmed_text[i];
    if (form[i] == '-' ? c != '-' : !is_decimal(c)) return std::nullopt;
  }
  constexpr int first_year = 1678, last_year = 2261;
  DateText text(trimmed_text);
  const int year = text.number(4, first_year, last_year);
  text.takes("-");
  const int month = text.number(2, 1, 12);
  text.takes("-");
  const int day = text.number(2, 1, 31);
  const std::chrono::year_month_day date{std::chrono::year(year),
                                         std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  if (!date.ok() || !text.takes("Tt ")) text.refuse();
  std::int64_t seconds = 3600 * text.number(2, 0, 23);
  if (!text.takes(":")) text.refuse();
  seconds += 60 * text.number(2, 0, 59);
  int nanoseconds = 0;
  if (text.takes(":")) {
    seconds += text.number(2, 0, 60);  // a leap second
    if (text.takes(".,")) nanoseconds = text.fraction();
  }
  text.takes(" ");
  const std::optional<int> zone = take_zone(text);
  if (!text.ended()) text.refuse();
  const std::int64_t days = std::chrono::sys_days(date).time_since_epoch().count();
  seconds += 86'400 * days - 60 * std::int64_t{zone.value_or(0)};
  return Date{seconds * 1'000'000'000 + nanoseconds, zone.has_value()};
}

}  // namespace beeline::internal
