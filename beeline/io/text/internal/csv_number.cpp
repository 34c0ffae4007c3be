#include <algorithm>

#include <beeline/error.h>
#include <beeline/io/text/internal/csv_number.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/numbers.h>

namespace beeline::internal {
namespace {

constexpr const char* one_separator =
    "; separate them by commas or by semicolons, and write decimal points";

constexpr std::string_view minus_sign = "\xe2\x88\x92", no_break_space = "\xc2\xa0";

/// What to do about an item that is not a number.
const char* cure_of(const std::string& item) {
  if (item.find(no_break_space) != item.npos) return "; it has a no-break space";
  if (has_comment(item)) return comment_apart;
  if (item.find_first_of("[](){}") != item.npos) return no_brackets;
  return item.find_first_of(",;") != item.npos ? one_separator : "";
}

}  // namespace

bool has_comment(std::string_view row) {
  const auto inside = [row](const char* sign) {
    const std::size_t at = row.find(sign);
    return at != row.npos && at > 0 && at + 1 < row.size();
  };
  return inside("#") || inside("%") || inside("//");
}

std::string with_plain_minus(std::string_view text) {
  std::string plain(text);
  for (std::size_t at = 0; (at = plain.find(minus_sign, at)) != plain.npos; ++at) {
    plain.replace(at, minus_sign.size(), "-");
  }
  return plain;
}

double csv_number(std::string item, const std::string& column, char separator,
                  DecimalMarks& marks) {
  item = with_plain_minus(item);
  const bool comma = separator != ',' && std::count(item.begin(), item.end(), ',') == 1 &&
                     item.find('.') == std::string::npos;
  if (comma) std::replace(item.begin(), item.end(), ',', '.');
  try {
    const double value = parse_number(item, "column " + printable(column));
    marks.commas = marks.commas || comma;
    marks.points =
        marks.points || (separator != ',' && !comma && item.find('.') != std::string::npos);
    return value;
  } catch (const Error& error) {
    throw Error(error.what() + std::string(cure_of(item)));
  }
}

}  // namespace beeline::internal
