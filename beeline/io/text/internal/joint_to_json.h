#pragma once

#include <string>

#include <beeline/model/joint.h>

namespace beeline::internal {

/// Returns the joint as an item of an arm's "joints", over several lines; it reads back exactly.
std::string joint_to_json(const Joint& joint);

}  // namespace beeline::internal
