#pragma once

#include <string>

#include <beeline/io/text/arm.h>

namespace beeline::internal {

/// Returns the clause of a fault, which an error and a warning of it have: `<origin>: xyz has 2
/// numbers; it must have three, as in "0 0 1"`. Throws Error for a warning that is_fault() denies.
std::string clause(const ReadWarning& fault);

/// Returns the clause without the text that says what to do about the fault.
std::string fact(const ReadWarning& fault);

/// Returns the sentence() of any warning without the place in the file.
std::string statement(const ReadWarning& warning, OptionStyle style);

/// The option that ends the chain at a link, as the style writes it: `--tip hand`.
std::string tip_option(const std::string& tip, OptionStyle style);

}  // namespace beeline::internal
