#include <algorithm>
#include <initializer_list>

#include <beeline/read/internal/urdf_gripper.h>

namespace beeline::internal {
namespace {

bool contains_any(std::string text, std::initializer_list<const char*> words) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return std::any_of(words.begin(), words.end(),
                     [&](const char* word) { return text.find(word) != std::string::npos; });
}

}  // namespace

bool moves_finger(const UrdfFile::Joint& joint) {
  const auto fingers = {"finger", "knuckle", "thumb", "jaw", "claw"};
  if (contains_any(joint.name, fingers) || contains_any(joint.child, fingers)) return true;
  return contains_any(joint.name, {"gripper"}) &&
         !contains_any(joint.name, {"wrist", "roll", "pitch", "yaw", "rot", "base", "mount"});
}

}  // namespace beeline::internal
