#include <algorithm>
#include <cmath>
#include <numbers>

#include <beeline/formula/formula.h>
#include <beeline/formula/internal/arm_namer.h>
#include <beeline/formula/internal/dimensions.h>
#include <beeline/formula/internal/numeric_twists.h>
#include <beeline/formula/internal/symbolic_chain.h>
#include <beeline/kinematics/forward.h>

namespace beeline {
namespace {

using internal::ArmNamer;
using internal::dh_row;
using internal::planar_row;

using Rows = std::vector<DhRow>;

/// Returns the rows of all joints, or none if a joint does not fit.
template <class RowOf>
Rows rows_of(const Arm& arm, RowOf row_of) {
  Rows rows;
  for (const Joint& joint : arm.joints()) {
    const std::optional<DhRow> row = row_of(joint);
    if (!row) return {};
    rows.push_back(*row);
  }
  return rows;
}

/// Adds the motion of joint i about or along z, with its offset.
void add_joint(ArmNamer& namer, const DhRow& row, std::size_t i) {
  const std::string index = std::to_string(i + 1);
  if (row.kind == JointKind::revolute) namer.move(i, 2);
  namer.rotate(2, row.theta, "theta", index, "joint offset");
  namer.translate(2, row.d, "d", index, "link offset");
  if (row.kind == JointKind::prismatic) namer.move(i, 2);
}

void add_standard(ArmNamer& namer, const Rows& rows) {
  namer.arm().convention = NamingConvention::standard;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string index = std::to_string(i + 1);
    namer.begin_transform();
    add_joint(namer, rows[i], i);
    namer.translate(0, rows[i].a, "a", index, "link length");
    namer.rotate(0, rows[i].alpha, "alpha", index, "link twist");
  }
}

/// In Craig's notation row i has a and alpha of link i-1.
void add_modified(ArmNamer& namer, const Rows& rows) {
  namer.arm().convention = NamingConvention::modified;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string before = std::to_string(i);
    namer.begin_transform();
    namer.translate(0, rows[i].a, "a", before, "link length");
    namer.rotate(0, rows[i].alpha, "alpha", before, "link twist");
    add_joint(namer, rows[i], i);
  }
}

void add_planar(ArmNamer& namer, const Rows& rows) {
  namer.arm().convention = NamingConvention::planar;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string index = std::to_string(i + 1);
    namer.begin_transform();
    if (rows[i].kind == JointKind::revolute) namer.move(i, 2);
    namer.rotate(2, rows[i].theta, "theta", index, "fixed rotation");
    namer.translate(0, rows[i].a, "a", index, "link length");
    if (rows[i].kind == JointKind::prismatic) namer.move(i, 0);
  }
}

void add_general(ArmNamer& namer, const Arm& arm) {
  namer.share_lengths();
  for (std::size_t i = 0; i < arm.joints().size(); ++i) {
    const std::string index = std::to_string(i + 1);
    namer.begin_transform();
    namer.place(arm.joints()[i].offset, index, namer.axis_of(i), namer.axis_of(i + 1));
    namer.move_about_screw(i);
  }
}

/// Tries the conventions of textbooks in order.
void add_joints(ArmNamer& namer, const Arm& arm, double tolerance) {
  const double unit = internal::length_unit(arm);
  const auto standard = [&](const Joint& joint) {
    return dh_row(joint, DhConvention::standard, tolerance, unit);
  };
  const auto modified = [&](const Joint& joint) {
    return dh_row(joint, DhConvention::modified, tolerance, unit);
  };
  const auto planar = [&](const Joint& joint) { return planar_row(joint, tolerance, unit); };
  if (Rows rows = arm.planar() ? rows_of(arm, planar) : Rows{}; !rows.empty()) {
    add_planar(namer, rows);
  } else if (rows = rows_of(arm, standard); !rows.empty()) {
    add_standard(namer, rows);
  } else if (rows = rows_of(arm, modified); !rows.empty()) {
    add_modified(namer, rows);
  } else {
    add_general(namer, arm);
  }
}

/// Compares the transforms with the arm at a configuration and sets SymbolicArm::deviation. Throws
/// Error if they differ by more than the rounding of angles explains.
void check_transforms(SymbolicArm& named, const Arm& arm, const Configuration& q) {
  const internal::TransformList list = internal::transform_list(named);
  const std::vector<Pose> places = internal::place_poses(list, symbol_values(named, q));
  std::vector<Pose> expected = link_poses(arm, q);
  expected.push_back(forward_kinematics(arm, q));
  double positions = 0, rotations = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const Eigen::Matrix4d difference = places[list.frames[i + 1]].matrix() - expected[i].matrix();
    rotations = std::max(rotations, difference.leftCols<3>().cwiseAbs().maxCoeff());
    positions = std::max(positions, difference.col(3).cwiseAbs().maxCoeff());
  }
  named.deviation = std::max({named.deviation, positions, rotations});
  const double allowed = 1e-9 + 4 * named.rounding * static_cast<double>(expected.size());
  if (rotations <= allowed && positions <= allowed * internal::length_scale(named)) return;
  throw Error("the formulas of arm " + arm.name() + " deviate by " + number(named.deviation) +
              " from its kinematics; please report this");
}

}  // namespace

SymbolicArm symbolic_arm(const Arm& arm, const SymbolicOptions& options) {
  if (!(options.angle_tolerance >= 0 && options.angle_tolerance <= 0.01)) {
    throw Error("the angle tolerance must be from 0 to 0.01 rad, not " +
                number(options.angle_tolerance));
  }
  ArmNamer namer(arm, options);
  namer.begin_transform();
  namer.place(arm.base(), "0", 2, 2);
  add_joints(namer, arm, options.angle_tolerance);
  namer.begin_transform();
  namer.place(arm.tool(), "t", namer.axis_of(arm.joints().size()), 2);
  SymbolicArm named = namer.finish();
  internal::assign_groups(named);
  for (const Configuration& q : internal::check_configurations(named, 3)) {
    check_transforms(named, arm, q);
  }
  return named;
}

std::vector<double> symbol_values(const SymbolicArm& arm, const ConfigurationRef& q,
                                  const ConfigurationRef& rates) {
  const auto check_size = [&arm](const char* what, Eigen::Index size) {
    if (size == arm.dof) return;
    throw Error("arm " + arm.name + " takes " + std::to_string(arm.dof) + ' ' + what + ", not " +
                std::to_string(size));
  };
  check_size("joint values", q.size());
  if (rates.size() != 0) check_size("joint velocities", rates.size());
  std::vector<double> values;
  for (const Symbol& symbol : arm.symbols) {
    if (symbol.coordinate < 0) {
      values.push_back(symbol.value);
    } else if (symbol.kind == SymbolKind::rate) {
      values.push_back(rates.size() == 0 ? 0 : rates[symbol.coordinate]);
    } else {
      values.push_back(symbol.ratio * q[symbol.coordinate] + symbol.value);
    }
  }
  return values;
}

}  // namespace beeline
