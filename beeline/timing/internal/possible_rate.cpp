#include <algorithm>
#include <array>
#include <cmath>

#include <beeline/timing/internal/possible_rate.h>

namespace beeline::internal {
namespace {

/// The number rounded down to two digits.
double rounded_down(double x) {
  const double unit = std::pow(10, std::floor(std::log10(x)) - 1);
  return std::floor(x / unit) * unit;
}

}  // namespace

void set_possible_rate(const RetimeOptions& options, double duration,
                       const std::function<bool(double rate)>& possible, Reason& reason) {
  constexpr double usual_rate = 1000;
  const bool too_many = reason.code == ReasonCode::too_many_samples_at_rate;
  if (!too_many && reason.code != ReasonCode::no_motion_at_rate) return;
  if (!(duration > 0)) return;
  // Each section takes some periods more than its shortest duration.
  const std::array<double, 3> factors =
      too_many ? std::array{0.9, 0.5, 0.25} : std::array{0.5, 2.0, 4.0};
  for (const double factor : factors) {
    const double wanted =
        too_many ? std::min({factor * options.max_samples / duration, options.rate, usual_rate})
                 : factor * options.rate;
    const double rate = rounded_down(wanted);
    if (!(rate >= lowest_rate) || !possible(rate)) continue;
    reason.set(ReasonField::possible_rate, rate);
    return;
  }
}

}  // namespace beeline::internal
