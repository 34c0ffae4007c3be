#include <gtest/gtest.h>
#include <numbers>

#include <beeline/formula/formula.h>
#include <beeline/model/catalog.h>
#include <beeline/model/joint.h>

#include <tests/random.h>

namespace beeline {
namespace {

std::vector<std::string> constants(const SymbolicArm& arm) {
  std::vector<std::string> names;
  for (const Symbol& symbol : arm.symbols) {
    if (symbol.coordinate < 0) names.push_back(symbol.name());
  }
  return names;
}

TEST(SymbolicArm, HasTheNamesOfItsTable) {
  using Names = std::vector<std::string>;
  const SymbolicArm puma = symbolic_arm(built_in("puma560"));
  EXPECT_EQ(puma.convention, NamingConvention::standard);
  EXPECT_EQ(constants(puma), (Names{"a2", "d3", "a3", "d4"}));
  const SymbolicArm panda = symbolic_arm(built_in("panda"));
  EXPECT_EQ(panda.convention, NamingConvention::modified);
  EXPECT_EQ(constants(panda), (Names{"d1", "d3", "a3", "a4", "d5", "a6", "zt"}));
  const SymbolicArm rrr = symbolic_arm(built_in("rrr"));
  EXPECT_EQ(rrr.convention, NamingConvention::planar);
  EXPECT_EQ(constants(rrr), (Names{"a1", "a2", "a3"}));
}

DhRow random_row(testing::Random& random) {
  const auto angle = [&random] {
    return random.integer(0, 2) == 0 ? random.uniform(-3, 3)
                                     : random.integer(-11, 12) * std::numbers::pi / 12;
  };
  DhRow row{random.uniform(-1, 1), angle(), random.uniform(-1, 1), angle()};
  if (random.integer(0, 3) == 0) row.kind = JointKind::prismatic;
  return row;
}

/// The value of a symbol of the name; 0 where it was left out.
double value_of(const SymbolicArm& arm, const std::string& name) {
  for (const Symbol& symbol : arm.symbols) {
    if (symbol.name() == name) return symbol.value;
  }
  return 0;
}

TEST(SymbolicArm, RecoversDhRows) {
  testing::Random random;
  for (int k = 0; k < testing::cases(300); ++k) {
    const bool standard = random.integer(0, 1) == 0;
    const DhConvention convention = standard ? DhConvention::standard : DhConvention::modified;
    std::vector<Joint> joints;
    std::vector<DhRow> rows;
    for (int i = 0; i < 3; ++i) {
      rows.push_back(random_row(random));
      joints.push_back(dh_joint(rows.back(), convention));
      joints.back().name = "j" + std::to_string(i);
    }
    const SymbolicArm arm = symbolic_arm({"arm", joints});
    if (arm.convention == NamingConvention::planar) continue;
    ASSERT_EQ(arm.convention, standard ? NamingConvention::standard : NamingConvention::modified);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const std::string index = std::to_string(i + 1), of_a = std::to_string(standard ? i + 1 : i);
      EXPECT_NEAR(value_of(arm, "a" + of_a), rows[i].a, 1e-12);
      EXPECT_NEAR(value_of(arm, "d" + index), rows[i].d, 1e-12);
    }
  }
}

/// A pitch, in metres per radian, is never the symbol of an equal length.
TEST(SymbolicArm, NamesThePitchOfAHelicalJoint) {
  testing::Random random;
  for (int k = 0; k < testing::cases(30); ++k) {
    Joint joint;
    joint.name = "screw";
    const double pitch = random.uniform(0.01, 0.5);
    joint.screw = rotation_screw(Vector3::UnitZ(), {pitch, 0.1, 0}, pitch);
    joint.offset.translation() = Vector3(0, 0, pitch);
    const SymbolicArm arm = symbolic_arm({"arm", {joint}});
    int pitches = 0;
    for (const Symbol& symbol : arm.symbols) {
      if (symbol.kind == SymbolKind::pitch) {
        ++pitches;
        EXPECT_EQ(symbol.name(), "h1");
        EXPECT_NEAR(symbol.value, pitch, 1e-12);
      }
      EXPECT_EQ(symbol.is_coordinate(), symbol.name() == "q1");
    }
    EXPECT_EQ(pitches, 1);
  }
}

/// Angles near a multiple of 15 degrees are exact within the tolerance, and reported.
TEST(SymbolicArm, ReportsWhatItRounds) {
  const double rounded = 1.5708;  // pi/2 + 3.67e-6
  Joint joint = dh_joint({.a = 1, .alpha = rounded}, DhConvention::standard);
  joint.name = "joint";
  const Arm arm{"arm", {joint}};
  const SymbolicArm named = symbolic_arm(arm);
  EXPECT_EQ(constants(named), (std::vector<std::string>{"a1", "alpha1"}));
  EXPECT_LT(named.rounding, 1e-15);
  EXPECT_LT(named.deviation, 1e-15);
  const SymbolicArm exact = symbolic_arm(arm, {.angle_tolerance = 1e-5});
  EXPECT_EQ(constants(exact), (std::vector<std::string>{"a1"}));
  EXPECT_NEAR(exact.rounding, rounded - std::numbers::pi / 2, 1e-15);
  EXPECT_GT(exact.deviation, 1e-6);
  EXPECT_LT(exact.deviation, 4e-6);
}

TEST(SymbolicArm, RefusesBadOptionsAndSizes) {
  const Arm arm = built_in("ur5");
  EXPECT_THROW(symbolic_arm(arm, {.angle_tolerance = -1}), Error);
  EXPECT_THROW(symbolic_arm(arm, {.angle_tolerance = 1}), Error);
  const SymbolicArm named = symbolic_arm(arm);
  EXPECT_THROW(symbol_values(named, {1, 2}), Error);
  EXPECT_THROW(symbol_values(named, {1, 2, 3, 4, 5, 6}, {1, 2}), Error);
  EXPECT_THROW(link_formula(named, 2, 3), Error);
  EXPECT_THROW(link_formula(named, 7, 0), Error);
  const SymbolicArm small = symbolic_arm(arm, {.max_symbols = 20});
  EXPECT_THROW(tool_formula(small), Error);
  EXPECT_THROW(jacobian_formula(small), Error);
}

}  // namespace
}  // namespace beeline
