#pragma once

#include <string>
#include <vector>

#include "verb.h"

namespace beeline::command {

/// The manual page beeline(1) in roff, with all verbs.
std::string man_page(const std::vector<Verb>& verbs);

/// `beeline man`. `verbs` must outlive the verb.
Verb man_verb(const std::vector<Verb>& verbs);

}  // namespace beeline::command
