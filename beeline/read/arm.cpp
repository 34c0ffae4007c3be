#include <algorithm>

#include <beeline/error.h>
#include <beeline/model/catalog.h>
#include <beeline/read/arm.h>
#include <beeline/read/arm_json.h>
#include <beeline/read/file.h>
#include <beeline/read/joint_string.h>
#include <beeline/read/name.h>
#include <beeline/read/urdf.h>

namespace beeline {
namespace {

void refuse_ends(const std::string& text, const ChainEnds& ends) {
  if (ends.base.empty() && ends.tip.empty()) return;
  throw Error("base and tip cut a chain out of a URDF file; " + in_quotes(text) + " is none");
}

Arm read_arm_file(const std::string& path, const ChainEnds& ends) {
  const std::string format = extension(path);
  if (format == "urdf" || format == "xml") return read_urdf(path, ends);
  if (format == "xacro") {
    throw FileError(path, 0, "is a xacro file; run xacro first and give the URDF it writes");
  }
  refuse_ends(path, ends);
  if (format == "json") return read_arm_json(path);
  throw FileError(path, 0, "is no known kind of arm file; known are .urdf and .json");
}

/// The built-in name that equals `text` up to the case of letters; empty if there is none. A joint
/// string such as RRR is not a name, although an arm is called rrr.
std::string built_in_name(const std::string& text) {
  std::string lower = text;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  const std::vector<std::string> names = built_in_names();
  const bool known = std::find(names.begin(), names.end(), lower) != names.end();
  return known && (lower == text || !is_joint_string(text)) ? lower : "";
}

}  // namespace

Arm read_arm(const std::string& text, const ChainEnds& ends) {
  const std::string name = built_in_name(text);
  if (!name.empty() || is_joint_string(text)) {
    refuse_ends(text, ends);
    return name.empty() ? arm_from_joint_string(text) : built_in(name);
  }
  if (text.find_first_of("./") != std::string::npos) return read_arm_file(text, ends);
  throw Error(std::string(unknown_name("arm", printable(text), built_in_names()).what()) +
              "; or give a joint string such as RRR:3.5,3.5,2, or a .urdf or .json file");
}

}  // namespace beeline
