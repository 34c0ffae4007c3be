#pragma once

#include <string>
#include <string_view>

namespace beeline {
enum class ElementFault;
}  // namespace beeline

namespace beeline::internal {

/// Returns text from a user or a file for a one-line message: control characters and bytes that are
/// not UTF-8 become `?`, text beyond 80 bytes is cut.
std::string printable(std::string_view text);

/// Returns printable(text) in double quotes.
std::string in_quotes(std::string_view text);

/// Returns a text with each byte that is not UTF-8 written as `\xfc`.
std::string with_escaped_bytes(std::string_view text);

/// Returns why a text is no name of an arm, a joint or a link; `none` for a name.
ElementFault name_fault(std::string_view name);

/// Checks a name of an arm, a joint or a link: not empty, UTF-8, no control characters, at most
/// 1000 bytes. Throws Error that begins with `what` otherwise.
void check_name(std::string_view name, std::string_view what);

/// Returns an option that a message of a reader recommends, as a keyword and as the command has it:
/// `tip="hand" (--tip hand)`.
std::string recommended(const std::string& option, const std::string& value);

}  // namespace beeline::internal
