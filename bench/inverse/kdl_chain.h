#pragma once

#include "screws.h"

#include <kdl/chain.hpp>

namespace beeline::bench {

KDL::Frame frame_of(const Pose& pose);
Pose pose_of(const KDL::Frame& frame);

/// The arm with KDL's quick joints, about and along z, as for an arm that comes as a DH table.
KDL::Chain kdl_chain(const Screws& screws);

}  // namespace beeline::bench
