#pragma once

#include <beeline/math/revolution.h>
#include <beeline/model/arm.h>

namespace beeline::internal {

/// Whether coordinate k is Arm::periodic() and has no position limits: nothing stops its
/// revolutions.
bool is_continuous(const Arm& arm, int k);

}  // namespace beeline::internal
