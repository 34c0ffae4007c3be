#include <algorithm>
#include <gtest/gtest.h>
#include <random>
#include <thread>
#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/model/internal/chain.h>

#include <tests/inverse/answer.h>
#include <tests/random_arm.h>

// What inverse kinematics keeps with an arm: it costs memory and time, and changes no answer.

namespace beeline {
namespace {

constexpr std::size_t max_bytes_of_arm = 64 * 1024;

/// The same arm, which keeps nothing yet.
Arm fresh(const Arm& arm) {
  return {arm.name(), arm.joints(), arm.tool(), arm.base(), arm.controller()};
}

Arm general_arm(testing::Random& random, int joints) {
  std::vector<Joint> all;
  for (int i = 0; i < joints; ++i) {
    all.push_back(testing::random_joint(random, JointKind::revolute, "j" + std::to_string(i + 1)));
  }
  return {"general", all, random.pose(), random.pose()};
}

/// An answer of either form of inverse_kinematics().
struct Answer {
  InverseResult result;
  Eigen::MatrixXd columns;
  bool operator==(const Answer& other) const {
    const InverseResult &a = result, &b = other.result;
    const bool same_nearest = a.nearest.has_value() == b.nearest.has_value() &&
                              (!a.nearest || a.nearest->q == b.nearest->q);
    return a.status == b.status && a.solutions == b.solutions && a.complete == b.complete &&
           a.residual == b.residual && a.reason == b.reason && a.method == b.method &&
           a.iterations == b.iterations && a.restarts == b.restarts && same_nearest &&
           columns == other.columns;
  }
};

struct Question {
  std::size_t arm = 0;
  Pose world_T_tool;
  Configuration seed;
  InverseOptions options = {};
  bool into_columns = false;

  Answer answer(const Arm& of) const {
    if (!into_columns) {
      InverseOptions with_seed = options;
      with_seed.seed = seed;
      return {testing::explained_inverse(of, world_T_tool, with_seed), {}};
    }
    Eigen::MatrixXd columns(of.dof(), options.all ? 8 : 1);
    const int count = inverse_kinematics(of, world_T_tool, seed, columns, options);
    return {{}, columns.leftCols(count)};
  }
};

/// Options that need different parts of what is kept.
std::vector<InverseOptions> many_options(const Arm& arm) {
  const int last = arm.dof() - 1;
  std::vector<InverseOptions> all{
      {},
      {.all = true, .grid = 4, .max_restarts = 8},
      {.method = InverseMethod::numerical, .max_restarts = 20},
      {.ignore_limits = true},
      {.method = InverseMethod::numerical, .ignore_limits = true, .random_seed = 3},
      {.task = Task::position(), .max_restarts = 20},
      {.max_restarts = 20, .random_seed = 2},
      {.redundancy = Redundancy::nearest, .grid = 4},
      {.grid = 4, .max_restarts = 20, .budget = {.max_work = 40}}};
  if (arm.dof() > 1) {
    all.push_back({.lock = last});
    all.push_back({.all = true, .lock = last / 2, .max_restarts = 8});
  }
  all.push_back(
      {.pose_tolerance = Eigen::VectorXd::Constant(arm.planar() ? 3 : 6, 0.01), .max_restarts = 8});
  return all;
}

std::vector<Question> questions(const std::vector<Arm>& arms, testing::Random& random) {
  std::vector<Question> all;
  for (std::size_t i = 0; i < arms.size(); ++i) {
    for (const InverseOptions& options : many_options(arms[i])) {
      Pose pose = forward_kinematics(arms[i], random.configuration(arms[i]));
      if (random.integer(0, 3) == 0) pose.translation().x() += 0.7;
      all.push_back({i, pose, random.configuration(arms[i]), options, random.integer(0, 1) == 1});
    }
  }
  return all;
}

std::vector<Arm> arms_of_all_families(testing::Random& random) {
  std::vector<Arm> arms;
  for (const char* name : {"rrr", "ur5", "panda", "scara"}) arms.push_back(fresh(built_in(name)));
  arms.push_back(general_arm(random, 6));
  if (!testing::slow_build) arms.push_back(general_arm(random, 7));
  return arms;
}

/// Answers in a thread that has no memory of others, by arms that keep nothing.
std::vector<Answer> fresh_answers(const std::vector<Arm>& arms,
                                  const std::vector<Question>& questions) {
  std::vector<Answer> answers(questions.size());
  for (std::size_t i = 0; i < questions.size(); ++i) {
    std::thread([&] { answers[i] = questions[i].answer(fresh(arms[questions[i].arm])); }).join();
  }
  return answers;
}

std::vector<std::size_t> shuffled(std::size_t count, unsigned seed) {
  std::vector<std::size_t> order(2 * count);  // each twice
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i % count;
  std::shuffle(order.begin(), order.end(), std::mt19937_64(seed));
  return order;
}

TEST(KeptByArm, NoAnswerDependsOnEarlierQuestions) {
  testing::Random random;
  const std::vector<Arm> arms = arms_of_all_families(random);
  const std::vector<Question> asked = questions(arms, random);
  const std::vector<Answer> expected = fresh_answers(arms, asked);
  for (unsigned round = 0; round < 3; ++round) {
    for (const std::size_t i : shuffled(asked.size(), round)) {
      EXPECT_EQ(asked[i].answer(arms[asked[i].arm]), expected[i])
          << "question " << i << " of arm " << arms[asked[i].arm].name() << ", round " << round;
    }
  }
}

TEST(KeptByArm, ThreadsMayAskFirstWhileCopiesAreDestroyed) {
  testing::Random random;
  const std::vector<Arm> arms = arms_of_all_families(random);
  const std::vector<Question> asked = questions(arms, random);
  const std::vector<Answer> expected = fresh_answers(arms, asked);
  for (unsigned round = 0; round < (testing::slow_build ? 1 : 2); ++round) {
    std::vector<Arm> shared;
    for (const Arm& arm : arms) shared.push_back(fresh(arm));
    std::vector<std::thread> threads;
    for (unsigned t = 0; t < 8; ++t) {
      threads.emplace_back([&, t, copies = shared]() mutable {
        for (const std::size_t i : shuffled(asked.size(), 8 * round + t)) {
          const Arm copy = copies[asked[i].arm];
          EXPECT_EQ(asked[i].answer(copy), expected[i]) << "question " << i << ", thread " << t;
          if (i % 7 == t) copies[asked[i].arm] = fresh(copy);  // the thread's copy ends here
        }
      });
    }
    shared.clear();
    for (std::thread& thread : threads) thread.join();
  }
}

std::size_t bytes_kept(const Arm& arm) {
  const internal::ArmMemory& memory = internal::ArmMemory::of(arm);
  return memory.of_arm.bytes() + memory.of_geometry->bytes() + memory.of_links->bytes();
}

void ask_all(const Arm& arm, testing::Random& random) {
  for (const Question& question : questions({arm}, random)) question.answer(arm);
}

TEST(KeptByArm, AnArmKeepsAtMost64Kilobytes) {
  testing::Random random;
  std::vector<Arm> arms;
  for (const std::string& name : built_in_names()) arms.push_back(fresh(built_in(name)));
  arms.push_back(testing::random_arm(random, 12, 4));
  if (testing::slow_build) arms.erase(arms.begin() + 3, arms.end());
  std::size_t most = 0;
  for (const Arm& arm : arms) {
    ask_all(arm, random);
    EXPECT_GT(bytes_kept(arm), 1000) << arm.name();
    EXPECT_LE(bytes_kept(arm), max_bytes_of_arm) << arm.name();
    most = std::max(most, bytes_kept(arm));
  }
  std::cout << "most of " << arms.size() << " arms: " << most << " bytes\n";
}

#if defined(__GLIBC__) && !defined(BEELINE_SANITIZED)
TEST(KeptByArm, CountsTheMemoryThatItAllocates) {
  for (const char* name : {"ur5", "panda", "rrr"}) {
    const Arm first = fresh(built_in(name)), arm = fresh(first);
    constexpr std::size_t slack = 4096;  // malloc counts some memory that is free as used
    const auto ask = [&](const Arm& of) {
      for (const InverseMethod method : {InverseMethod::automatic, InverseMethod::numerical}) {
        inverse_kinematics(of, forward_kinematics(of, middle_configuration(of)),
                           {.seed = Configuration::Constant(of.dof(), 0.1), .method = method});
      }
    };
    ask(first);  // sizes what the thread keeps
    const std::size_t before = mallinfo2().uordblks, counted_before = bytes_kept(arm);
    ask(arm);
    const std::size_t allocated = mallinfo2().uordblks - before;
    const std::size_t counted = bytes_kept(arm) - counted_before;
    EXPECT_LE(allocated, counted + slack) << name;
    EXPECT_GE(allocated + slack, counted) << name;
  }
}

TEST(KeptByArm, TenThousandArmsDoNotAddUp) {
  testing::Random random;
  const Arm panda = built_in("panda"), ur5 = built_in("ur5"), rrr = built_in("rrr");
  const auto ask = [&](int count) {
    for (int i = 0; i < count; ++i) {
      const Arm& model = i % 3 == 0 ? panda : i % 3 == 1 ? ur5 : rrr;
      const double length = random.uniform(0, 0.2);
      const Arm arm = with_tool(model, make_pose(Vector3(length, 0, 0)));
      const Pose pose = forward_kinematics(arm, random.configuration(arm));
      Eigen::MatrixXd q(arm.dof(), 1);
      inverse_kinematics(arm, pose, middle_configuration(arm), q, {.ignore_limits = i % 2 == 0});
      if (i % 50 < 3) inverse_kinematics(arm, pose, {.ignore_limits = true, .lock = i % 3});
    }
  };
  ask(300);  // sizes what the thread keeps
  const std::size_t before = mallinfo2().uordblks;
  ask(10'000);
  EXPECT_LT(mallinfo2().uordblks, before + 1'000'000);  // 100 bytes for each
}
#endif

/// An arm made of another shares what does not depend on the change, and answers as if it did not.
TEST(KeptByArm, ArmsMadeOfOthersShareWhatTheyHaveInCommon) {
  testing::Random random;
  const Arm arm = general_arm(random, 6);
  inverse_kinematics(arm, forward_kinematics(arm, random.configuration(arm)), {.all = true});
  const auto& memory = internal::ArmMemory::of(arm);
  const std::size_t geometry = memory.of_geometry->bytes(), links = memory.of_links->bytes();
  const Arm limited = with_limits(arm, {{"j1", {.lower = -1.0, .upper = 1.0}}});
  const Arm slow = with_speed_scale(arm, 0.5), with_other_tool = with_tool(arm, random.pose());
  const Arm mounted = with_mount(arm, random.pose());
  for (const Arm* other : {&limited, &slow, &with_other_tool, &mounted}) {
    const auto& shared = internal::ArmMemory::of(*other);
    EXPECT_EQ(shared.of_links == memory.of_links, other != &mounted);
    EXPECT_EQ(shared.of_geometry == memory.of_geometry, other == &limited || other == &slow);
    for (const InverseOptions& options : many_options(arm)) {
      const Pose pose = forward_kinematics(*other, random.configuration(*other));
      const Question question{0, pose, random.configuration(arm), options};
      EXPECT_EQ(question.answer(*other), question.answer(fresh(*other)));
    }
  }
  EXPECT_EQ(memory.of_links->bytes(), links);  // nothing was computed again
  EXPECT_GT(links, sizeof(internal::KeptObjects));
  EXPECT_GT(geometry, sizeof(internal::KeptObjects));
}

}  // namespace
}  // namespace beeline
