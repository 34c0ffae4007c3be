#include <algorithm>
#include <initializer_list>

#include <beeline/internal/letter_case.h>
#include <beeline/io/text/internal/urdf_gripper.h>

namespace beeline::internal {
namespace {

bool contains_any(const std::string& text, std::initializer_list<const char*> words) {
  const std::string lower = lower_case(text);
  return std::any_of(words.begin(), words.end(),
                     [&](const char* word) { return lower.find(word) != std::string::npos; });
}

}  // namespace

bool moves_finger(const UrdfFile::Joint& joint) {
  const auto fingers = {"finger", "knuckle", "thumb", "jaw", "claw"};
  if (contains_any(joint.name, fingers) || contains_any(joint.child, fingers)) return true;
  return contains_any(joint.name, {"gripper"}) &&
         !contains_any(joint.name, {"wrist", "roll", "pitch", "yaw", "rot", "base", "mount"});
}

}  // namespace beeline::internal
