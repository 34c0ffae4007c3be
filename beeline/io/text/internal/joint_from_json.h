#pragma once

#include <string>
#include <vector>

#include <beeline/io/text/json.h>
#include <beeline/model/joint.h>

namespace beeline::internal {

/// Reads the limits of a joint, each optional; JSON has no infinite ones.
LimitOverrides limit_overrides_from_json(const JsonDocument& document, const Json& json);

/// Reads one item of an arm's "joints": several joints when its type is a composite one.
/// Throws FileError that names the value.
std::vector<Joint> joints_from_json(const JsonDocument& document, const Json& json);

/// Reads one item of the "rows" of a DH table, whose angles are in units of `angle_unit` radians;
/// `number` counts rows from 1 and names a row that has no name.
Joint dh_joint_from_json(const JsonDocument& document, const Json& json, DhConvention convention,
                         double angle_unit, std::size_t number);

}  // namespace beeline::internal
