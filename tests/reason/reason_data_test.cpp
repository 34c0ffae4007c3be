#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <numbers>
#include <regex>
#include <set>

#include <beeline/certificate/clearance.h>
#include <beeline/control/cartesian.h>
#include <beeline/control/joint.h>
#include <beeline/control/replay.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/planning/program.h>
#include <beeline/timing/retime.h>

#include <tests/collision/random_model.h>
#include <tests/random.h>
#include <tests/reason.h>

namespace beeline {
namespace {

using testing::Random;
using enum ReasonField;

using Numbers = std::set<std::string>;

/// The numbers in a text, as they are written.
Numbers numbers_in(const std::string& text) {
  static const std::regex number(R"(-?\d+(\.\d+)?(e[+-]?\d+)?)");
  Numbers found;
  for (std::sregex_iterator i(text.begin(), text.end(), number), end; i != end; ++i) {
    found.insert(i->str());
  }
  return found;
}

void add(Numbers& known, const std::string& text) { known.merge(numbers_in(text)); }

struct Values {
  std::vector<double> reals{1};  // 1: the fraction of a limit that is used in full
  Numbers written{"0"};          // 0: a coordinate that is the rounding error of the others
  std::vector<std::string> names;
};

void collect(const Reason& reason, Values& values) {
  for (const auto& [field, value] : reason.fields) {
    EXPECT_EQ(value.index(), default_value(field).index())
        << name(field) << " of " << name(reason.code);
    if (const auto* real = std::get_if<double>(&value)) values.reals.push_back(*real);
    if (const auto* text = std::get_if<std::string>(&value)) values.names.push_back(*text);
    if (const auto* n = std::get_if<std::size_t>(&value)) add(values.written, std::to_string(*n));
    if (const auto* point = std::get_if<Eigen::Vector3d>(&value)) {
      for (const double x : *point) add(values.written, number(x));
    }
  }
  for (const Reason& detail : reason.details) collect(detail, values);
}

/// All ways in which a sentence may write the numbers of a reason.
Numbers writable(const Values& values) {
  Numbers written = values.written;
  for (const double x : values.reals) {
    add(written, number(x) + " " + beeline::angle(x) + " " + percent(x) + " " + number_at_least(x) +
                     " " + number_at_least(x * 180 / std::numbers::pi) + " " + number(100 * x) +
                     " " + number(std::abs(x) / (2 * std::numbers::pi)));
    for (const double y : values.reals) {
      add(written, number(std::abs(x - y)) + " " + number_apart(x, y));
    }
  }
  return written;
}

/// The data of a reason say all that its sentence says: each number and each name in the sentence
/// is in a field, and each field has one type for all reasons.
void expect_data(const Reason& reason) {
  ASSERT_TRUE(reason);
  Values values;
  collect(reason, values);
  std::string said = sentence(reason);
  EXPECT_NE(said, "");
  for (const std::string& name : values.names) {
    for (std::size_t at = said.find(name); !name.empty() && at != std::string::npos;
         at = said.find(name)) {
      said.replace(at, name.size(), "|");
    }
  }
  said = std::regex_replace(said, std::regex("s\\^[23]"), "s^");
  const Numbers known = writable(values);
  for (const std::string& number : numbers_in(said)) {
    EXPECT_TRUE(known.contains(number)) << number << " in: " << sentence(reason);
  }
  std::set<ReasonField> once;
  for (const auto& entry : reason.fields) EXPECT_TRUE(once.insert(entry.first).second);
}

/// The reasons of random refusals, by their codes.
class Refusals {
 public:
  void add(const Reason& reason) {
    if (!reason) return;
    expect_data(reason);
    ++found_[reason.code];
  }
  int kinds() const { return static_cast<int>(found_.size()); }

 private:
  std::map<ReasonCode, int> found_;
};

constexpr const char* arms[] = {"rrr", "scara", "puma560", "ur5", "panda"};

Arm random_arm_of(Random& random) { return built_in(arms[random.integer(0, 4)]); }

Budget random_budget(Random& random) {
  Budget budget;
  if (random.integer(0, 3) == 0) budget.max_work = random.integer(0, 3000);
  return budget;
}

Pose pose_in(Random& random, const Arm& arm, double size) {
  Pose pose = forward_kinematics(arm, random.configuration(arm));
  pose.translation() *= random.uniform(0.5, size);
  if (!arm.planar() && random.integer(0, 1) == 0) pose.linear() = random.rotation();
  return pose;
}

TEST(ReasonData, SayAllOfTheSentencesOfInverseKinematics) {
  Random random;
  Refusals refusals;
  for (int i = 0; i < testing::cases(400); ++i) {
    const Arm arm = random_arm_of(random);
    InverseOptions options{.all = random.integer(0, 1) == 0, .budget = random_budget(random)};
    if (random.integer(0, 2) == 0) options.method = InverseMethod::numerical;
    InverseResult result = inverse_kinematics(arm, pose_in(random, arm, 3), options);
    refusals.add(result.reason);
    explain(result);
    refusals.add(result.reason);
  }
  EXPECT_GE(refusals.kinds(), 3);
}

std::vector<Pose> random_poses(Random& random, const Arm& arm, const Configuration& start) {
  std::vector<Pose> poses;
  for (int k = random.integer(1, 3); k > 0; --k) {
    Pose pose =
        random.integer(0, 3) == 0 ? pose_in(random, arm, 2) : forward_kinematics(arm, start);
    pose.translation() += random.vector(0.2 * arm.reach().radius);
    if (arm.planar()) pose.translation().z() = 0;
    poses.push_back(pose);
  }
  return poses;
}

PathMotionOptions random_options(Random& random) {
  PathMotionOptions options{.budget = random_budget(random)};
  if (random.integer(0, 2) == 0) options.rate = random.uniform(2, 100);
  if (random.integer(0, 2) == 0) options.max_samples = random.integer(2, 200);
  if (options.rate == 0 && random.integer(0, 2) == 0) options.duration = random.uniform(0.01, 2);
  if (random.integer(0, 2) == 0) options.tolerance = 1e-6;
  if (random.integer(0, 2) == 0) options.interpolation = Interpolation::linear;
  return options;
}

TEST(ReasonData, SayAllOfTheSentencesOfLines) {
  Random random;
  Refusals refusals;
  for (int i = 0; i < testing::cases(240); ++i) {
    const Arm arm = random_arm_of(random);
    const Configuration start = random.configuration(arm);
    const std::vector<Pose> poses = random_poses(random, arm, start);
    refusals.add(move_in_lines(arm, start, poses, random_options(random)).reason);
    refusals.add(control_in_lines(arm, start, poses,
                                  {.method = CartesianMethod::inverse_kinematics,
                                   .simulation = {.max_steps = 50}})
                     .reason);
  }
  EXPECT_GE(refusals.kinds(), 5);
}

TEST(ReasonData, SayAllOfTheSentencesOfPrograms) {
  Random random;
  Refusals refusals;
  for (int i = 0; i < testing::cases(120); ++i) {
    const Arm arm = random_arm_of(random);
    const Configuration start = random.configuration(arm);
    Program program;
    for (const Pose& pose : random_poses(random, arm, start)) {
      Move move{.kind = random.integer(0, 2) == 0 ? MoveKind::joint : MoveKind::line,
                .target = pose};
      if (random.integer(0, 4) == 0) move.dwell = random.integer(0, 3) == 0 ? 5e5 : 0.1;
      program.moves.push_back(move);
    }
    PathMotionOptions options = random_options(random);
    options.duration.reset();
    if (program.moves.back().dwell > 1) options.rate = 100;
    const bool open = random.integer(0, 1) == 0;
    const ProgramMotion motion =
        move_program(arm, open ? std::nullopt : std::optional(start), program, options);
    if (motion) continue;
    refusals.add(motion.reason);
    EXPECT_EQ(testing::field<std::size_t>(motion.reason, ReasonField::move), motion.failed + 1);
    EXPECT_TRUE(motion.reason.has(move_name)) << motion.reason;
    EXPECT_NE(testing::field<bool>(motion.reason, beginning), std::optional(false))
        << motion.reason;
  }
  EXPECT_GE(refusals.kinds(), 3);
}

TEST(ReasonData, SayAllOfTheSentencesOfClearances) {
  Random random;
  Refusals refusals;
  for (int i = 0; i < testing::cases(3000); ++i) {
    const Arm arm = random_arm_of(random);
    const CollisionModel model(arm, testing::random_link_shapes(random, arm, 0.1),
                               testing::random_scene(random, arm, 20, 0.3, 2),
                               {.clearance = random.uniform(0.001, 0.1), .self_collision = false});
    const Configuration q = random.configuration(arm);
    const Trajectory motion{
        arm.joint_names(), {0, 1}, {q, q + 0.1 * (random.configuration(arm) - q)}, {}, {}};
    ClearanceOptions options{.resolution = random.uniform(0.01, 1)};
    if (random.integer(0, 3) == 0) options.budget.max_work = random.integer(0, 3);
    const ClearanceProof proof = prove_clearance(model, motion, options);
    EXPECT_EQ(static_cast<bool>(proof), !proof.reason);
    refusals.add(proof.reason);
  }
  EXPECT_GE(refusals.kinds(), 3);
}

TEST(ReasonData, SayAllOfTheSentencesOfRecordings) {
  Random random;
  Refusals refusals;
  for (int i = 0; i < testing::cases(120); ++i) {
    const Arm arm = random_arm_of(random);
    Trajectory recording =
        move_joints(arm, random.configuration(arm), random.configuration(arm), {.rate = 20})
            .trajectory;
    const double faster = random.uniform(0.5, 4);
    ReplayOptions replayed{.speed = faster, .budget = random_budget(random)};
    if (random.integer(0, 1) == 0) replayed.rate = random.uniform(1, 50);
    refusals.add(replay(arm, recording, replayed).reason);
    RetimeOptions retimed{.budget = random_budget(random)};
    if (random.integer(0, 1) == 0) {
      retimed.rate = random.uniform(2, 100);
      retimed.max_samples = random.integer(2, 50);
    } else {
      retimed.duration = random.uniform(0.01, 1);
    }
    refusals.add(retime(arm, recording, retimed).reason);
    const Pose begin = forward_kinematics(arm, recording.positions.front());
    if (random.integer(0, 1) == 0) recording.positions[3] *= 1.5;
    refusals.add(
        verify(arm, recording, random_poses(random, arm, recording.positions.front())).reason);
    refusals.add(verify(arm, recording, {begin}).reason);
    refusals.add(control_joints(arm, recording.positions.front(), recording.positions.back(),
                                {.kp = random.uniform(0.001, 3)}, {.max_steps = 100})
                     .reason);
  }
  EXPECT_GE(refusals.kinds(), 5);
}

}  // namespace
}  // namespace beeline
