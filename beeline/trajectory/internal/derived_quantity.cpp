#include <algorithm>
#include <iterator>

#include <beeline/internal/letter_case.h>
#include <beeline/trajectory/internal/derived_quantity.h>

namespace beeline::internal {
namespace {

struct DerivedWord {
  std::string_view word;
  DerivedQuantity quantity;
};

constexpr DerivedWord derived_words[] = {{"velocity", DerivedQuantity::velocity},
                                         {"velocities", DerivedQuantity::velocity},
                                         {"vel", DerivedQuantity::velocity},
                                         {"speed", DerivedQuantity::velocity},
                                         {"acceleration", DerivedQuantity::acceleration},
                                         {"accelerations", DerivedQuantity::acceleration},
                                         {"acc", DerivedQuantity::acceleration},
                                         {"accel", DerivedQuantity::acceleration},
                                         {"effort", DerivedQuantity::effort},
                                         {"efforts", DerivedQuantity::effort},
                                         {"eff", DerivedQuantity::effort},
                                         {"torque", DerivedQuantity::effort},
                                         {"torques", DerivedQuantity::effort},
                                         {"tau", DerivedQuantity::effort},
                                         {"jerk", DerivedQuantity::other},
                                         {"qd", DerivedQuantity::other},
                                         {"dq", DerivedQuantity::other},
                                         {"qdd", DerivedQuantity::other},
                                         {"ddq", DerivedQuantity::other},
                                         {"error", DerivedQuantity::other},
                                         {"errors", DerivedQuantity::other},
                                         {"temperature", DerivedQuantity::other},
                                         {"temperatures", DerivedQuantity::other},
                                         {"voltage", DerivedQuantity::other}};

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

}  // namespace

std::optional<DerivedQuantity> derived_quantity(std::string_view word) {
  const auto* const found =
      std::find_if(std::begin(derived_words), std::end(derived_words),
                   [&word](const auto& known) { return same_ignoring_case(known.word, word); });
  if (found == std::end(derived_words)) return std::nullopt;
  return found->quantity;
}

bool says_derived_quantity(std::string_view text) {
  while (!text.empty()) {
    const char* const last = text.data() + text.size();
    const char* const begin = std::find_if(text.data(), last, is_letter);
    const char* const end = std::find_if_not(begin, last, is_letter);
    if (derived_quantity({begin, static_cast<std::size_t>(end - begin)})) return true;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  }
  return false;
}

}  // namespace beeline::internal
