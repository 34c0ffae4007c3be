#pragma once

#include <string>
#include <string_view>

namespace beeline {

/// Foreign text for a one-line message: control characters become `?`, long text is cut.
std::string printable(std::string_view text);

/// printable(text) in double quotes.
std::string in_quotes(std::string_view text);

/// Names of arms, joints and links: not empty, UTF-8, no control characters, at most 1000 bytes.
/// Throws Error that begins with `what` otherwise.
void check_name(std::string_view name, std::string_view what);

}  // namespace beeline
