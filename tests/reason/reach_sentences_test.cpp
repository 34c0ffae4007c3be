#include <tests/reason/said.h>

namespace beeline::testing {

std::vector<Said> said_of_reach() {
  using enum ReasonField;
  const Reason close{ReasonCode::bodies_too_close,
                     {{body, "hand"},
                      {other_body, "table"},
                      {clearance, 0.01},
                      {distance, 0.004},
                      {position, Eigen::Vector3d(0.1, 0, 0.3)}}};
  return {
      {{ReasonCode::poses_too_far_apart, {}}, "the poses are farther apart than the arm reaches"},
      {{ReasonCode::no_mount_reaches, {{count, std::size_t{5}}, {of, std::size_t{9}}}},
       "the arm reaches all poses from none of the 5 mounts that the map ranks first"},
      {{ReasonCode::no_mount_reaches, {{count, std::size_t{9}}, {of, std::size_t{9}}}, {close}},
       "the arm reaches all poses with free solutions from none of the 9 mounts; at the first one "
       "that reaches them: hand is 0.004 m from table at (0.1, 0, 0.3) m, closer than the "
       "clearance "
       "of 0.01 m"},
      {{ReasonCode::no_mount_moves_in_lines, {{count, std::size_t{1}}, {of, std::size_t{1}}}},
       "the arm reaches all poses from 1 mount, but moves in straight lines from none of the 1 "
       "best"},
  };
}

}  // namespace beeline::testing
