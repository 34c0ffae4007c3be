#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include <beeline/io/text/numbers.h>
#include <beeline/io/trajectory_file.h>
#include <beeline/model/joint.h>

#include <tests/random.h>
#include <tests/refusal.h>

// Statements on units in recordings: whatever a file says, its numbers are read as it says, or a
// note or a refusal names the comment.

namespace beeline {
namespace {

using testing::Random;

struct WrittenUnit {
  std::string name;
  double si;
};

const WrittenUnit& written_unit(Random& random, bool length) {
  static const std::vector<WrittenUnit> angles{{"rad", 1}, {"deg", std::numbers::pi / 180}},
      lengths{{"m", 1}, {"mm", 1e-3}};
  return (length ? lengths : angles)[static_cast<std::size_t>(random.integer(0, 1))];
}

/// An arm of some revolute and prismatic joints, at least one of each.
Arm random_arm(Random& random) {
  std::vector<Joint> joints;
  const int count = random.integer(2, 5);
  for (int k = 0; k < count; ++k) {
    const bool slides = k == 1 || (k > 1 && random.integer(0, 2) == 0);
    joints.push_back(composite_joint(slides ? 'P' : 'R', "j" + std::to_string(k)).front());
  }
  return {"mixed", joints};
}

bool prismatic(const Arm& arm, int k) { return kind(arm.joint_of(k)) == JointKind::prismatic; }

/// How a file states its units.
enum class Spelling { names, row, quantities, list, joints, last = joints };

/// The units of a file: of each joint's positions, velocities and accelerations.
struct WrittenUnits {
  std::vector<WrittenUnit> joint[3];
  WrittenUnit time;
};

std::string rate_behind(int order) { return order == 0 ? "" : order == 1 ? "/s" : "/s^2"; }

/// Units of which all joints of a kind have the same, unless each joint's is stated.
WrittenUnits random_units(Random& random, const Arm& arm, Spelling spelling, int orders) {
  const std::vector<WrittenUnit> times{{"s", 1}, {"ms", 1e-3}, {"us", 1e-6}};
  WrittenUnits units;
  units.time = times[static_cast<std::size_t>(random.integer(0, 2))];
  const bool apart = spelling == Spelling::names || spelling == Spelling::row;
  for (int order = 0; order < orders; ++order) {
    const WrittenUnit angle = written_unit(random, false), length = written_unit(random, true);
    for (int k = 0; k < arm.dof(); ++k) {
      const bool own = apart || spelling == Spelling::joints;
      const WrittenUnit shared = prismatic(arm, k) ? length : angle;
      units.joint[order].push_back(own ? written_unit(random, prismatic(arm, k)) : shared);
      if (spelling == Spelling::joints && order > 0) {
        units.joint[order].back() = units.joint[0][static_cast<std::size_t>(k)];
      }
    }
  }
  return units;
}

/// The comment that states the units of all joints.
std::string comment_on(const Arm& arm, const WrittenUnits& units, Spelling spelling, int orders) {
  const char* const quantities[] = {"positions", "velocities", "accelerations"};
  std::string text = "# ";
  if (spelling == Spelling::list) text += "units: " + units.time.name;
  if (spelling != Spelling::list) text += "time in " + units.time.name;
  if (spelling == Spelling::joints) {
    for (int k = 0; k < arm.dof(); ++k) {
      text += ", " + arm.joint_of(k).name + ": " + units.joint[0][static_cast<std::size_t>(k)].name;
    }
    return text + "\n";
  }
  for (int order = 0; order < orders; ++order) {
    if (spelling == Spelling::quantities) text += std::string("; ") + quantities[order] + " in";
    for (const bool length : {false, true}) {
      for (int k = 0; k < arm.dof(); ++k) {
        if (prismatic(arm, k) != length) continue;
        text += (spelling == Spelling::list ? ", "
                 : length                   ? ", "
                                            : " ") +
                units.joint[order][static_cast<std::size_t>(k)].name + rate_behind(order);
        break;
      }
    }
  }
  return text + "\n";
}

/// Files with units in any of the spellings are read in radians, metres and seconds.
TEST(RecordedStatements, AllSpellingsAreReadAsTheySay) {
  Random random;
  const char* const suffixes[] = {"", "_vel", "_acc"};
  for (int i = 0; i < testing::cases(1500); ++i) {
    const Arm arm = random_arm(random);
    const auto spelling =
        static_cast<Spelling>(random.integer(0, static_cast<int>(Spelling::last)));
    const int orders = random.integer(1, 3);
    const WrittenUnits units = random_units(random, arm, spelling, orders);
    std::string header = spelling == Spelling::names ? "time_" + units.time.name : "time";
    std::string row_of_units = units.time.name, rows[2];
    std::vector<double> expected[2];
    for (int r = 0; r < 2; ++r) {
      rows[r] = std::to_string(r + 1);
      expected[r].push_back((r + 1) * units.time.si);
    }
    for (int order = 0; order < orders; ++order) {
      for (int k = 0; k < arm.dof(); ++k) {
        const WrittenUnit& unit = units.joint[order][static_cast<std::size_t>(k)];
        const std::string text = unit.name + rate_behind(order);
        header += "," + arm.joint_of(k).name + suffixes[order];
        if (spelling == Spelling::names) header += " [" + text + "]";
        row_of_units += "," + text;
        for (int r = 0; r < 2; ++r) {
          const double value = random.uniform(-1, 1);
          rows[r] += "," + exact(value);
          expected[r].push_back(value * unit.si);
        }
      }
    }
    const bool in_comment = spelling > Spelling::row, below = random.integer(0, 1) == 0;
    const std::string comment = in_comment ? comment_on(arm, units, spelling, orders) : "";
    const std::string text = (below ? "" : comment) + header + "\n" + (below ? comment : "") +
                             (spelling == Spelling::row ? row_of_units + "\n" : "") + rows[0] +
                             "\n" + rows[1] + "\n";
    const Trajectory read = parse_recording(text, "a.csv", arm).trajectory;
    for (std::size_t r = 0; r < 2; ++r) {
      ASSERT_NEAR(read.times[r], expected[r][0], 1e-15) << text;
      std::size_t next = 1;
      for (const auto* values : {&read.positions, &read.velocities, &read.accelerations}) {
        if (next == expected[r].size()) break;
        for (const double value : (*values)[r]) {
          ASSERT_NEAR(value, expected[r][next++], 1e-14) << text;
        }
      }
    }
  }
}

std::string one_row_of(const Arm& arm, const std::string& comment) {
  std::string header = "time", row = "3";
  for (int k = 0; k < arm.dof(); ++k) {
    header += "," + arm.joint_of(k).name;
    row += ",0.5";
  }
  return "# " + comment + "\n" + header + "\n" + row + "\n";
}

/// Any words about units: the numbers are in radians, metres and seconds, unless a note or a
/// refusal says which unit they are in or that the comment is not understood.
TEST(RecordedStatements, NoStatementChangesNumbersInSilence) {
  Random random;
  const std::vector<std::string> words{
      "units:",  "angles", "joint", "velocities", "positions", "time",   "in",  "deg",
      "degrees", "rad",    "mm",    "ms",         "mrad",      "counts", "not", "converted",
      "from",    "to",     "was",   "tool",       "limits",    "10",     "and", ",",
      ";",       "=",      "j0",    "j1",         "false",     "deg/s",  "of",  "the",
      "first",   "robot",  "(",     ")"};
  int read = 0;
  for (int i = 0; i < testing::cases(3000); ++i) {
    const Arm arm = random_arm(random);
    std::string comment;
    for (int n = random.integer(1, 8); n > 0; --n) {
      const auto last = static_cast<int>(words.size()) - 1;
      comment += words[static_cast<std::size_t>(random.integer(0, last))] + " ";
    }
    Recording recording;
    try {
      recording = parse_recording(one_row_of(arm, comment), "a.csv", arm);
    } catch (const FileError&) {
      continue;
    }
    ++read;
    const auto noted = [&](bool times) {
      return std::any_of(recording.notes.begin(), recording.notes.end(), [&](const auto& note) {
        return times ? note.time_unit.has_value() : note.joint_unit.has_value();
      });
    };
    for (const double value : recording.trajectory.positions[0]) {
      ASSERT_TRUE(value == 0.5 || noted(false)) << comment;
    }
    const double time = recording.trajectory.times[0];
    const bool says_ms = comment.find("ms") != std::string::npos;
    ASSERT_TRUE(time == 3 || (time == 0.003 && says_ms)) << comment;
    // A lone unit of angles after `not`, `converted` and the like is noted.
    const bool denied = comment.find("converted") != std::string::npos;
    const bool has_degrees = comment == "converted deg " || comment == "converted degrees ";
    ASSERT_TRUE(!denied || !has_degrees || noted(false)) << comment;
  }
  EXPECT_GT(read, testing::cases(3000) / 10);
}

TEST(RecordedStatements, CommentsThatAreNotClearAreNoted) {
  const Arm arm("pair",
                {composite_joint('R', "turn").front(), composite_joint('P', "slide").front()});
  const auto notes = [&](const std::string& text, const RecordingOptions& options = {}) {
    std::vector<RecordingNote> unclear;
    for (const RecordingNote& note : parse_recording(text, "a.csv", arm, options).notes) {
      if (note.kind == RecordingNoteKind::unclear_comment) unclear.push_back(note);
    }
    return unclear;
  };
  const std::string rows = "time,turn,slide\n0,1,2\n7,3,5\n";
  const auto found = notes("# converted from degrees\n" + rows);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].comment, "converted from degrees");
  EXPECT_EQ(found[0].joint_unit, JointUnit::radians);
  EXPECT_EQ(sentence(found[0], OptionStyle::command),
            "a.csv: the comment \"converted from degrees\" does not give a unit clearly; columns "
            "without a unit are read in rad; --angle-unit gives it");
  EXPECT_EQ(sentence(notes("# was ms\n" + rows).at(0)),
            "a.csv: the comment \"was ms\" does not give a unit clearly; times are read in s; "
            "time_unit gives it");
  EXPECT_EQ(notes("# not mm\n" + rows).at(0).joint_unit, JointUnit::metres);
  // Names of files and options of commands are no statements.
  for (const char* elsewhere :
       {"file: data_deg.csv", "source: C:\\data\\angles in degrees\\m5.csv", "in deg/m5.csv,",
        "by record --angle-unit deg arm", "by record --angle-unit=deg", "see ./deg", "(../deg/)"}) {
    const auto quoted = notes("# " + std::string(elsewhere) + "\n" + rows);
    ASSERT_EQ(quoted.size(), 1u) << elsewhere;
    EXPECT_EQ(quoted[0].joint_unit, JointUnit::radians) << elsewhere;
  }
  // Where something else gives the unit there is no note.
  const std::string comment = "# converted from degrees\n";
  EXPECT_TRUE(notes(comment + "time,turn_rad,slide\n0,1,2\n").empty());
  EXPECT_TRUE(notes(comment + "# units: rad\n" + rows).empty());
  EXPECT_TRUE(notes(comment + rows, {.angle_unit_is_known = true}).empty());
  EXPECT_TRUE(notes("# was ms\ntime_s,turn,slide\n0,1,2\n").empty());
  EXPECT_TRUE(notes("# was ms\n" + rows, {.time_unit = TimeUnit::seconds}).empty());
  // Below the first row, where it would come too late, a clear statement is refused.
  EXPECT_REFUSED(notes(rows + "# units: deg\n8,4,6\n"),
                 "a.csv:4: the comment \"units: deg\" gives units below the first row; write it");
  EXPECT_TRUE(notes("# units: deg\n" + rows + "# units: deg\n8,4,6\n# joint limit\n").empty());
}

TEST(RecordedStatements, RatesApartFromPositionsAreConvertedAndNoted) {
  const Arm arm("one", {composite_joint('R', "turn").front()});
  const Recording read = parse_recording(
      "# positions in rad, velocities in deg/s\nt,turn,turn_vel\n0,1,90\n", "a.csv", arm);
  EXPECT_EQ(read.trajectory.positions[0][0], 1);
  EXPECT_NEAR(read.trajectory.velocities[0][0], std::numbers::pi / 2, 1e-15);
  ASSERT_EQ(read.notes.size(), 2u);
  EXPECT_EQ(sentence(read.notes[1]),
            "a.csv: column turn_vel is read in deg per second, as a comment says");
  EXPECT_REFUSED(
      parse_recording("# units: deg/s\nt,turn,turn_vel\n0,1,90\n", "a.csv", arm),
      "a.csv: column \"turn\" has no unit, but its rates are, as a comment says, in deg/s");
  EXPECT_REFUSED(
      parse_recording("# angles in mrad\nt,turn\n0,1\n", "a.csv", arm),
      "a.csv:1: the comment \"angles in mrad\" gives the unit \"mrad\", which is not read; "
      "units that are read are rad, deg, m and mm");
  EXPECT_REFUSED(parse_recording("# time in min\nt,turn\n0,1\n", "a.csv", arm),
                 "a.csv:1: the comment \"time in min\" gives the unit \"min\"");
  EXPECT_EQ(parse_recording("# positions in rad, velocities: rpm\nt,turn\n0,1\n", "a.csv", arm)
                .trajectory.positions[0][0],
            1);
}

TEST(RecordedStatements, MessagesHaveThem) {
  const Arm arm("one", {composite_joint('R', "turn").front()});
  const std::string state =
      "header: {stamp: {sec: 5, nanosec: 0}}\nname: [turn]\nposition: [90]\nvelocity: [45]\n";
  const std::string trajectory =
      "joint_names: [turn]\npoints:\n- {positions: [90], velocities: [45], time_from_start: {sec: "
      "0, "
      "nanosec: 0}}\n";
  for (const std::string& text : {state, trajectory}) {
    for (const char* path : {"a.yaml", "a.txt"}) {
      const auto read = [&](const std::string& comment) {
        return parse_recording(comment + "\n" + text, path, arm);
      };
      const Recording degrees = read("# units: deg");
      EXPECT_NEAR(degrees.trajectory.positions[0][0], std::numbers::pi / 2, 1e-15);
      EXPECT_NEAR(degrees.trajectory.velocities[0][0], std::numbers::pi / 4, 1e-15);
      const Recording apart = read("# turn: rad, velocities in deg/s");
      EXPECT_EQ(apart.trajectory.positions[0][0], 90);
      EXPECT_NEAR(apart.trajectory.velocities[0][0], std::numbers::pi / 4, 1e-15);
      EXPECT_EQ(read("# converted from degrees").notes.back().kind,
                RecordingNoteKind::unclear_comment);
      EXPECT_REFUSED(read("# units: mrad"), "gives the unit \"mrad\", which is not read");
      EXPECT_REFUSED(read("# time in ms"), "but messages of ROS have seconds and nanoseconds");
      EXPECT_REFUSED(parse_trajectory("# units: deg\n" + text, path), "with an arm only");
    }
  }
}

}  // namespace
}  // namespace beeline
