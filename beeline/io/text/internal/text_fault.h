#pragma once

#include <string>
#include <string_view>

namespace beeline {
enum class ElementFault;
}

namespace beeline::internal {

/// Returns the clause of a message about a text that is no name, number or limit: `"abc" is not a
/// number`.
std::string clause(ElementFault fault, std::string_view text);

}  // namespace beeline::internal
