#pragma once

#include <string>

#include <beeline/model/arm.h>

namespace beeline::command {

/// Returns the page of an arm as one HTML document, which opens from a disk without a network:
/// saved.html of the built page's folder with the files that it names. `trajectory`: the text of a
/// .csv file that it plays; empty: none. Throws Error where the folder has no saved.html.
std::string saved_page(const std::string& folder, const Arm& arm, const std::string& trajectory);

}  // namespace beeline::command
