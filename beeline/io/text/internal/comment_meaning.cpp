#include <algorithm>
#include <unordered_map>

#include <beeline/internal/derived_quantity.h>
#include <beeline/io/text/internal/comment_meaning.h>

namespace beeline::internal {
namespace {

struct MeaningWords {
  Meaning meaning;
  std::string_view words;
};

constexpr MeaningWords meaning_words[] = {
    {{WordKind::subject, any_subject},
     "coordinate coordinates unit units value values column columns data entry entries number "
     "numbers quantity quantities "
     "field fields everything"},
    {{WordKind::subject, joint_subject},
     "joint joints axis axes configuration configurations q motor motors drive drives setpoint "
     "setpoints"},
    {{WordKind::subject, time_subject}, "time times timestamp timestamps stamp stamps clock"},
    {{WordKind::subject, angle_subject}, "angle angles angular revolute"},
    {{WordKind::subject, length_subject},
     "length lengths linear prismatic distance distances slides"},
    {{WordKind::subject, position_subject}, "position positions pos"},
    {{WordKind::subject, velocity_subject}, "rate rates qd dq qdot omega"},
    {{WordKind::subject, acceleration_subject}, "qdd ddq qddot"},
    {{WordKind::subject, other_subject},
     "sampling period periods interval intervals step dt frequency frequencies latency delay "
     "delays "
     "timeout tolerance tolerances resolution accuracy precision repeatability noise threshold "
     "thresholds gripper grippers finger fingers camera fov lens duration zone timezone payload "
     "mass "
     "weight stiffness damping inertia gain gains"},
    {{WordKind::subject, single_subject},
     "first third fourth fifth sixth seventh eighth last other others remaining rest some only odd "
     "even except"},
    {{WordKind::link, 0}, "in is are as : = ( [ {"},
    {{WordKind::separator, 0}, "and plus , & + | /"},
    {{WordKind::filler, 0},
     "a an the all of for given expressed measured recorded stored written saved logged provided "
     "represented reported this these here following both respectively each every be been but "
     "using "
     "so also ) ] } \" ' _ - # * ` ~"},
    {{WordKind::negation, 0},
     "not non no never neither nor without isn't aren't don't doesn't wasn't weren't isnt arent"},
    {{WordKind::before_former, 0}, "from to into than was were formerly originally previously"},
    {{WordKind::doubt, 0},
     "converted convert converts converting conversion conversions transformed recalculated "
     "multiplied multiply divide divided scaled instead rather use pass option options flag maybe "
     "perhaps probably possibly might could should would or either unknown unclear assumed assume "
     "guess todo fixme if optional optionally sometimes partly mixed various > \xe2\x86\x92 ?"},
    {{WordKind::truth, 0}, "true false yes on off enabled disabled"},
    {{WordKind::end, 0}, ";"},
    {{WordKind::all_si, 0}, "si"}};

/// Words of the tool, and the subject that they are in a table of poses.
constexpr MeaningWords pose_words[] = {
    {{WordKind::subject, any_subject},
     "tool tcp flange effector eef cartesian pose poses waypoint waypoints"},
    {{WordKind::subject, angle_subject},
     "orientation orientations rotation rotations rpy roll pitch yaw euler theta"},
    {{WordKind::subject, length_subject}, "translation translations xyz blend blends"}};

using Meanings = std::unordered_map<std::string_view, Meaning>;

void add_words(std::string_view words, Meaning meaning, Meanings& meanings) {
  while (!words.empty()) {
    const std::size_t size = std::min(words.find(' '), words.size());
    meanings[words.substr(0, size)] = meaning;
    words.remove_prefix(std::min(size + 1, words.size()));
  }
}

Meanings all_meanings(bool poses) {
  const Meaning other{WordKind::subject, other_subject};
  Meanings meanings;
  for (const MeaningWords& row : meaning_words) {
    const bool joints = (row.meaning.subject & joint_subject) != 0;
    add_words(row.words, poses && joints ? other : row.meaning, meanings);
  }
  for (const MeaningWords& row : pose_words) {
    add_words(row.words, poses ? row.meaning : other, meanings);
  }
  return meanings;
}

}  // namespace

Meaning meaning_of(std::string_view word, bool poses) {
  static const Meanings in_poses = all_meanings(true), in_others = all_meanings(false);
  const Meanings& meanings = poses ? in_poses : in_others;
  const auto found = meanings.find(word);
  if (found != meanings.end()) return found->second;
  const std::optional<DerivedQuantity> quantity = derived_quantity(word);
  if (!quantity) return {};
  if (*quantity == DerivedQuantity::velocity) return {WordKind::subject, velocity_subject};
  if (*quantity == DerivedQuantity::acceleration) return {WordKind::subject, acceleration_subject};
  return {WordKind::subject, other_subject};
}

}  // namespace beeline::internal
