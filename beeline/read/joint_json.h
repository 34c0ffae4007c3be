#pragma once

#include <string>
#include <vector>

#include <beeline/model/joint.h>
#include <beeline/read/json.h>

namespace beeline {

/// One item of an arm's "joints": several joints where its type is a composite one.
/// Throws FileError naming the place.
std::vector<Joint> joints_from_json(const JsonDocument& document, const Json& json);

/// One item of a DH table's "rows"; `number` counts from 1 and names a row without a name.
Joint dh_joint_from_json(const JsonDocument& document, const Json& json,
                         const std::string& convention, std::size_t number);

/// A joint's item, over several lines, so that it reads back exactly.
std::string joint_to_json(const Joint& joint);

}  // namespace beeline
