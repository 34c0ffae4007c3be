#include <tests/reason/said.h>

namespace beeline::testing {

std::vector<Said> said_of_reach() {
  using enum ReasonField;
  return {
      {{ReasonCode::poses_too_far_apart, {}}, "the poses are farther apart than the arm reaches"},
      {{ReasonCode::no_mount_reaches, {{count, std::size_t{5}}, {of, std::size_t{9}}}},
       "the arm reaches all poses from none of the 5 mounts that the map ranks first"},
      {{ReasonCode::no_mount_moves_in_lines, {{count, std::size_t{1}}, {of, std::size_t{1}}}},
       "the arm reaches all poses from 1 mount, but moves in straight lines from none of the 1 "
       "best"},
  };
}

}  // namespace beeline::testing
