#pragma once

#include <string>
#include <utility>
#include <vector>

#include <beeline/reason.h>

namespace beeline::testing {

/// A reason and its sentence. Sentences stand here alone: other tests in C++ ask for codes and
/// fields, and pass where every sentence is "X".
struct Said {
  Reason reason;
  std::string sentence;
};

// The reasons of the files of beeline/reason/, each code at least once.
std::vector<Said> said_near_singularities();
std::vector<Said> said_of_clearances();
std::vector<Said> said_of_control();
std::vector<Said> said_of_inverse_kinematics();
std::vector<Said> said_of_paths();
std::vector<Said> said_of_reach();
std::vector<Said> said_of_searches();
std::vector<Said> said_of_times();
std::vector<Said> said_of_trajectories();

using Fields = std::vector<std::pair<ReasonField, ReasonValue>>;

inline Fields with(Fields fields, const Fields& more) {
  fields.insert(fields.end(), more.begin(), more.end());
  return fields;
}

// Fields that several reasons have, and how sentences write them.
inline const Fields of_joint{{ReasonField::joint, "j2"}, {ReasonField::unit, "rad"}};
inline const Fields outside = with(
    of_joint, {{ReasonField::value, 2.0}, {ReasonField::lower, -1.0}, {ReasonField::upper, 1.0}});
inline const std::string is_outside =
    "joint j2 at 2 rad (114.592 deg) is outside its limits -1 rad (-57.2958 deg) to 1 rad "
    "(57.2958 deg)";
inline const Fields late{{ReasonField::ending, Ending::time_limit}};
inline const Fields off{{ReasonField::distance, 0.1}, {ReasonField::angle, 0.2}};
inline const std::string by_both = "0.1 m and 0.2 rad (11.4592 deg)";
inline const Fields stop{{ReasonField::segment, std::size_t{2}},
                         {ReasonField::segment_name, "line 2 of 3"},
                         {ReasonField::is_line, true},
                         {ReasonField::fraction, 0.631},
                         {ReasonField::position, Eigen::Vector3d(0.1, 1e-15, 0.3)}};
inline const std::string stops =
    "line 2 of 3 stops after 63.1 % of its length, at x 0.1, y 0, z 0.3 m: ";
inline const Fields at_sample{{ReasonField::sample, std::size_t{51}}, {ReasonField::time, 0.5}};

}  // namespace beeline::testing
