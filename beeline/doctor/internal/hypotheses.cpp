#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <beeline/doctor/internal/explanations.h>
#include <beeline/doctor/internal/hypotheses.h>
#include <beeline/doctor/internal/link_table.h>
#include <beeline/doctor/internal/number_relation.h>
#include <beeline/kinematics/forward.h>

namespace beeline::internal {
namespace {

using std::numbers::pi;

/// A change of an arm; it returns nothing if it does not apply.
using Change = std::function<std::optional<Arm>(const Arm&)>;

/// Applies a change to each of the arms in turn. If `made`, the change makes the mistake `what`, so
/// the other arm has it; otherwise the change undoes it.
void consider(std::vector<Hypothesis>& found, const Arm& a, const Arm& b, DifferenceKind kind,
              const std::string& what, bool made, const Change& change) {
  for (const bool to_a : {true, false}) {
    const std::optional<Arm> changed = change(to_a ? a : b);
    if (!changed) continue;
    const std::string arm = to_a == made ? "B" : "A";
    const ModelDifference difference{.kind = kind, .what = arm + ": " + what};
    found.push_back({to_a ? *changed : a, to_a ? b : *changed, difference});
  }
}

/// Changes the rows of an arm whose frames follow the convention.
Change of_rows(DhConvention convention, DhConvention read_as,
               const std::function<void(DhRows&)>& change) {
  return [=](const Arm& arm) -> std::optional<Arm> {
    std::optional<DhRows> rows = own_dh_rows(arm, convention);
    if (!rows) return std::nullopt;
    change(*rows);
    return with_rows(arm, *rows, read_as);
  };
}

const char* spelled(DhConvention convention) {
  return convention == DhConvention::standard ? "standard" : "modified";
}

DhConvention other(DhConvention convention) {
  return convention == DhConvention::standard ? DhConvention::modified : DhConvention::standard;
}

/// A change of the rows of a table.
struct RowChange {
  std::string what;
  DifferenceKind kind;
  std::function<void(DhRows&)> apply;
};

/// Multiplies the angles of all rows.
void scale_angles(DhRows& rows, double factor) {
  for (DhRow& row : rows) {
    row.alpha *= factor;
    row.theta *= factor;
  }
}

/// Moves numbers of each row to the next row, or to the one before.
void shift(DhRows& rows, const std::vector<double DhRow::*>& columns, bool down) {
  const DhRows before = rows;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool inside = down ? i > 0 : i + 1 < rows.size();
    for (const auto column : columns) {
      rows[i].*column = inside ? before[down ? i - 1 : i + 1].*column : 0;
    }
  }
}

std::vector<RowChange> row_changes() {
  std::vector<RowChange> changes{
      {"alpha has the other sign in all rows", DifferenceKind::angle,
       [](DhRows& rows) {
         for (DhRow& row : rows) row.alpha = -row.alpha;
       }},
      {"columns a and d are exchanged", DifferenceKind::columns,
       [](DhRows& rows) {
         for (DhRow& row : rows) std::swap(row.a, row.d);
       }},
      {"columns alpha and theta are exchanged", DifferenceKind::columns, [](DhRows& rows) {
         for (DhRow& row : rows) std::swap(row.alpha, row.theta);
       }}};
  const std::vector<std::pair<std::string, std::vector<double DhRow::*>>> columns{
      {"columns a and alpha are", {&DhRow::a, &DhRow::alpha}},
      {"column a is", {&DhRow::a}},
      {"column alpha is", {&DhRow::alpha}},
      {"column d is", {&DhRow::d}},
      {"column theta is", {&DhRow::theta}}};
  for (const auto& [name, members] : columns) {
    for (const bool down : {true, false}) {
      changes.push_back({name + " one row too " + (down ? "high" : "low"), DifferenceKind::columns,
                         [members = members, down](DhRows& rows) { shift(rows, members, down); }});
    }
  }
  return changes;
}

/// The arm with all lengths multiplied.
Arm scaled_arm(const Arm& arm, double scale) {
  std::vector<Joint> joints = arm.joints();
  const auto larger = [scale](Pose pose) {
    pose.translation() *= scale;
    return pose;
  };
  for (Joint& joint : joints) {
    joint.offset = larger(joint.offset);
    if (kind(joint) != JointKind::prismatic) joint.screw.head<3>() *= scale;
  }
  return {arm.name(), joints, larger(arm.tool()), larger(arm.base())};
}

/// The sum of the dimensions between the joint axes, metres.
double size_of_links(const Arm& arm) {
  const LinkTable table =
      link_table(joint_lines(arm), forward_kinematics(arm, Configuration::Zero(arm.dof())));
  double sum = 0;
  for (const LinkTable::Row& row : table.rows) sum += std::abs(row.a) + std::abs(row.d);
  return sum;
}

/// The arm with all orientations of its frames replaced.
Arm with_orientations(const Arm& arm, const std::function<Rotation(const Rotation&)>& change) {
  std::vector<Joint> joints = arm.joints();
  for (Joint& joint : joints) joint.offset.linear() = change(joint.offset.linear());
  Pose tool = arm.tool();
  tool.linear() = change(tool.linear());
  return {arm.name(), joints, tool, arm.base()};
}

/// The arm from the tool to the base.
Arm reversed(const Arm& arm) {
  std::vector<JointLine> lines = joint_lines(arm);
  const Pose tool = forward_kinematics(arm, Configuration::Zero(arm.dof()));
  const Pose back = tool.inverse(Eigen::Isometry);
  for (JointLine& line : lines) {
    line.direction = -(back.linear() * line.direction);
    line.point = back * line.point;
  }
  std::reverse(lines.begin(), lines.end());
  std::vector<Joint> joints = arm_along(lines, back, arm).joints();
  for (std::size_t i = 0; i < joints.size(); ++i) joints[i].name = arm.joints()[i].name;
  return {arm.name(), joints, back};
}

/// The arm without some joints, which are fixed at `value` or left out with their frames.
Arm without(const Arm& arm, const std::vector<std::size_t>& kept, std::optional<double> value) {
  std::vector<Joint> joints;
  Pose fixed = Pose::Identity();
  std::size_t next = 0;
  for (std::size_t i = 0; i < arm.joints().size(); ++i) {
    Joint joint = arm.joints()[i];
    if (next < kept.size() && kept[next] == i) {
      joint.offset = fixed * joint.offset;
      fixed = Pose::Identity();
      joints.push_back(joint);
      ++next;
    } else if (value) {
      const double slides = kind(joint) == JointKind::prismatic ? 0 : *value;
      fixed = fixed * joint_transform(joint, slides);
    }
  }
  return {arm.name(), joints, fixed * arm.tool(), arm.base()};
}

/// All choices of `count` of n joints, ascending; at most `most`, the rest is not tried.
std::vector<std::vector<std::size_t>> choices(std::size_t n, std::size_t count, std::size_t most) {
  std::vector<std::vector<std::size_t>> found;
  std::vector<bool> chosen(n, false);
  std::fill(chosen.begin(), chosen.begin() + static_cast<std::ptrdiff_t>(count), true);
  do {
    std::vector<std::size_t> joints;
    for (std::size_t i = 0; i < n; ++i) {
      if (chosen[i]) joints.push_back(i);
    }
    found.push_back(joints);
  } while (found.size() < most && std::prev_permutation(chosen.begin(), chosen.end()));
  return found;
}

}  // namespace

std::vector<Hypothesis> table_hypotheses(const Arm& a, const Arm& b) {
  std::vector<Hypothesis> found;
  for (const DhConvention convention : {DhConvention::standard, DhConvention::modified}) {
    const std::string read = std::string("the table is ") + spelled(other(convention)) +
                             " DH, not " + spelled(convention);
    consider(found, a, b, DifferenceKind::convention, read, false,
             of_rows(convention, other(convention), [](DhRows&) {}));
    for (const RowChange& change : row_changes()) {
      consider(found, a, b, change.kind, change.what, false,
               of_rows(convention, convention, change.apply));
    }
    consider(found, a, b, DifferenceKind::unit, "alpha and theta are degrees, read as radians",
             true,
             of_rows(convention, convention, [](DhRows& rows) { scale_angles(rows, 180 / pi); }));
    consider(found, a, b, DifferenceKind::unit, "alpha and theta are radians, read as degrees",
             true,
             of_rows(convention, convention, [](DhRows& rows) { scale_angles(rows, pi / 180); }));
  }
  return found;
}

std::vector<Hypothesis> scale_hypotheses(const Arm& a, const Arm& b) {
  const double in_a = size_of_links(a), in_b = size_of_links(b);
  if (!(in_a > 1e-9) || !(in_b > 1e-9)) return {};
  double scale = in_b / in_a;
  if (std::abs(scale - 1) < 1e-4) return {};
  bool known_unit = false;
  std::string unit = "all lengths are " + number(scale) + " times the lengths of A";
  for (const auto& [factor, name] :
       {std::pair{1000.0, "millimetres"}, std::pair{100.0, "centimetres"},
        std::pair{1 / 0.0254, "inches"}}) {
    for (const bool larger : {true, false}) {
      const double exact = larger ? factor : 1 / factor;
      if (std::abs(scale / exact - 1) > 1e-3) continue;
      scale = exact;
      known_unit = true;
      unit = std::string(larger ? "B" : "A") + ": lengths are " + name + ", not metres";
    }
  }
  return {{scaled_arm(a, scale),
           b,
           {.kind = DifferenceKind::unit,
            .parameter = "length",
            .known_unit = known_unit,
            .a = 1,
            .b = scale,
            .what = unit},
           scale}};
}

std::vector<Hypothesis> rotation_hypotheses(const Arm& a, const Arm& b) {
  std::vector<Hypothesis> found;
  for (int k = 0; k < mistaken_rotations; ++k) {
    for (const bool second : {false, true}) {
      const std::string what =
          "orientations: " + mistaken_rotation(Rotation::Identity(), k, second).mistake;
      consider(found, a, b, DifferenceKind::orientation, what, true, [&](const Arm& arm) {
        return with_orientations(
            arm, [&](const Rotation& r) { return mistaken_rotation(r, k, second).rotation; });
      });
    }
  }
  return found;
}

std::vector<Hypothesis> order_hypotheses(const Arm& a, const Arm& b) {
  std::vector<Hypothesis> found;
  constexpr std::size_t most = 12;  // joints
  const std::size_t n = a.joints().size();
  if (n != b.joints().size() || n > most) return found;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      std::vector<Joint> joints = a.joints();
      std::swap(joints[i].offset, joints[j].offset);
      std::swap(joints[i].screw, joints[j].screw);
      const std::string what = "joints " + std::to_string(i + 1) + " and " + std::to_string(j + 1) +
                               " are exchanged in A or B";
      found.push_back(
          {{a.name(), joints, a.tool(), a.base()},
           b,
           {.kind = DifferenceKind::joint_order, .joint = static_cast<int>(i), .what = what}});
    }
  }
  found.push_back({reversed(a),
                   b,
                   {.kind = DifferenceKind::joint_order,
                    .what = "A: the joints are in reverse order, from the tool to the base"}});
  return found;
}

std::vector<MissingJoints> missing_joint_hypotheses(const Arm& a, const Arm& b) {
  std::vector<MissingJoints> found;
  const bool from_a = a.joints().size() > b.joints().size();
  const Arm &longer = from_a ? a : b, &shorter = from_a ? b : a;
  const std::size_t n = longer.joints().size(), count = shorter.joints().size();
  constexpr std::size_t most = 60;  // choices
  for (const std::vector<std::size_t>& kept : choices(n, count, most)) {
    std::string names;
    int first = -1;
    for (std::size_t i = 0; i < n; ++i) {
      if (std::find(kept.begin(), kept.end(), i) != kept.end()) continue;
      if (first < 0) first = static_cast<int>(i);
      names += (names.empty() ? "" : ", ") + joint_text(longer, i);
    }
    const std::string missing =
        names + (n - count > 1 ? " are" : " is") + " missing in " + (from_a ? "B" : "A");
    const auto add = [&](std::optional<double> value, const std::string& how) {
      const Arm reduced = without(longer, kept, value);
      found.push_back({{from_a ? reduced : a,
                        from_a ? b : reduced,
                        {.kind = DifferenceKind::joint_count,
                         .joint = from_a ? first : -1,
                         .what = missing + how}},
                       kept});
    };
    add(0.0, ", fixed at 0");
    add(std::nullopt, ", with its frame");
    if (n - count > 1) continue;
    for (const double value : {pi / 2, -pi / 2, pi}) {
      add(value, ", fixed at " + beeline::angle(value));
    }
  }
  return found;
}

}  // namespace beeline::internal
