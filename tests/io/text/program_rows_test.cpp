#include <gtest/gtest.h>

#include <beeline/io/text/pose_list.h>

#include <tests/refusal.h>

namespace beeline {
namespace {

ProgramRows rows_of(const std::string& text, AngleUnit unit = AngleUnit::radians) {
  return program_rows_from_csv(text, "p.csv", {.angle_unit = unit});
}

TEST(ProgramRows, AreReadInAnyOrderOfTheColumns) {
  const ProgramRows program = rows_of(
      "# a pick\n\"dwell\",yaw,pitch,roll,z,y,x,motion,relative,q,speed\n"
      ",90,0,0,3,2,1,,,,\n0.5,0,0,0,-0.1,0,0,line,next,,0.25\n,,,,,,,joint,,\"1, 2\",\n",
      AngleUnit::degrees);
  ASSERT_EQ(program.rows.size(), 3u);
  EXPECT_EQ(program.path, "p.csv");
  const ProgramRow& first = program.rows[0];
  EXPECT_EQ(first.motion, "");
  EXPECT_EQ(first.line, 3);
  ASSERT_TRUE(first.pose);
  EXPECT_LT((first.pose->pose.translation() - Vector3(1, 2, 3)).norm(), 1e-15);
  EXPECT_LT((first.pose->pose.linear() * Vector3::UnitX() - Vector3::UnitY()).norm(), 1e-12);
  EXPECT_FALSE(first.speed || first.blend || first.dwell);
  EXPECT_EQ(program.rows[1].relative, "next");
  EXPECT_EQ(program.rows[1].speed, 0.25);
  EXPECT_EQ(program.rows[1].dwell, 0.5);
  EXPECT_EQ(program.rows[2].q, "1, 2");
  EXPECT_FALSE(program.rows[2].pose);
}

TEST(ProgramRows, NeedNoPoseColumnsWhereAllAreJointValues) {
  const ProgramRows program = rows_of("motion;q\njoint;home\njoint;1,2\n");
  EXPECT_EQ(program.rows[0].q, "home");
  EXPECT_EQ(program.rows[1].q, "1,2");
}

TEST(ProgramRows, AttachAndDetachParts) {
  const ProgramRows program = rows_of(
      "motion;q;part;touch\nattach;;a box;\" table ,gripper\"\njoint;1,2;;\ndetach;;a box;\n");
  ASSERT_EQ(program.rows.size(), 3u);
  EXPECT_EQ(program.rows[0].part, "a box");
  EXPECT_EQ(program.rows[0].touch, (std::vector<std::string>{"table", "gripper"}));
  EXPECT_FALSE(program.rows[0].pose);
  EXPECT_TRUE(program.rows[1].part.empty() && program.rows[1].touch.empty());
  EXPECT_EQ(program.rows[2].motion, "detach");
  EXPECT_TRUE(program.rows[2].touch.empty());
  const std::string head = "motion,x,y,theta,speed,part,touch\n";
  const std::pair<const char*, const char*> cases[] = {
      {"attach,,,,,,", "p.csv:2: attach needs the name of an obstacle"},
      {"detach,,,,,,table", "p.csv:2: detach needs the name of an obstacle"},
      {"detach,,,,,box,table", "p.csv:2: touch is for attach"},
      {"attach,1,2,3,,box,", "p.csv:2: attach moves nothing"},
      {"attach,,,,1,box,", "p.csv:2: attach moves nothing"},
      {"line,1,2,3,,box,", "p.csv:2: part and touch are for rows"},
      {"line,1,2,3,,,table", "p.csv:2: part and touch are for rows"},
      {"attach,,,,,box,\"a,\"", "p.csv:2: column touch has an empty name"},
      {"attach,,,,,box,\",\"", "p.csv:2: column touch has an empty name"}};
  for (const auto& [row, culprit] : cases) EXPECT_REFUSED(rows_of(head + row + "\n"), culprit);
}

TEST(ProgramRows, AFileIsAProgramByItsHeader) {
  EXPECT_TRUE(is_program("# c\n\nx,y,z,dwell\n"));
  EXPECT_TRUE(is_program("q;motion"));
  EXPECT_FALSE(is_program("x,y,theta\n1,2,3\n"));
  EXPECT_FALSE(is_program("1,2,3\n"));
  EXPECT_FALSE(is_program(""));
  EXPECT_FALSE(is_program("\"motion\n"));
  EXPECT_FALSE(is_program("t,joint1,dwell_vel\n"));
}

TEST(ProgramRows, DialectsAreThoseOfPoses) {
  for (const char* text : {"Motion;X;Y;THETA;Speed\nline;1,5;2;0;0,25\n",
                           "# motion,x,y,theta,speed\nline,1.5,2,0,0.25\n",
                           "motion x y theta speed\rline 1.5 2 0 0.25\r"}) {
    EXPECT_TRUE(is_program(text)) << text;
    const ProgramRows program = rows_of(text);
    ASSERT_EQ(program.rows.size(), 1u) << text;
    EXPECT_EQ(program.rows[0].motion, "line");
    EXPECT_EQ(program.rows[0].speed, 0.25);
    ASSERT_TRUE(program.rows[0].pose);
    EXPECT_EQ(program.rows[0].pose->pose.translation(), Vector3(1.5, 2, 0));
  }
  EXPECT_REFUSED(rows_of("motion;x;y;theta\nline;1,5;2;0\nline;1.5;2;0\n"),
                 "p.csv:3: this row has decimal commas where others");
  EXPECT_REFUSED(rows_of("motion,x,X,y\n"), "p.csv:1: column \"x\" is given twice");
}

TEST(ProgramRows, AViaRowNeedsNoOrientation) {
  const std::pair<std::string, std::string> forms[] = {{"x,y,theta", "1,2,"},
                                                       {"x,y,z,roll,pitch,yaw", "1,2,0,,,"},
                                                       {"x,y,z,rx,ry,rz", "1,2,0,,,"},
                                                       {"x,y,z,A,B,C", "1,2,0,,,"},
                                                       {"x,y,z,qw,qx,qy,qz", "1,2,0,,,,"}};
  for (const auto& [columns, items] : forms) {
    const ProgramRows program = rows_of("motion," + columns + "\nvia," + items + "\n");
    ASSERT_TRUE(program.rows.at(0).pose) << columns;
    EXPECT_EQ(program.rows[0].pose->pose.translation(), Vector3(1, 2, 0)) << columns;
    EXPECT_EQ(program.rows[0].pose->pose.linear(), Rotation::Identity()) << columns;
    EXPECT_REFUSED(rows_of("motion," + columns + "\narc," + items + "\n"), "p.csv:2: column");
  }
  const std::string head = "motion,x,y,z,roll,pitch,yaw\n";
  EXPECT_REFUSED(rows_of(head + "via,1,2,3,,0,0\n"), "p.csv:2: column roll");
  EXPECT_REFUSED(rows_of(head + "via,1,,3,,,\n"), "p.csv:2: column y");
}

TEST(ProgramRows, MistakesAreNamedWithTheirLine) {
  const std::string head = "motion,relative,x,y,theta,speed\n";
  EXPECT_REFUSED(rows_of(head + "lin,,1,2,3,\n"), "p.csv:2: unknown motion \"lin\"");
  EXPECT_REFUSED(rows_of(head + "\nline,nex,1,2,3,\n"), "p.csv:3: unknown relative \"nex\"");
  EXPECT_REFUSED(rows_of(head + "line,,1,2,,\n"), "p.csv:2: column theta");
  EXPECT_REFUSED(rows_of(head + "line,,1,2,3,fast\n"), "p.csv:2: column speed");
  EXPECT_REFUSED(rows_of(head + "line,,1,2,3\n"), "p.csv:2: this row has 5 items");
  EXPECT_REFUSED(rows_of(head + "via,,1,2,3,1\n"), "p.csv:2: a via row has no speed");
  EXPECT_REFUSED(rows_of(head), "p.csv: has a header but no rows");
  EXPECT_REFUSED(rows_of("motion,x,y\n"), "no rows");
  EXPECT_REFUSED(rows_of("motion,x,x,y\nline,1,1,1\n"), "p.csv:1: column \"x\" is given twice");
  EXPECT_REFUSED(rows_of("motion,x,z\nline,1,1\n"),
                 "p.csv:1: columns y, roll, pitch, yaw are missing beside x, z");
  EXPECT_REFUSED(rows_of("motion\nline\n"), "p.csv:1: column");
  EXPECT_REFUSED(rows_of("relative,x,y,z\nnext,1,2,3\n"), "p.csv:2: relative is for poses with");
}

}  // namespace
}  // namespace beeline
