#pragma once

#include <beeline/doctor/comparison.h>
#include <beeline/doctor/diagnosis.h>

#include "collision_fields.h"
#include "kinematics_fields.h"

namespace beeline::python {

template <>
struct Fields<Finding> : Members<&Finding::kind, &Finding::joint, &Finding::place, &Finding::what,
                                 &Finding::cost, &Finding::remedy> {};

template <>
struct Fields<Diagnosis> : Members<&Diagnosis::findings> {};

template <>
struct Fields<Exemption>
    : Members<&Exemption::names, &Exemption::status, &Exemption::q, &Exemption::depth> {};

template <>
struct Fields<ExemptionOptions>
    : Members<&ExemptionOptions::configurations, &ExemptionOptions::budget> {};

template <>
struct Fields<ModelDifference>
    : Members<&ModelDifference::kind, &ModelDifference::joint, &ModelDifference::parameter,
              &ModelDifference::a, &ModelDifference::b, &ModelDifference::pose,
              &ModelDifference::what, &ModelDifference::remedy> {};

template <>
struct Fields<ComparisonOptions>
    : Members<&ComparisonOptions::tolerance, &ComparisonOptions::configurations> {};

template <>
struct Fields<ArmComparison>
    : Members<&ArmComparison::status, &ArmComparison::explained, &ArmComparison::verdict,
              &ArmComparison::differences, &ArmComparison::alternative, &ArmComparison::gain,
              &ArmComparison::offset, &ArmComparison::before, &ArmComparison::residual,
              &ArmComparison::configurations, &ArmComparison::others> {};

}  // namespace beeline::python
