#include <algorithm>

#include <beeline/doctor/internal/reconciliation.h>
#include <beeline/doctor/internal/verdict.h>
#include <beeline/internal/enum_names.h>

namespace beeline::internal {
namespace {

/// Whether the difference concerns only the description: the arm may be the same machine.
bool of_description(const ModelDifference& difference) {
  switch (difference.kind) {
    case DifferenceKind::length:
    case DifferenceKind::axis:
    case DifferenceKind::joint_kind:
    case DifferenceKind::joint_count:
      return false;
    case DifferenceKind::angle:
    case DifferenceKind::orientation:
      return difference.joint < 0;
    case DifferenceKind::unit:
      return difference.known_unit;
    default:
      return true;
  }
}

/// A phrase that names the difference: `d of joint 1`, `the mount`.
std::string subject(const Arm& a, const ModelDifference& difference) {
  const std::string joint =
      difference.joint < 0 ? "" : joint_text(a, static_cast<std::size_t>(difference.joint));
  switch (difference.kind) {
    case DifferenceKind::mount:
      return "the mount";
    case DifferenceKind::tool:
      return "the tool";
    case DifferenceKind::joint_offset:
      return "the zero of " + joint;
    case DifferenceKind::joint_sign:
      return "the sign of " + joint;
    case DifferenceKind::limit:
      return "the " + difference.parameter + (joint.empty() ? "" : " of " + joint);
    case DifferenceKind::convention:
      return "the DH convention";
    case DifferenceKind::unit:
      return "the unit";
    case DifferenceKind::columns:
      return "the order of columns";
    case DifferenceKind::joint_order:
      return "the order of joints";
    case DifferenceKind::joint_kind:
      return "the type of " + joint;
    case DifferenceKind::joint_count:
      return "the number of joints";
    case DifferenceKind::orientation:
      return joint.empty() ? "the reading of orientations" : "the frame of " + joint;
    case DifferenceKind::angle:
      if (joint.empty()) return "the sign of alpha";
      break;
    case DifferenceKind::name:
      return "the order of names";
    default:
      break;
  }
  const std::string& what =
      difference.dimension.empty() ? difference.parameter : difference.dimension;
  return (what.empty() ? name(difference.kind) : what) + (joint.empty() ? "" : " of " + joint);
}

std::string subjects(const Arm& a, const std::vector<ModelDifference>& differences) {
  constexpr std::size_t most = 4;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, differences.size()); ++i) {
    const bool last = i + 1 == differences.size();
    text += (i == 0 ? "" : last ? " and " : ", ") + subject(a, differences[i]);
  }
  const std::size_t rest = differences.size() - std::min(most, differences.size());
  return rest == 0 ? text : text + " and " + std::to_string(rest) + " more";
}

/// Returns `; 12 limits differ`; one or two limits are named.
std::string others_text(const Arm& a, const std::vector<ModelDifference>& others) {
  const bool limits = std::all_of(others.begin(), others.end(), [](const ModelDifference& each) {
    return each.kind == DifferenceKind::limit;
  });
  if (limits && others.size() > 2) return std::to_string(others.size()) + " limits differ";
  return subjects(a, others) +
         (others.size() == 1 && others[0].joint >= 0 ? " differs" : " differ");
}

std::string differ(const std::vector<ModelDifference>& differences) {
  return differences.size() == 1 ? " differs" : " differ";
}

}  // namespace

void judge(const Arm& a, const Arm& b, ArmComparison& comparison) {
  const std::vector<ModelDifference>& found = comparison.differences;
  const auto dimensions = std::count_if(
      found.begin(), found.end(), [](const ModelDifference& d) { return !of_description(d); });
  const auto joints = static_cast<std::ptrdiff_t>(std::max(a.joints().size(), b.joints().size()));
  if (!comparison.explained) {
    comparison.status = ModelComparison::different;
    comparison.verdict = "two different arms: no explanation was found";
  } else if (found.empty()) {
    comparison.status = ModelComparison::same;
    comparison.verdict = "the same arm: equal poses of the tool at every configuration";
  } else if (dimensions == 0) {
    comparison.status = ModelComparison::reconciled;
    comparison.verdict =
        "the same arm, described differently: " + subjects(a, found) + differ(found);
  } else if (2 * dimensions <= joints) {
    comparison.status = ModelComparison::different;
    comparison.verdict = "not the same: " + subjects(a, found) + differ(found);
  } else {
    comparison.status = ModelComparison::different;
    const auto first = std::find_if(found.begin(), found.end(), [](const ModelDifference& d) {
      return !of_description(d) && d.joint >= 0;
    });
    comparison.verdict = "two different arms: " + std::to_string(dimensions) +
                         " dimensions differ" +
                         (first == found.end() ? "" : ", the first is " + subject(a, *first));
  }
  if (comparison.others.empty()) return;
  comparison.verdict += "; " + others_text(a, comparison.others);
}

}  // namespace beeline::internal

namespace beeline {

std::string name(DifferenceKind kind) {
  constexpr internal::EnumNames<DifferenceKind> names("difference");
  return names.of(kind);
}

std::string name(ModelComparison status) {
  constexpr internal::EnumNames<ModelComparison> names("status");
  return names.of(status);
}

}  // namespace beeline
