#include <gtest/gtest.h>
#include <set>

#include <beeline/control/player.h>
#include <beeline/internal/enum_names.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/planning/move_along.h>
#include <beeline/reason.h>

#include <tests/reason/said.h>
#include <tests/refusal.h>

namespace beeline::testing {

std::vector<Said> said_of_searches() {
  using enum ReasonField;
  const std::string ended = "the time limit ended the search", more = "; allow more time";
  return {
      {{ReasonCode::ended, late}, ended + more},
      {{ReasonCode::ended, {{ending, Ending::cancelled}}}, "the search was cancelled"},
      {{ReasonCode::ended, {{ending, Ending::work_limit}}},
       "the limit of work ended the search; allow more work"},
      {{ReasonCode::ended_before_solution, with(late, {{distance, 0.1}})},
       ended + " before a solution was found; the nearest misses by 0.1 m" + more},
      {{ReasonCode::ended_before_all_solutions, with(late, {{count, std::size_t{3}}})},
       ended + " after 3 solution(s); others may exist" + more},
      {{ReasonCode::ended_before_best_solution, late},
       ended + " before the best solution was known; the one given is the best so far" + more},
      {{ReasonCode::ended_on_path, late}, ended + more},
      {{ReasonCode::ended_on_path, with(late, {{fraction, 1.0}})},
       ended + " after it had followed the whole path" + more},
      {{ReasonCode::ended_on_path, with(late, stop)},
       ended + " after it had followed line 2 of 3 to 63.1 %" + more},
      {{ReasonCode::ended_before_free_path, with(late, {{count, std::size_t{40}}})},
       ended +
           " before a path was found that keeps the clearance, after 40 straight joint motions" +
           more},
      {{ReasonCode::ended_before_timing, late},
       ended + " after the whole path was planned, before the motion was timed and proved" + more},
      {{ReasonCode::ended_before_check, late},
       ended + " before the whole trajectory was checked" + more},
      {{ReasonCode::ended_before_sampling, late}, ended + " before the motion was sampled" + more},
      {{ReasonCode::ended_before_samples, late},
       ended + " before samples within the limits were found" + more},
      {{ReasonCode::ended_in_simulation, with(late, {{step, std::size_t{7}}, {error, 0.5}})},
       ended + " after 7 steps, with an error of 0.5" + more},
      {{ReasonCode::ended_in_retiming, with(late, {{count, std::size_t{1}}, {of, std::size_t{3}}})},
       ended + " after 1 of 3 sections between stops" + more},
      {{ReasonCode::ended_in_batch, with(late, {{count, std::size_t{9}}, {without_file, true}})},
       ended + " after 9 rows; no file is written" + more},
      {{ReasonCode::ended_in_map, with(late, {{parts, "map.h5.parts"}})},
       ended +
           ": the slabs computed so far are in map.h5.parts; the same command continues, with a "
           "larger limit if it has completed no slab"},
  };
}

namespace {

TEST(Sentence, SaysWhatAReasonMeans) {
  std::set<ReasonCode> seen{ReasonCode::none};
  for (const auto& group : {said_of_searches(), said_of_inverse_kinematics(), said_of_paths(),
                            said_of_times(), said_of_trajectories(), said_of_clearances(),
                            said_of_control(), said_of_reach(), said_near_singularities()}) {
    for (const Said& said : group) {
      EXPECT_EQ(sentence(said.reason), said.sentence) << name(said.reason.code);
      seen.insert(said.reason.code);
    }
  }
  for (std::size_t code = 0; code < internal::EnumNames<ReasonCode>::count; ++code) {
    const auto unseen = static_cast<ReasonCode>(code);
    EXPECT_TRUE(seen.contains(unseen)) << name(unseen);
    EXPECT_EQ(reason_code_named(name(unseen)), unseen);
  }
}

// A reason that a program made may lack what its sentence needs.
TEST(Sentence, RefusesAReasonThatLacksAFieldOrADetail) {
  for (std::size_t number = 1; number < internal::EnumNames<ReasonCode>::count; ++number) {
    const auto code = static_cast<ReasonCode>(number);
    for (const Fields& fields : {Fields(), stop}) {
      try {
        EXPECT_NE(sentence({code, fields}), "") << name(code);
      } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find(name(code)), std::string::npos) << error.what();
      }
    }
  }
  for (const ReasonCode code :
       {ReasonCode::ended_at_pose, ReasonCode::pose_outside_limits,
        ReasonCode::path_leaves_workspace, ReasonCode::path_loses_orientation,
        ReasonCode::no_configuration_found, ReasonCode::all_solutions_blocked,
        ReasonCode::solutions_blocked}) {
    EXPECT_REFUSED(sentence({code}), name(code) + " needs details");
  }
  EXPECT_THROW(name(static_cast<ReasonCode>(100'000)), std::out_of_range);
}

TEST(Sentence, StandsInTheErrorOfALimit) {
  const Arm arm = built_in("panda");
  const Configuration q = Configuration::Zero(7);  // joint4 is below 0
  EXPECT_REFUSED(move_in_lines(arm, q, {forward_kinematics(arm, q)}),
                 "the motion cannot start: joint joint4 at 0 rad");
  EXPECT_REFUSED(Player(arm, at_rest(arm, q), middle_configuration(arm)), "at 0 s joint joint4");
}

TEST(Reason, HasAFieldOnce) {
  using enum ReasonField;
  Reason reason{ReasonCode::ended, {{ending, Ending::cancelled}}};
  reason.set(ending, Ending::time_limit).set(count, std::size_t{2});
  EXPECT_EQ(reason.fields.size(), 2);
  EXPECT_EQ(std::get<Ending>(*reason.find(ending)), Ending::time_limit);
  EXPECT_FALSE(reason.has(arm));
  EXPECT_TRUE(reason && !Reason() && sentence(Reason()).empty());
  EXPECT_EQ(reason_field_named("move_name"), move_name);
  EXPECT_REFUSED(reason_field_named("speedy"), "speed");
  for (std::size_t number = 0; number < internal::EnumNames<ReasonField>::count; ++number) {
    const auto field = static_cast<ReasonField>(number);
    EXPECT_EQ(reason_field_named(name(field)), field);
    EXPECT_NO_THROW(default_value(field));
  }
}

}  // namespace
}  // namespace beeline::testing
