#pragma once

#include <string>

namespace beeline::internal {

/// Numbers in texts, with as many digits as mean something there. JSON and files have all digits.

/// A fraction as a percentage: one decimal, none from 1000 on, two significant digits below 1:
/// `63.7 %`, `100 %`, `0.02 %`.
std::string percent(double fraction);

/// The same rounded up, for an upper bound. A fraction of up to 1 + 1e-6 is shown as `100 %`, a
/// larger one never.
std::string percent_at_most(double fraction);

/// A number with six significant digits, rounded up: a bound that is accepted when it is typed.
std::string number_at_least(double value);

/// A number with six significant digits, and with more if number(reference) looks the same.
std::string number_apart(double value, double reference);

}  // namespace beeline::internal
