#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <beeline/doctor/internal/explanations.h>
#include <beeline/doctor/internal/link_table.h>
#include <beeline/kinematics/forward.h>
#include <beeline/pose/so3.h>

namespace beeline::internal {
namespace {

using Signs = std::vector<int>;

bool differ(double a, double b, double tolerance) { return std::abs(a - b) > tolerance; }
bool angles_differ(double a, double b, double tolerance) {
  return std::abs(wrap_angle(a - b)) > tolerance;
}

/// Two tables side by side. The signs of B's axes are chosen already.
struct TablePair {
  const LinkTable &a, &b;
  double tolerance;

  bool link_differs(std::size_t i) const {
    const LinkTable::Row &left = a.rows[i], &right = b.rows[i];
    return angles_differ(left.alpha, right.alpha, tolerance) ||
           angles_differ(left.beta, right.beta, tolerance) || differ(left.a, right.a, tolerance);
  }
  /// Returns the difference of the constant parameter, which the joint's coordinate is not added
  /// to.
  double fixed_difference(std::size_t i) const {
    const LinkTable::Row &left = a.rows[i], &right = b.rows[i];
    if (left.kind == JointKind::prismatic) return wrap_angle(right.theta - left.theta);
    return right.d - left.d + left.pitch * offset(i);
  }
  /// Returns the offset that is added to the coordinate of A.
  double offset(std::size_t i) const {
    const LinkTable::Row &left = a.rows[i], &right = b.rows[i];
    return left.kind == JointKind::prismatic ? left.d - right.d
                                             : wrap_angle(left.theta - right.theta);
  }
  Pose mount() const { return b.base * a.base.inverse(Eigen::Isometry); }
  Pose tcp() const { return a.tool.inverse(Eigen::Isometry) * b.tool; }

  /// A weighted number of differences, without the signs.
  double count() const {
    double sum = 0;
    for (std::size_t i = 0; i < a.rows.size(); ++i) {
      if (link_differs(i)) sum += 10;
      if (std::abs(fixed_difference(i)) > tolerance) sum += 10;
      if (std::abs(offset(i)) > tolerance) sum += 1;
    }
    if (!same_pose(mount(), Pose::Identity(), tolerance)) sum += 1;
    if (!same_pose(tcp(), Pose::Identity(), tolerance)) sum += 1;
    return sum;
  }
};

std::vector<JointLine> directed(std::vector<JointLine> lines, const Signs& signs) {
  for (std::size_t i = 0; i < lines.size(); ++i) lines[i].direction *= signs[i];
  return lines;
}

Signs signs_of(std::size_t number, std::size_t joints) {
  Signs signs(joints);
  for (std::size_t i = 0; i < joints; ++i) signs[i] = (number >> i & 1) != 0 ? -1 : 1;
  return signs;
}

/// Returns the signs with the fewest differences. For up to ten joints all combinations are tried;
/// for more joints one sign after another is changed while that helps.
Signs best_signs(const LinkTable& a, const std::vector<JointLine>& lines, const Pose& tool,
                 double tolerance) {
  const std::size_t n = lines.size();
  const auto count = [&](const Signs& signs) {
    const LinkTable b = link_table(directed(lines, signs), tool);
    const auto flips = std::count(signs.begin(), signs.end(), -1);
    return TablePair{a, b, tolerance}.count() + static_cast<double>(flips);
  };
  Signs best(n, 1);
  double least = count(best);
  const auto consider = [&](const Signs& signs) {
    const double found = count(signs);
    if (!(found < least - 1e-9)) return false;
    least = found;
    best = signs;
    return true;
  };
  constexpr std::size_t all = 10;
  if (n <= all) {
    for (std::size_t number = 1; number < std::size_t{1} << n; ++number) {
      consider(signs_of(number, n));
    }
    return best;
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < n; ++i) {
      Signs signs = best;
      signs[i] = -signs[i];
      changed = consider(signs) || changed;
    }
  }
  return best;
}

std::optional<double> motion_along(const JointLine& line, const Pose& pose, double tolerance) {
  return motion_of(line.kind == JointKind::prismatic
                       ? translation_screw(line.direction)
                       : rotation_screw(line.direction, line.point, line.pitch),
                   pose, tolerance);
}

/// Adds the differences of the links, and replaces their numbers by B's.
void add_link_differences(const TablePair& pair, LinkTable& table, Reconciliation& explanation) {
  const double tolerance = pair.tolerance;
  std::vector<ModelDifference>& found = explanation.differences;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    LinkTable::Row& row = table.rows[i];
    const LinkTable::Row& other = pair.b.rows[i];
    const bool slides = row.kind == JointKind::prismatic;
    const std::string next = " to the axis of joint " + std::to_string(i + 2) + ":";
    if (std::abs(pair.fixed_difference(i)) > tolerance) {
      found.push_back(
          slides ? parameter_difference(DifferenceKind::angle, i, "theta", row.theta, other.theta)
                 : parameter_difference(DifferenceKind::length, i, "d", row.d, other.d,
                                        ", along its axis:"));
      (slides ? row.theta : row.d) = slides ? other.theta : row.d + pair.fixed_difference(i);
    }
    if (angles_differ(row.alpha, other.alpha, tolerance) ||
        angles_differ(row.beta, other.beta, tolerance)) {
      const bool alpha = angles_differ(row.alpha, other.alpha, tolerance);
      found.push_back(parameter_difference(
          DifferenceKind::angle, i, alpha ? "angle alpha" : "angle beta",
          alpha ? row.alpha : row.beta, alpha ? other.alpha : other.beta, next));
    }
    if (differ(row.a, other.a, tolerance)) {
      found.push_back(
          parameter_difference(DifferenceKind::length, i, "distance a", row.a, other.a, next));
    }
    if (pair.link_differs(i)) {
      row.a = other.a;
      row.alpha = other.alpha;
      row.beta = other.beta;
    }
  }
}

/// Adds mount, tool, offsets and signs as differences.
void add_frame_differences(const Arm& a, double tolerance, Reconciliation& explanation) {
  std::vector<ModelDifference>& found = explanation.differences;
  if (!same_pose(explanation.mount, Pose::Identity(), tolerance)) {
    found.push_back(mount_difference(explanation.mount));
  }
  for (std::size_t i = 0; i < a.joints().size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    if (explanation.gain[k] < 0) found.push_back(sign_difference(i));
    if (std::abs(explanation.offset[k]) > tolerance) {
      found.push_back(offset_difference(a, i, explanation.offset[k]));
    }
  }
  if (!same_pose(explanation.tcp, Pose::Identity(), tolerance)) {
    found.push_back(tool_difference(explanation.tcp));
  }
}

}  // namespace

std::vector<Reconciliation> screw_explanations(const Arm& a, const Arm& b, double tolerance) {
  const std::vector<JointLine> lines_a = joint_lines(a), lines_b = joint_lines(b);
  const auto same_kind = [](const JointLine& x, const JointLine& y) { return x.kind == y.kind; };
  if (!std::equal(lines_a.begin(), lines_a.end(), lines_b.begin(), lines_b.end(), same_kind)) {
    return {};
  }
  const std::size_t n = lines_a.size();
  const Pose tool_b = forward_kinematics(b, Configuration::Zero(b.dof()));
  const LinkTable table_a =
      link_table(lines_a, forward_kinematics(a, Configuration::Zero(a.dof())));
  const Signs signs = best_signs(table_a, lines_b, tool_b, tolerance);
  const LinkTable table_b = link_table(directed(lines_b, signs), tool_b);
  const TablePair pair{table_a, table_b, tolerance};

  Reconciliation explanation(a);
  LinkTable table = table_a;
  add_link_differences(pair, table, explanation);
  if (!explanation.differences.empty()) explanation.arm = arm_of(table, a);
  for (std::size_t i = 0; i < n; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const double offset = pair.offset(i);
    explanation.gain[k] = signs[i];
    explanation.offset[k] = std::abs(offset) > tolerance ? signs[i] * offset : 0;
  }
  explanation.mount = without_rounding(pair.mount(), tolerance);
  explanation.tcp = without_rounding(pair.tcp(), tolerance);

  std::vector<Reconciliation> explanations{explanation};
  const std::optional<double> first = motion_along(lines_a.front(), explanation.mount, tolerance);
  if (first && std::abs(*first) > tolerance) {
    Reconciliation& other = explanations.emplace_back(explanation);
    other.mount = Pose::Identity();
    other.offset[0] -= signs.front() * *first;
  }
  const JointLine last{.kind = lines_a.back().kind, .pitch = lines_a.back().pitch};
  const Pose moved = table_b.tool * table_a.tool.inverse(Eigen::Isometry);
  const std::optional<double> value = motion_along(last, moved, tolerance);
  if (value && std::abs(*value) > tolerance) {
    const std::size_t count = explanations.size();
    for (std::size_t i = 0; i < count; ++i) {
      Reconciliation& other = explanations.emplace_back(explanations[i]);
      other.tcp = Pose::Identity();
      other.offset[static_cast<Eigen::Index>(n) - 1] -= signs.back() * *value;
    }
  }
  for (Reconciliation& each : explanations) add_frame_differences(a, tolerance, each);
  return explanations;
}

}  // namespace beeline::internal
