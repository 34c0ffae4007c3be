#pragma once

#include <beeline/certificate/verify.h>

#include "path_fields.h"
#include "reason.h"
#include "trajectory_fields.h"

namespace beeline::python {

template <>
struct Fields<MovingEnds> : Members<&MovingEnds::start, &MovingEnds::end> {
  static constexpr std::size_t required = 2;
  static constexpr bool as_tuple = true;
};

template <>
struct Fields<JointFault> : Members<&JointFault::kind, &JointFault::sample, &JointFault::reason> {};

template <>
struct Fields<FaultsOfKind>
    : Members<&FaultsOfKind::kind, &FaultsOfKind::sample, &FaultsOfKind::time, &FaultsOfKind::first,
              &FaultsOfKind::worst, &FaultsOfKind::amount> {};

template <>
struct Fields<PathDeviation>
    : Members<&PathDeviation::sampled, &PathDeviation::measured, &PathDeviation::bound,
              &PathDeviation::interval_bounds, &PathDeviation::ending> {};

template <>
inline constexpr bool reports<VerifyOptions> = false;
template <>
struct Fields<VerifyOptions>
    : Members<&VerifyOptions::moving, &VerifyOptions::task, &VerifyOptions::tolerance,
              &VerifyOptions::orientation_tolerance, &VerifyOptions::limit_tolerance,
              &VerifyOptions::recover, &VerifyOptions::budget> {};

template <>
struct Fields<Verification>
    : Members<&Verification::fault, &Verification::reason, &Verification::sample,
              &Verification::time, &Verification::faults, &Verification::deviation,
              &Verification::path, &Verification::path_parameters, &Verification::arrivals,
              &Verification::recovery, &Verification::ending> {};

}  // namespace beeline::python
