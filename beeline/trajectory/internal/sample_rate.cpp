#include <cmath>

#include <beeline/error.h>
#include <beeline/trajectory/internal/sample_rate.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

void check_rate(double rate, const std::string& zero) {
  if (rate >= lowest_rate && std::isfinite(rate)) return;
  if (rate == 0 && !zero.empty()) return;
  throw Error::of("rate", "the rate must be " + number(lowest_rate) +
                              " samples per second or above" +
                              (zero.empty() ? "" : ", or 0 for " + zero) + ", not " + number(rate));
}

}  // namespace beeline::internal
