#pragma once

#include "screws.h"

#include <kdl/chain.hpp>

namespace beeline::bench {

KDL::Frame frame_of(const Pose& pose);
Pose pose_of(const KDL::Frame& frame);

/// Converts the arm to a KDL chain with joints about and along z, KDL's fastest.
KDL::Chain kdl_chain(const Screws& screws);

}  // namespace beeline::bench
