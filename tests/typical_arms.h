#pragma once

#include <string>
#include <vector>

namespace beeline::testing {

/// Built-in arms of each kind, for tests that take long: planar, with and without prismatic joints,
/// SCARA, six joints with a spherical wrist, a sliding joint or three parallel axes, seven joints.
inline const std::vector<std::string> typical_arms{
    "rrr", "rp", "gantry", "puma560", "ur5", "ur5e", "panda", "iiwa14", "scara", "stanford"};

}  // namespace beeline::testing
