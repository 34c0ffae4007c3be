#include <algorithm>
#include <numbers>

#include <beeline/error.h>
#include <beeline/io/text/arm.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/numbers.h>
#include <beeline/io/text/numbers.h>
#include <beeline/model/internal/ranges.h>
#include <beeline/model/joint.h>

namespace beeline {
namespace {

using internal::in_quotes;
using internal::printable;

bool is_joint_letter(char c) {
  return std::any_of(joint_types().begin(), joint_types().end(),
                     [c](const JointType& type) { return type.letter == c; });
}

struct Item {
  double length = 0;  // metres
  double angle = 0;   // radians, about z, before the joint
  double pitch = 0;   // metres per radian
};

double per_radian(double per_revolution) { return per_revolution / (2 * std::numbers::pi); }

Item default_item(char letter) {
  return {.length = letter == 'P' ? 0.0 : 1.0, .angle = 0, .pitch = per_radian(1)};
}

Item parse_item(std::string_view text, char letter, const std::string& what) {
  Item item = default_item(letter);
  const std::size_t pitch_mark = text.find('p');
  if (pitch_mark != std::string_view::npos) {
    if (letter != 'H') {
      throw Error(what + " gives a pitch to " + letter + "; only H, a helical joint, has one");
    }
    item.pitch = per_radian(parse_number(text.substr(pitch_mark + 1), what + ", pitch"));
    if (item.pitch == 0) throw Error(what + " has a pitch of 0; use R for a joint without travel");
    text = text.substr(0, pitch_mark);
  }
  const std::size_t angle_mark = text.find('@');
  if (angle_mark != std::string_view::npos) {
    const double degrees = parse_number(text.substr(angle_mark + 1), what + ", angle");
    item.angle = degrees * std::numbers::pi / 180;
    text = text.substr(0, angle_mark);
  }
  item.length = parse_number(text, what + ", length");
  return item;
}

std::vector<Item> parse_items(std::string_view letters, std::string_view list) {
  const std::size_t given = static_cast<std::size_t>(std::count(list.begin(), list.end(), ',')) + 1;
  if (given != letters.size()) {
    throw Error("joint string " + printable(letters) + " has " + std::to_string(letters.size()) +
                " letters but " + std::to_string(given) +
                " items; give one length for each letter, as in RRR:3.5,3.5,2");
  }
  std::vector<Item> items;
  for (const char letter : letters) {
    const std::size_t comma = list.find(',');
    const std::string what = "joint string " + printable(letters) + ": item " +
                             std::to_string(items.size() + 1) + ' ' +
                             in_quotes(internal::trimmed(list.substr(0, comma)));
    items.push_back(parse_item(list.substr(0, comma), letter, what));
    list.remove_prefix(comma == std::string_view::npos ? list.size() : comma + 1);
  }
  return items;
}

}  // namespace

bool is_joint_string(std::string_view text) {
  const std::size_t colon = text.find(':');
  const std::string_view letters = text.substr(0, colon);
  if (letters.empty()) return false;
  if (colon == std::string_view::npos) {
    return std::all_of(letters.begin(), letters.end(), is_joint_letter);
  }
  return std::all_of(letters.begin(), letters.end(), [](char c) { return c >= 'A' && c <= 'Z'; });
}

Arm arm_from_joint_string(std::string_view text) {
  const std::size_t colon = text.find(':');
  const std::string_view letters = text.substr(0, colon);
  if (letters.empty()) throw Error("a joint string begins with its letters, as in RRR:3.5,3.5,2");
  if (letters.size() > internal::max_joints) {
    throw Error("joint string " + printable(letters) + " has " + std::to_string(letters.size()) +
                " letters; at most " + std::to_string(internal::max_joints) + " are accepted");
  }
  std::vector<Item> items;
  if (colon == std::string_view::npos) {
    for (const char letter : letters) items.push_back(default_item(letter));
  } else {
    items = parse_items(letters, text.substr(colon + 1));
  }
  std::vector<Joint> joints;
  for (std::size_t i = 0; i < letters.size(); ++i) {
    const std::string name = "joint" + std::to_string(i + 1);
    std::vector<Joint> parts = composite_joint(letters[i], name, items[i].pitch);
    parts.front() = planar_link(std::move(parts.front()), 0, items[i].angle);
    parts.back() = planar_link(std::move(parts.back()), items[i].length);
    for (Joint& part : parts) joints.push_back(std::move(part));
  }
  return {std::string(text.substr(0, 1000)), std::move(joints)};  // as long as a name may be
}

}  // namespace beeline
