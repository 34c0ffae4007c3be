#include <algorithm>
#include <iterator>
#include <span>

#include <beeline/internal/enum_names.h>
#include <beeline/reason.h>

namespace beeline {
namespace {

using internal::EnumNames;

constexpr EnumNames<ReasonCode> code_names("reason");
constexpr EnumNames<ReasonField> field_names("field of a reason");

// The fields by the type of their values.
namespace fields_by_type {
using enum ReasonField;
constexpr ReasonField flags[] = {
    is_line,        beginning,    is_upper,          assumed,         recorded,
    beyond_dwells,  without_file, planned,           refined,         has_position,
    near_singular,  oscillates,   branches_complete, nearest_to_seed, within_pose_tolerance,
    search_limited, kept_at_rate, kept_without_rate, speed_changes,   shows_corners,
    none_kept,      overshoots,   at_singularity,    in_millimetres,  in_degrees};
constexpr ReasonField counts[] = {
    move, line,   lines,      segment, pose,        poses,        sample, step, ReasonField::count,
    of,   joints, conditions, starts,  max_samples, more_samples, point};
constexpr ReasonField reals[] = {fraction,
                                 time,
                                 begin,
                                 end,
                                 clearance,
                                 depth,
                                 s,
                                 value,
                                 lower,
                                 upper,
                                 limit,
                                 angle_limit,
                                 excess,
                                 use,
                                 distance,
                                 angle,
                                 change,
                                 speed,
                                 needed_speed,
                                 rate,
                                 duration,
                                 shortest_duration,
                                 dwell,
                                 error,
                                 held_value,
                                 proof_rate,
                                 proved_rate,
                                 proved_speed,
                                 possible_rate,
                                 kept_speed,
                                 kept_rate,
                                 kept_ramp};
constexpr ReasonField texts[] = {move_name,  segment_name,  arm,       joint,     body,
                                 other_body, unit,          quantity,  held_body, held_joint,
                                 parts,      interpolation, direction, frame};
constexpr ReasonField points[] = {position, nearest, normal};
constexpr ReasonField endings[] = {ending, search_ending};
constexpr std::span<const ReasonField> lists[] = {flags, counts, reals, texts, points, endings};
}  // namespace fields_by_type

constexpr bool contains(std::span<const ReasonField> fields, ReasonField field) {
  return std::find(fields.begin(), fields.end(), field) != fields.end();
}

/// Whether every field is in one list.
consteval bool every_field_has_a_type() {
  std::size_t size = 0;
  for (const auto& list : fields_by_type::lists) size += list.size();
  for (std::size_t i = 0; i < EnumNames<ReasonField>::count; ++i) {
    const auto in = [i](const auto& list) { return contains(list, static_cast<ReasonField>(i)); };
    if (std::none_of(std::begin(fields_by_type::lists), std::end(fields_by_type::lists), in)) {
      return false;
    }
  }
  return size == EnumNames<ReasonField>::count;
}
static_assert(every_field_has_a_type());

}  // namespace

std::string name(ReasonCode code) { return code_names.of(code); }

ReasonCode reason_code_named(std::string_view name) { return code_names.named(name); }

std::string name(ReasonField field) { return field_names.of(field); }

ReasonField reason_field_named(std::string_view name) { return field_names.named(name); }

ReasonValue default_value(ReasonField field) {
  using namespace fields_by_type;
  if (contains(flags, field)) return false;
  if (contains(counts, field)) return std::size_t{0};
  if (contains(texts, field)) return std::string();
  if (contains(points, field)) return Eigen::Vector3d(0, 0, 0);
  if (contains(endings, field)) return Ending::complete;
  return 0.0;
}

const ReasonValue* Reason::find(ReasonField field) const {
  const auto found = std::find_if(fields.begin(), fields.end(),
                                  [&](const auto& entry) { return entry.first == field; });
  return found == fields.end() ? nullptr : &found->second;
}

Reason& Reason::set(ReasonField field, ReasonValue value) {
  const auto found = std::find_if(fields.begin(), fields.end(),
                                  [&](const auto& entry) { return entry.first == field; });
  if (found == fields.end()) {
    fields.emplace_back(field, std::move(value));
  } else {
    found->second = std::move(value);
  }
  return *this;
}

}  // namespace beeline
