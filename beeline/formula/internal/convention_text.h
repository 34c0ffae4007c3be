#pragma once

#include <string>

#include <beeline/formula/formula.h>

namespace beeline::internal {

/// A sentence on the names of an arm's dimensions, as text or as LaTeX.
std::string convention_text(NamingConvention convention, bool latex);

}  // namespace beeline::internal
