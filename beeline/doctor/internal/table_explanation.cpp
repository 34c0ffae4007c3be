#include <cmath>

#include <beeline/doctor/internal/explanations.h>
#include <beeline/model/internal/dh_row.h>
#include <beeline/pose/so3.h>

namespace beeline::internal {
namespace {

/// A parameter of a row that the joint's coordinate is not added to.
struct FixedParameter {
  const char* name;
  double DhRow::*value;
  bool angle;
};
constexpr FixedParameter parameters[] = {{"a", &DhRow::a, false},
                                         {"alpha", &DhRow::alpha, true},
                                         {"d", &DhRow::d, false},
                                         {"theta", &DhRow::theta, true}};

bool is_coordinate(const FixedParameter& parameter, JointKind kind) {
  return parameter.value == (kind == JointKind::prismatic ? &DhRow::d : &DhRow::theta);
}

std::optional<Reconciliation> table_explanation(const Arm& a, const Arm& b, DhConvention convention,
                                                double tolerance) {
  const std::optional<DhRows> rows_a = own_dh_rows(a, convention),
                              rows_b = own_dh_rows(b, convention);
  if (!rows_a || !rows_b || rows_a->size() != rows_b->size()) return std::nullopt;
  Reconciliation explanation(a);
  DhRows rows = *rows_a;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const DhRow& other = (*rows_b)[i];
    if (rows[i].kind != other.kind) return std::nullopt;
    for (const FixedParameter& parameter : parameters) {
      double& value = rows[i].*parameter.value;
      const double in_b = other.*parameter.value;
      const double apart = parameter.angle ? wrap_angle(in_b - value) : in_b - value;
      if (std::abs(apart) <= tolerance) continue;
      if (is_coordinate(parameter, other.kind)) {
        explanation.offset[static_cast<Eigen::Index>(i)] = -apart;
        explanation.differences.push_back(offset_difference(a, i, -apart));
        continue;
      }
      explanation.differences.push_back(
          parameter_difference(parameter.angle ? DifferenceKind::angle : DifferenceKind::length, i,
                               parameter.name, value, in_b));
      value = in_b;
    }
  }
  explanation.arm = with_rows(a, rows, convention);
  add_end_differences(a, b, tolerance, explanation);
  return explanation;
}

}  // namespace

std::optional<DhRows> own_dh_rows(const Arm& arm, DhConvention convention) {
  constexpr double tolerance = 1e-8;
  DhRows rows;
  for (const Joint& joint : arm.joints()) {
    const std::optional<DhRow> row = dh_row(joint, convention, tolerance);
    if (!row) return std::nullopt;
    rows.push_back(*row);
  }
  return rows;
}

Arm with_rows(const Arm& arm, const DhRows& rows, DhConvention convention) {
  std::vector<Joint> joints = arm.joints();
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const Joint joint = dh_joint(rows[i], convention);
    joints[i].offset = joint.offset;
    joints[i].screw = joint.screw;
  }
  return {arm.name(), joints, arm.tool(), arm.base()};
}

std::vector<Reconciliation> table_explanations(const Arm& a, const Arm& b, double tolerance) {
  std::vector<Reconciliation> found;
  for (const DhConvention convention : {DhConvention::standard, DhConvention::modified}) {
    if (auto explanation = table_explanation(a, b, convention, tolerance)) {
      found.push_back(std::move(*explanation));
    }
  }
  return found;
}

}  // namespace beeline::internal
