#include <algorithm>
#include <string>

#include <beeline/internal/derived_quantity.h>
#include <beeline/internal/letter_case.h>

namespace beeline::internal {
namespace {

/// The words of each quantity, between blanks.
struct DerivedWords {
  DerivedQuantity quantity;
  std::string_view words;
};

constexpr DerivedWords derived_words[] = {
    {DerivedQuantity::velocity, " velocity velocities vel speed speeds "},
    {DerivedQuantity::acceleration, " acceleration accelerations acc accel "},
    {DerivedQuantity::effort, " effort efforts eff torque torques tau "},
    {DerivedQuantity::other, " jerk qd dq qdd ddq error errors temperature temperatures voltage "},
    {DerivedQuantity::property,
     " err delta deltas diff difference residual residuals rate rates omega temp current currents "
     "force forces load pwm power status mode min max limit limits offset bias variance variances "
     "std stddev covariance "}};

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

}  // namespace

std::optional<DerivedQuantity> derived_quantity(std::string_view word) {
  const std::string between = " " + lower_case(word) + " ";
  if (word.empty() || word.find(' ') != std::string_view::npos) return std::nullopt;
  for (const auto& [quantity, words] : derived_words) {
    if (words.find(between) != std::string_view::npos) return quantity;
  }
  return std::nullopt;
}

bool says_derived_quantity(std::string_view text) {
  while (!text.empty()) {
    const char* const last = text.data() + text.size();
    const char* const begin = std::find_if(text.data(), last, is_letter);
    const char* const end = std::find_if_not(begin, last, is_letter);
    const auto quantity = derived_quantity({begin, static_cast<std::size_t>(end - begin)});
    if (quantity && *quantity != DerivedQuantity::property) return true;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  }
  return false;
}

}  // namespace beeline::internal
