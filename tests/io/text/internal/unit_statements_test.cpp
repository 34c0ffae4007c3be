#include <gtest/gtest.h>

#include <beeline/io/text/internal/stated_units.h>

#include <tests/refusal.h>

// What comments say about units: text by text.

namespace beeline::internal {
namespace {

StatedUnits stated_in(const std::string& text, const std::vector<std::string>& columns) {
  return stated_units({{text, 3}}, columns, "a.csv");
}

void append(std::string& text, const std::string& what, const Unit* unit) {
  if (unit != nullptr) text += (text.empty() ? "" : " ") + what + name_of(*unit);
}

/// The statement in a fixed form: `deg`, `x0 deg` of the x-th derivative alone, `time ms`, `joint1:
/// deg`, `! mrad` of a unit that is not read and `? angles` where it is not clear.
std::string summary(const StatedUnits& stated, const std::vector<std::string>& columns) {
  std::string text;
  for (const OrderedUnits* units : {&stated.angle, &stated.length}) {
    append(text, "", units->all);
    for (const char order : {'0', '1', '2'}) {
      append(text, std::string("x") + order + " ",
             units->of_order[static_cast<std::size_t>(order - '0')]);
    }
  }
  append(text, "time ", stated.time);
  for (const UnitOfColumn& column : stated.columns) {
    append(text, columns[column.column] + ": ", column.unit);
  }
  for (const UnreadUnit& unread : stated.unread)
    text += (text.empty() ? "! " : " ! ") + unread.unit;
  for (const UnclearComment& unclear : stated.unclear) {
    text += text.empty() ? "?" : " ?";
    if (unclear.angles) text += " angles";
    if (unclear.lengths) text += " lengths";
    if (unclear.times) text += " times";
  }
  return text;
}

struct Statement {
  const char* comment;
  const char* says;
};

const std::vector<std::string> joints{"t", "joint1", "joint2", "joint_3", "base"};
const std::vector<std::string> poses{"x", "y", "z", "roll", "pitch", "yaw", "speed"};

TEST(UnitStatements, OfJoints) {
  for (const auto& [comment, says] :
       std::vector<Statement>{// One unit of a quantity.
                              {"units: deg", "deg"},
                              {"Unit = DEG", "deg"},
                              {"UNITS:DEG", "deg"},
                              {"unit \xc2\xb0", "deg"},
                              {"deg", "deg"},
                              {"[deg]", "deg"},
                              {"in degrees", "deg"},
                              {"deg, s", "deg time s"},
                              {"units: degrees, mm; ms", "deg mm time ms"},
                              {"unit=degrees;time=ms", "deg time ms"},
                              {"angle_unit: deg", "deg"},
                              {"angle-unit: deg", "deg"},
                              {"joint_unit: deg", "deg"},
                              {"time_unit=ms", "time ms"},
                              {"joint values (degrees)", "deg"},
                              {"Joint angles are given in degrees", "deg"},
                              {"angles of the left arm in deg", "deg"},
                              {"angles/deg, lengths/mm", "deg mm"},
                              {"all angles (\xc2\xb0), times (ms)", "deg time ms"},
                              {"timestamps in milliseconds", "time ms"},
                              {"time from start in us", "time us"},
                              {"angles and times in deg and ms", "deg time ms"},
                              {"units: SI", "rad m time s"},
                              {"units: si (rad, s)", "rad m time s"},
                              {"rate: 100 Hz, units: rad", "rad"},
                              {"period: 10 ms, units: deg", "deg"},
                              {"angles: rad, torque: Nm", "rad"},
                              {"position: rad, velocity: rad/s, effort: N*m", "x0 rad x1 rad"},
                              {"units: deg, tool in mm", "deg"},
                              {"units: rad, Nm, A, degC", "rad"}}) {
    EXPECT_EQ(summary(stated_in(comment, joints), joints), says) << comment;
  }
}

TEST(UnitStatements, OfPositionsAndRatesApart) {
  for (const auto& [comment, says] : std::vector<Statement>{
           // Positions and rates apart.
           {"positions in rad, velocities in deg/s", "x0 rad x1 deg"},
           {"positions, velocities in rad, deg/s", "x0 rad x1 deg"},
           {"units: rad, deg/s", "rad x1 deg"},
           {"units: rad; velocity: deg/s", "rad x1 deg"},
           {"units: deg/s", "x1 deg"},
           {"units: degree per second", "x1 deg"},
           {"velocity unit: deg/s", "x1 deg"},
           {"joint speeds [deg / s]", "x1 deg"},
           {"velocities in deg", "x1 deg"},
           {"accelerations: deg/s^2", "x2 deg"},
           {"accelerations in deg/s\xc2\xb2", "x2 deg"},
           {"rad, rad/s, rad/s2", "rad x1 rad x2 rad"},
           // Single columns.
           {"joint1: deg, joint2: rad", "joint1: deg joint2: rad"},
           {"joint1 and joint2 in degrees", "joint1: deg joint2: deg"},
           {"Joint 1 in degrees, joint 3 in radians", "joint1: deg joint_3: rad"},
           {"t [ms] joint1 [deg] joint2 [deg]", "t: ms joint1: deg joint2: deg"},
           {"columns: t [s], joint1 [deg]", "t: s joint1: deg"},
           {"t: ms", "t: ms"},
           {"base joint at rest; angles in deg", "deg"},
           // Negations that another unit replaces.
           {"not in radians but degrees", "deg"},
           {"joint positions are in degrees not radians", "x0 deg"},
           {"angles in radians (not degrees)", "rad"}}) {
    EXPECT_EQ(summary(stated_in(comment, joints), joints), says) << comment;
  }
}

TEST(UnitStatements, OfOtherThingsAreIgnored) {
  for (const auto& [comment, says] :
       std::vector<Statement>{// Nothing about the columns.
                              {"", ""},
                              {"recorded by a robot, with care", ""},
                              {"tolerance 0.1 deg", ""},
                              {"limits in deg: 170", ""},
                              {"max error: 0.5 degrees", ""},
                              {"Recorded at 45 degrees", ""},
                              {"12 deg above zero", ""},
                              {"unit 5 deg", ""},
                              {"step 1 deg, sampling 10ms", ""},
                              {"sampling period 10 ms", ""},
                              {"time step in ms: 10", ""},
                              {"latency in ms", ""},
                              {"a 60 mm gripper", ""},
                              {"joint degrees of freedom: 2", ""},
                              {"wrist camera: 60 deg fov", ""},
                              {"temperature: deg C", ""},
                              {"temperature in degrees Celsius", ""},
                              {"tool pose in mm and degrees", ""},
                              {"tcp in mm, rpy in deg", ""},
                              {"orientation in degrees", ""},
                              {"recorded by M. Smith and the robot's owner", ""},
                              {"columns: t, joint1, joint2", ""}}) {
    EXPECT_EQ(summary(stated_in(comment, joints), joints), says) << comment;
  }
}

TEST(UnitStatements, NamesOfPeopleAreNone) {
  for (const char* comment : {"Ms. Jones", "M. Meier", "recorded by M. Meier, 1 May", "S. Rossi",
                              "by S. Rossi. M. Meier checked it", "second"}) {
    EXPECT_EQ(summary(stated_in(comment, joints), joints), "") << comment;
    EXPECT_EQ(summary(stated_in(comment, poses), poses), "") << comment;
  }
  EXPECT_EQ(summary(stated_in("t in ms. Joints in deg.", joints), joints), "deg t: ms");
  EXPECT_EQ(summary(stated_in("ms. Joints in rad.", joints), joints), "rad time ms");
  EXPECT_EQ(summary(stated_in("MM. Deg.", poses), poses), "deg mm");
  EXPECT_EQ(summary(stated_in("ms.", joints), joints), "time ms");
  EXPECT_EQ(summary(stated_in("mm. deg.", poses), poses), "deg mm");
}

TEST(UnitStatements, InOtherUnitsOrUnclear) {
  for (const auto& [comment, says] :
       std::vector<Statement>{// Units that are not read.
                              {"angles in mrad", "! mrad"},
                              {"units: counts", "! counts"},
                              {"units: revolutions", "! revolutions"},
                              {"angles in turns", "! turns"},
                              {"units: cm", "! cm"},
                              {"mrad", "! mrad"},
                              {"time in min", "! min"},
                              {"times in hours", "! hours"},
                              {"units: min, deg", "deg ! min"},
                              {"positions: deg, velocities: rpm", "x0 deg ! rpm"},
                              {"velocities in deg/min", "! deg/min"},
                              {"joint1: mrad", "! mrad"},
                              // Unclear.
                              {"converted from degrees", "? angles"},
                              {"angles converted to degrees", "? angles"},
                              {"exported from degrees", "? angles"},
                              {"angles not in deg", "? angles"},
                              {"degrees: false", "? angles"},
                              {"degrees = no", "? angles"},
                              {"use_degrees: 0", "? angles"},
                              {"units: rad (was deg)", "? angles"},
                              {"use --angle-unit deg for degrees", "? angles"},
                              {"first joint in degrees", "? angles"},
                              {"joint 5 in degrees", "? angles"},
                              {"joint1 velocities in deg/s", "? angles"},
                              {"min and max of the joints in deg", ""},
                              {"all joints except the last in deg", "? angles"},
                              {"angles in deg or rad", "? angles"},
                              {"Winkel in Grad", "? angles"},
                              {"units: smoots", "? angles lengths times"},
                              {"units: degC", "? angles lengths"},
                              {"A1: deg, A2: rad", "? angles"},
                              {"joints in ms", "? times"},
                              {"positions in deg/s", "? angles"},
                              {"from the pendant, deg", "? angles"}}) {
    EXPECT_EQ(summary(stated_in(comment, joints), joints), says) << comment;
  }
}

TEST(UnitStatements, OfPoses) {
  for (const auto& [comment, says] :
       std::vector<Statement>{{"units: mm, deg", "deg mm"},
                              {"positions in mm, angles in degrees", "deg x0 mm"},
                              {"orientation in degrees", "deg"},
                              {"tool pose in mm and degrees", "deg mm"},
                              {"tcp in mm, rpy in deg", "deg mm"},
                              {"x, y, z in mm; roll, pitch, yaw in deg",
                               "x: mm y: mm z: mm roll: deg pitch: deg yaw: deg"},
                              {"units: mm, speed [mm/s]", "mm speed: mm"},
                              {"units: mm, m/s", "mm x1 m"},
                              {"a 60 mm gripper", ""},
                              {"joints in deg", ""}}) {
    EXPECT_EQ(summary(stated_in(comment, poses), poses), says) << comment;
  }
}

TEST(UnitStatements, TwoUnitsOfOneQuantityAreRefused) {
  EXPECT_REFUSED(stated_in("units: deg, rad", joints),
                 "a.csv:3: the comments give angles in deg and in rad; write the unit behind");
  EXPECT_REFUSED(stated_in("units: deg; positions in rad", joints),
                 "a.csv:3: the comments give positions in rad and in deg");
  EXPECT_REFUSED(stated_in("velocities in deg/s; velocity: rad/s", joints),
                 "a.csv:3: the comments give velocities in deg and in rad");
  EXPECT_REFUSED(stated_units({{"time in s", 1}, {"time: ms", 2}}, joints, "a.csv"),
                 "a.csv:2: the comments give times in s and in ms");
}

}  // namespace
}  // namespace beeline::internal
