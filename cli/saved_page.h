#pragma once

#include <string>

#include "page_server.h"

namespace beeline::command {

/// Returns the page of an arm as one HTML document, which opens from a disk without a network:
/// saved.html of the built page's folder with the files that it names. Throws Error where the
/// folder has no saved.html.
std::string saved_page(const std::string& folder, const PageSession& session);

}  // namespace beeline::command
