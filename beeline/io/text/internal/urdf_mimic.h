#pragma once

#include <vector>

#include <beeline/io/text/internal/urdf_file.h>
#include <beeline/model/joint.h>

namespace beeline::internal {

/// Expresses the mimic joints of a chain by coordinates of the chain. A mimic joint beside the
/// chain is replaced by its own leader, repeatedly. A leader beside the chain that is not a mimic
/// joint is eliminated: of the chain's joints that follow it, the first one in the file has a
/// coordinate of its own, within the limits that the leader's range leaves it, and the others
/// follow that joint. With leader value L,
///     q_0 = m_0 L + o_0,  q_i = m_i L + o_i = (m_i / m_0) q_0 + o_i - (m_i / m_0) o_0.
/// Each leader is in the file, and none leads itself: see find_joint_faults().
void resolve_leaders(const UrdfFile& file, std::vector<Joint>& joints);

}  // namespace beeline::internal
