#include <gtest/gtest.h>
#include <numbers>

#include <beeline/io/trajectory_file.h>
#include <beeline/model/catalog.h>
#include <beeline/model/joint.h>

#include <tests/random.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

const Arm& three_joints() {
  static const Arm arm = built_in("rrr");
  return arm;
}

Recording parsed(const std::string& text, const RecordingOptions& options = {}) {
  return parse_recording(text, "a.csv", three_joints(), options);
}

TEST(RecordingColumns, NamesOfColumnsGiveUnits) {
  testing::Random random;
  const Arm arm("pair",
                {composite_joint('R', "turn").front(), composite_joint('P', "slide").front()});
  struct Unit {
    JointUnit unit;
    double si;
    std::vector<std::string> names;
  };
  const std::vector<Unit> units[] = {
      {{JointUnit::radians, 1, {"rad", "Radians"}},
       {JointUnit::degrees, std::numbers::pi / 180, {"deg", "DEG", "degrees", "\xc2\xb0"}}},
      {{JointUnit::metres, 1, {"m", "meters"}},
       {JointUnit::millimetres, 1e-3, {"mm", "millimetres"}}}};
  const auto column = [&](std::string name, const std::string& unit, const std::string& rate) {
    if (random.integer(0, 1) == 0) return name + "_" + unit + (rate.empty() ? "" : "_" + rate);
    if (!rate.empty()) name += "_" + rate;
    const std::string behind = rate.empty() ? "" : rate == "vel" ? "/s" : "/s^2";
    return name +
           (random.integer(0, 1) == 0 ? " (" + unit + behind + ")" : "[" + unit + behind + "]");
  };
  for (int i = 0; i < testing::cases(300); ++i) {
    std::string header = "t", row = "0";
    double expected[3][2];
    JointUnit said[2] = {};
    const char* const rates[] = {"", "vel", "acc"};
    for (int quantity = 0; quantity < 3; ++quantity) {
      for (int k = 0; k < 2; ++k) {
        const auto& [unit, si, names] = units[k][static_cast<std::size_t>(random.integer(0, 1))];
        const auto last = static_cast<int>(names.size()) - 1;
        const std::string& text = names[static_cast<std::size_t>(random.integer(0, last))];
        const int value = random.integer(-9, 9);
        header += "," + column(arm.joint_of(k).name, text, rates[quantity]);
        row += "," + std::to_string(value);
        expected[quantity][k] = si * value;
        if (quantity == 0) said[k] = unit;
      }
    }
    const Recording read = parse_recording(header + "\n" + row + "\n", "a.csv", arm);
    for (int k = 0; k < 2; ++k) {
      ASSERT_NEAR(read.trajectory.positions[0][k], expected[0][k], 1e-12) << header;
      ASSERT_NEAR(read.trajectory.velocities[0][k], expected[1][k], 1e-12) << header;
      ASSERT_NEAR(read.trajectory.accelerations[0][k], expected[2][k], 1e-12) << header;
      const auto& note = read.notes.at(static_cast<std::size_t>(k));
      ASSERT_EQ(note.kind, RecordingNoteKind::named_unit);
      ASSERT_EQ(note.joint_unit, said[k]) << header;
    }
  }
}

TEST(RecordingColumns, TheUnitOfAJointIsTheMapsThenItsNamesThenTheOthers) {
  const std::string text = "t,A1_deg,A2,A3\n0,90,90,1\n";
  const double degree = std::numbers::pi / 180;
  const auto read = [&](JointMap map, double angle_unit) {
    return parsed(text, {.match = {.joint_map = std::move(map), .angle_unit = angle_unit}})
        .trajectory.positions[0];
  };
  const auto near = [](const Configuration& q, const Vector3& expected) {
    return (q - expected).norm() < 1e-12;
  };
  for (const char* name : {"A1", "A1_deg", "a1_DEG", "a1"}) {
    EXPECT_TRUE(near(read({{name}, {"A2"}, {"A3"}}, 1), {90 * degree, 90, 1})) << name;
    EXPECT_TRUE(near(read({{name}, {"A2"}, {"A3"}}, degree), {90 * degree, 90 * degree, degree}));
    EXPECT_TRUE(near(read({{name, 1, 0, 1}, {"A2"}, {"A3"}}, degree), {90, 90 * degree, degree}));
    EXPECT_TRUE(near(read({{name, -1, 30}, {"A2"}, {"A3"}}, 1), {-60 * degree, 90, 1})) << name;
  }
}

/// The arm with these names of joints.
Arm with_names(const std::vector<std::string>& names) {
  std::vector<Joint> joints = three_joints().joints();
  for (std::size_t i = 0; i < joints.size(); ++i) joints[i].name = names[i];
  return {"renamed", joints};
}

TEST(RecordingColumns, AJointWhoseNameEndsInAUnitIsNotInIt) {
  const Arm arm = with_names({"lift_deg", "b", "c_m"});
  for (const char* front : {"", "left_"}) {
    const std::string f = front;
    const Recording read =
        parse_recording("t," + f + "lift_deg," + f + "b," + f + "c_m\n0,1,2,3\n", "a.csv", arm);
    EXPECT_TRUE(read.notes.empty());
    EXPECT_EQ(read.trajectory.positions[0], Vector3(1, 2, 3));
  }
}

/// A unit of angles counts wherever it is a word of the name.
TEST(RecordingColumns, AUnitMayStandInFrontOfTheJoint) {
  testing::Random random;
  const char* const units[] = {"deg", "DEG", "degrees", "\xc2\xb0", "rad", "Radian"};
  const char* const forms[][2] = {{"@_", ""},
                                  {"@/", ""},
                                  {"position_@_", ""},
                                  {"/states_@/", "/position"},
                                  {"angle (@) of ", ""},
                                  {"@.left_", ".position"}};
  for (int i = 0; i < testing::cases(200); ++i) {
    const int u = random.integer(0, 5);
    const auto& [front, behind] = forms[random.integer(0, 5)];
    std::string prefix = front;
    prefix.replace(prefix.find('@'), 1, units[u]);
    std::string header = "t", row = "0";
    Vector3 expected;
    for (int k = 0; k < 3; ++k) {
      const int value = random.integer(-90, 90);
      header += "," + prefix + "joint" + std::to_string(k + 1) + behind;
      row += "," + std::to_string(value);
      expected[k] = (u < 4 ? std::numbers::pi / 180 : 1) * value;
    }
    const Recording read = parsed(header + "\n" + row + "\n");
    ASSERT_LE((read.trajectory.positions[0] - expected).norm(), 1e-12) << header;
    ASSERT_EQ(read.notes.front().kind, RecordingNoteKind::named_unit) << header;
    ASSERT_EQ(read.notes.front().joint_unit, u < 4 ? JointUnit::degrees : JointUnit::radians);
  }
  // m and mm may abbreviate other words, and these are no words.
  for (const char* other : {"mm_", "m_", "degas_", "radar_", "deg1_"}) {
    const std::string f = other;
    const Recording read = parsed("t," + f + "joint1," + f + "joint2," + f + "joint3\n0,1,2,3\n");
    EXPECT_TRUE(read.notes.empty()) << other;
    EXPECT_EQ(read.trajectory.positions[0], Vector3(1, 2, 3));
  }
}

/// The unit of rates says nothing about positions.
TEST(RecordingColumns, PositionsBesideRatesInAUnitNeedOne) {
  const std::string text =
      "t,joint1,joint2,joint3,joint1_vel (deg/s),joint2_vel (deg/s),joint3_vel (deg/s)\n"
      "0,1,0,0,90,2,3\n";
  EXPECT_REFUSED(parsed(text),
                 "a.csv: column \"joint1\" has no unit, but column \"joint1_vel (deg/s)\" is in "
                 "deg/s; a unit behind its name, as in \"joint1_deg\", or the option angle_unit "
                 "(--angle-unit) gives it");
  const double degree = std::numbers::pi / 180;
  for (const double angle_unit : {1.0, degree}) {
    const Recording read =
        parsed(text, {.match = {.angle_unit = angle_unit}, .angle_unit_is_known = true});
    EXPECT_NEAR(read.trajectory.positions[0][0], angle_unit, 1e-15);
    EXPECT_NEAR(read.trajectory.velocities[0][0], std::numbers::pi / 2, 1e-15);
  }
  EXPECT_REFUSED(parsed("time,position_joint1,position_joint2,position_joint3,velocity_joint1_deg,"
                        "velocity_joint2_deg,velocity_joint3_deg\n0,90,0,0,1,2,3\n"),
                 "column \"position_joint1\" has no unit");
  // Rates in radians per second are in the unit that positions have by default.
  const Recording radians = parsed(
      "t,joint1,joint2,joint3,joint1_vel [rad/s],joint2_vel [rad/s],joint3_vel [rad/s]\n"
      "0,1,2,3,4,5,6\n");
  EXPECT_EQ(radians.trajectory.positions[0], Vector3(1, 2, 3));
  EXPECT_EQ(radians.trajectory.velocities[0], Vector3(4, 5, 6));
  EXPECT_REFUSED(parsed("t,joint1_deg,joint2_deg,joint3_deg,joint1_vel [deg/s^2],joint2_vel,"
                        "joint3_vel\n0,1,2,3,4,5,6\n"),
                 "column \"joint1_vel [deg/s^2]\" is in deg/s^2, but it is a velocity");
}

TEST(RecordingColumns, ColumnsWithoutAUnitBesideOthersAreNoted) {
  const Recording read = parsed("t,joint1_deg,joint2,joint3\n0,90,2,3\n");
  ASSERT_EQ(read.notes.size(), 2u);
  EXPECT_EQ(read.notes[1].kind, RecordingNoteKind::no_unit);
  EXPECT_EQ(read.notes[1].columns, (std::vector<std::string>{"joint2", "joint3"}));
  EXPECT_EQ(read.notes[1].joint_unit, JointUnit::radians);
  EXPECT_EQ(sentence(read.notes[1], OptionStyle::command),
            "a.csv: columns joint2, joint3 are read in rad: their names give no unit, other names "
            "give one; --angle-unit gives it");
  EXPECT_EQ(
      parsed("t,joint1_deg,joint2,joint3\n0,90,2,3\n", {.angle_unit_is_known = true}).notes.size(),
      1u);
}

TEST(RecordingColumns, IncompleteRatesAreNoted) {
  const std::string positions = "t,/a/joint1/position,/a/joint2/position,/a/joint3/position";
  for (const auto& [columns, unread] :
       std::vector<std::pair<std::string, std::vector<std::string>>>{
           {",/a/joint2/velocity", {"/a/joint2/velocity"}},
           {",/a/joint1/velocity,/a/joint3/velocity", {"/a/joint1/velocity", "/a/joint3/velocity"}},
           {",/a/joint1/acceleration,/a/joint2/acceleration,/a/joint3/acceleration",
            {"/a/joint1/acceleration", "/a/joint2/acceleration", "/a/joint3/acceleration"}}}) {
    std::string row = "0,1,2,3";
    for (std::size_t i = 0; i < unread.size(); ++i) row += ",4";
    const Recording read = parsed(positions + columns + "\n" + row + "\n");
    EXPECT_TRUE(read.trajectory.velocities.empty() && read.trajectory.accelerations.empty());
    ASSERT_EQ(read.notes.size(), 1u) << columns;
    EXPECT_EQ(read.notes[0].kind, RecordingNoteKind::unread_rates);
    EXPECT_EQ(read.notes[0].columns, unread);
  }
}

TEST(RecordingColumns, OtherQuantitiesAreNoPositions) {
  testing::Random random;
  const char* const quantities[] = {"velocity", "Vel",    "speed",   "acceleration", "accel",
                                    "ACC",      "effort", "torques", "error",        "temperature"};
  const char* const gaps[] = {"_", "/", ".", " "};
  for (const char* quantity : quantities) {
    const std::string gap = gaps[random.integer(0, 3)];
    for (const std::string& front :
         {quantity + gap, "left_" + (quantity + gap), quantity + gap + "measured" + gap}) {
      const std::string header = "t," + front + "joint1," + front + "joint2," + front + "joint3";
      EXPECT_REFUSED(parsed(header + "\n0,1,2,3\n"), "it lacks joint1, joint2, joint3");
      const Recording mapped = parsed(
          header + "\n0,1,2,3\n",
          {.match = {.joint_map = {{front + "joint1"}, {front + "joint2"}, {front + "joint3"}}}});
      EXPECT_EQ(mapped.trajectory.positions[0], Vector3(1, 2, 3)) << front;
    }
  }
  // Parts of other words, and names that say that they are of positions.
  for (const char* front : {"veloce_", "accurate_", "velocity_controller/position/"}) {
    const std::string f = front;
    EXPECT_EQ(parsed("t," + f + "joint1," + f + "joint2," + f + "joint3\n0,1,2,3\n")
                  .trajectory.positions[0],
              Vector3(1, 2, 3))
        << front;
  }
}

TEST(RecordingColumns, AFileInRadiansAndDegreesNeedsAMap) {
  const std::string text = "t,joint1_deg,joint1_rad,joint2,joint3\n0,180,3,1,2\n";
  EXPECT_REFUSED(parsed(text), "the arm has no joint1_deg, joint1_rad");
  const Recording read = parsed(
      text, {.match = {.joint_map = read_joint_map("joint1_deg,joint2,joint3", three_joints())}});
  EXPECT_NEAR(read.trajectory.positions[0][0], std::numbers::pi, 1e-15);
}

TEST(RecordingColumns, SaysThatItWasReadInRadians) {
  const std::string text = "t,joint1,joint2,joint3\n0,1,2,3\n";
  const auto kinds = [](const Recording& read) {
    std::vector<RecordingNoteKind> found;
    for (const RecordingNote& note : read.notes) found.push_back(note.kind);
    return found;
  };
  using Kinds = std::vector<RecordingNoteKind>;
  EXPECT_EQ(kinds(parsed(text)), Kinds());
  const Recording read = parsed(text, {.detect_degrees = true});
  EXPECT_EQ(kinds(read), Kinds{RecordingNoteKind::read_in_radians});
  EXPECT_EQ(sentence(read.notes[0], OptionStyle::command),
            "a.csv is read in radians: neither the names of its columns nor its values say that "
            "its angles are in degrees; --angle-unit deg reads degrees");
  EXPECT_EQ(kinds(parsed(text, {.detect_degrees = true, .angle_unit_is_known = true})), Kinds());
  JointMap map;
  for (const std::string& name : three_joints().joint_names())
    map.push_back({.name = name, .unit = 1});
  EXPECT_EQ(kinds(parsed(text, {.match = {.joint_map = map}, .detect_degrees = true})), Kinds());
  // A motion as this library plans it.
  std::string planned = "t", row = "0";
  for (const char* behind : {"", "_vel", "_acc"}) {
    for (const std::string& joint : three_joints().joint_names())
      planned.append(",").append(joint + behind);
    row += ",1,2,3";
    const Recording of = parsed(planned + "\n" + row + "\n", {.detect_degrees = true});
    EXPECT_EQ(of.notes.empty(), !of.trajectory.accelerations.empty());
  }
  // Within the limits only as radians.
  std::vector<Joint> joints = three_joints().joints();
  joints[1].limits.lower = 0.5;
  const Arm lifted("lifted", joints);
  EXPECT_EQ(kinds(parse_recording(text, "a.csv", lifted, {.detect_degrees = true})), Kinds());
}

TEST(RecordingColumns, RatesMayBeNamedInWords) {
  const std::string rows = "\n0,1,2,3,4,5,6,7,8,9\n";
  const auto names = [](const std::string& front, const std::string& behind) {
    std::string text;
    for (const std::string& joint : three_joints().joint_names())
      text.append(",").append(front + joint + behind);
    return text;
  };
  const std::pair<std::string, std::string> velocities[] = {
      {"", "_velocity"}, {"", "/velocity"}, {"velocity_", ""}, {"vel.", ""}, {"", "_VEL"}};
  const std::pair<std::string, std::string> accelerations[] = {
      {"", "_acceleration"}, {"", ".accel"}, {"acc/", ""}};
  for (const auto& v : velocities) {
    for (const auto& a : accelerations) {
      const Recording read =
          parsed("t" + names("", "") + names(v.first, v.second) + names(a.first, a.second) + rows);
      EXPECT_EQ(read.trajectory.velocities.at(0), Vector3(4, 5, 6)) << v.first << v.second;
      EXPECT_EQ(read.trajectory.accelerations.at(0), Vector3(7, 8, 9)) << a.first << a.second;
    }
  }
  const Recording words = parsed("time" + names("position_", "") + names("velocity_", "") +
                                 names("effort_", "") + rows);
  EXPECT_EQ(words.trajectory.positions[0], Vector3(1, 2, 3));
  EXPECT_EQ(words.trajectory.velocities.at(0), Vector3(4, 5, 6));
  // Not all joints have it.
  EXPECT_REFUSED(parsed("t,joint1,joint2,joint3,joint1_velocity\n0,1,2,3,4\n"),
                 "the arm has no joint1_velocity");
}

TEST(RecordingColumns, OneBesideAllJointsOfAMakerIsNamedAlone) {
  const std::vector<std::string> joints = joint_namings(built_in("ur5")).at(1);
  for (const std::string front : {"", "left_"}) {
    std::string text = "time", listed;
    for (const std::string& joint : joints) {
      text += ',' + front + joint;
      listed += (listed.empty() ? "" : ", ") + front + joint;
    }
    EXPECT_REFUSED(
        parse_recording(text + ",finger\n0,1,2,3,4,5,6,7\n", "a.csv", built_in("ur5")),
        "a.csv: the trajectory does not fit arm ur5: the arm has no finger; the arm's joints are " +
            listed + "; a joint map");
  }
}

/// A table whose columns have these texts before and behind the names of the joints.
std::string table_of(const std::string& front, const std::string& behind) {
  std::string text = "t";
  for (const std::string& joint : three_joints().joint_names())
    text.append(",").append(front + joint + behind);
  return text + "\n0,1,2,3\n";
}

TEST(RecordingColumns, WordsOfOtherUnitsAndQuantitiesAreRefused) {
  for (const char* word :
       {"mrad",     "mdeg",   "rev",  "turns", "percent", "counts", "ticks",   "encoder",
        "err",      "delta",  "diff", "rate",  "omega",   "temp",   "current", "force",
        "residual", "load",   "pwm",  "power", "status",  "mode",   "min",     "max",
        "limit",    "offset", "bias", "std",   "gon",     "cm",     "variance"}) {
    const std::string front(word);
    EXPECT_REFUSED(parsed(table_of(front + "_", "")),
                   "a.csv: column \"" + front + "_joint1\" says \"" + front + "\"");
    EXPECT_REFUSED(parsed(table_of("/" + front + "/", "/position")), "says \"" + front + "\"");
    EXPECT_REFUSED(parsed(table_of("/x/positions/" + front + "_", "")), "says \"" + front + "\"");
  }
  for (const char* front : {"/x/error/", "/jtc/controller_state/error/positions/"}) {
    EXPECT_REFUSED(parsed(table_of(front, "/position")), "says \"error\"");
  }
  EXPECT_REFUSED(parsed(table_of("/jtc/controller_state/error/positions/", "")), "says \"error\"");
  for (const char* front : {"left_", "/velocity_controller/", "/modes/"}) {
    EXPECT_EQ(parsed(table_of(front, "/position")).trajectory.positions[0], Vector3(1, 2, 3));
  }
  const RecordingOptions mapped{
      .match = {.joint_map = read_joint_map("err_joint1,err_joint2,err_joint3", three_joints())}};
  EXPECT_EQ(parsed(table_of("err_", ""), mapped).trajectory.positions[0], Vector3(1, 2, 3));
  // A joint's own name may have such a word.
  const Arm turns("turns", {composite_joint('R', "rev_joint").front()});
  EXPECT_EQ(parse_recording("t,rev_joint\n0,1\n", "a.csv", turns).trajectory.positions[0][0], 1);
  EXPECT_EQ(parse_recording("t,a_REV_joint\n0,1\n", "a.csv", turns).trajectory.positions[0][0], 1);
}

TEST(RecordingColumns, TwoSetsOfPositionsAreRefused) {
  const std::string text =
      "t,joint1,joint2,joint3,/command/joint1/position,/command/joint2/position,"
      "/command/joint3/position\n0,1,2,3,4,5,6\n";
  EXPECT_REFUSED(parsed(text),
                 "columns \"joint1\" and \"/command/joint1/position\" may both be positions of "
                 "joint joint1; a joint map");
  const RecordingOptions mapped{
      .match = {.joint_map = read_joint_map("joint1,joint2,joint3", three_joints())}};
  EXPECT_EQ(parsed(text, mapped).trajectory.positions[0], Vector3(1, 2, 3));
}

}  // namespace
}  // namespace beeline
