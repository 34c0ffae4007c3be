#include <cli/command/program.h>
#include <cli/verbs.h>
#include <gtest/gtest.h>
#include <set>

#include <beeline/control/joint.h>
#include <beeline/io/text/json.h>
#include <beeline/io/text/numbers.h>
#include <beeline/io/trajectory_file.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/reason.h>

#include <tests/random.h>
#include <tests/temporary_folder.h>

namespace beeline::command {
namespace {

using testing::Random;

/// A value in JSON as the type of the first argument.
struct FieldValue {
  const JsonDocument& json;
  const Json& value;

  ReasonValue operator()(bool) const { return json.truth(value); }
  ReasonValue operator()(std::size_t) const { return static_cast<std::size_t>(json.number(value)); }
  ReasonValue operator()(double) const { return json.number(value); }
  ReasonValue operator()(const std::string&) const { return json.text(value); }
  ReasonValue operator()(const Eigen::Vector3d&) const {
    const std::vector<double> p = json.numbers(value, 3);
    return Eigen::Vector3d(p[0], p[1], p[2]);
  }
  ReasonValue operator()(Ending) const {
    for (const Ending ending : {Ending::time_limit, Ending::cancelled, Ending::work_limit}) {
      if (name(ending) == json.text(value)) return ending;
    }
    return Ending::complete;
  }
};

/// The reason that an object's `code` and `fields` describe.
Reason reason_of(const JsonDocument& json, const Json& object) {
  Reason reason{reason_code_named(json.text(json.need(object, "code")))};
  for (const auto& [key, value] : json.members(json.need(object, "fields"))) {
    if (key == "details") {
      for (const Json& detail : json.items(value))
        reason.details.push_back(reason_of(json, detail));
    } else {
      const ReasonField field = reason_field_named(key);
      reason.set(field, std::visit(FieldValue{json, value}, default_value(field)));
    }
  }
  return reason;
}

/// Runs commands whose answer is no, and compares the sentence in the answer with the sentence of
/// its data.
class Answers {
 public:
  void ask(std::vector<std::string> words) {
    words.insert(words.begin(), "beeline");
    words.emplace_back("--json");
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    const int code = run_program(all_verbs(), static_cast<int>(arguments.size()), arguments.data());
    const std::string text = ::testing::internal::GetCapturedStdout();
    const std::string error = ::testing::internal::GetCapturedStderr();
    ASSERT_LE(code, 1) << error;
    if (code == 0) return;
    const JsonDocument json(text, "answer");
    const Json* const said = json.find(json.root(), "reason");
    ASSERT_TRUE(said) << text;
    const Reason reason = reason_of(json, json.root());
    EXPECT_EQ(sentence(reason), json.text(*said)) << text;
    codes_.insert(reason.code);
  }
  std::size_t kinds() const { return codes_.size(); }

 private:
  std::set<ReasonCode> codes_;
};

std::string row(const Eigen::VectorXd& numbers) {
  std::string text;
  for (const double x : numbers) text += (text.empty() ? "" : ",") + exact(x);
  return text;
}

std::string pose_text(const Pose& pose) {
  const RollPitchYaw rpy = roll_pitch_yaw(pose.linear());
  Eigen::VectorXd numbers(6);
  numbers << pose.translation(), rpy.roll, rpy.pitch, rpy.yaw;
  return row(numbers);
}

TEST(JsonReason, SaysAllThatItsSentenceSays) {
  Random random;
  const testing::TemporaryFolder folder;
  Answers answers;
  for (int i = 0; i < testing::cases(60); ++i) {
    const Arm arm = built_in(i % 2 == 0 ? "ur5" : "panda");
    const Configuration q = random.configuration(arm), other = random.configuration(arm);
    Pose goal = forward_kinematics(arm, other);
    goal.translation() *= random.uniform(0.5, 3);
    answers.ask({"ik", arm.name(), "--pose=" + pose_text(goal)});
    answers.ask({"move", arm.name(), "--from=" + row(q), "--to=" + row(other), "--method=feedback",
                 "--max-steps=40", "--kp=" + number(random.uniform(0.01, 2.5))});
    Pose near = forward_kinematics(arm, q);
    near.translation() += random.vector(0.3);
    const std::string poses =
        folder.write("poses.csv", "x,y,z,roll,pitch,yaw\n" + pose_text(near) + "\n");
    const std::string work = "--max-work=" + std::to_string(random.integer(10, 100'000));
    answers.ask({"line", arm.name(), "--from=" + row(q), "--through=" + poses, work,
                 "--rate=" + std::to_string(random.integer(5, 200))});
    const std::string program = folder.write(
        "program.csv", "motion,x,y,z,roll,pitch,yaw\njoint," + pose_text(near) + "\nline," +
                           pose_text(random.integer(0, 1) == 0 ? goal : near) + "\n");
    answers.ask({"line", arm.name(), "--from=" + row(q), "--through=" + program, work});
    const std::string recorded = folder.file("move.csv");
    write_trajectory(recorded, move_joints(arm, q, other, {.rate = 20}).trajectory);
    answers.ask({"retime", arm.name(), recorded, "--rate=500", "--max-samples=60"});
    answers.ask({"replay", arm.name(), recorded, "--speed=" + number(random.uniform(1, 3))});
    answers.ask({"check", arm.name(), recorded, "--through=" + poses});
  }
  EXPECT_GE(answers.kinds(), 5);
}

}  // namespace
}  // namespace beeline::command
