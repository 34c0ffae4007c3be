#include <cli/line_report.h>
#include <gtest/gtest.h>

#include <beeline/model/catalog.h>

namespace beeline::command {
namespace {

LineReport report_of(const Program& program, ProgramMotion motion) {
  return {.method = "exact",
          .waypoints = program.moves.size(),
          .status = motion.status,
          .trajectory = motion.trajectory,
          .deviation = motion.deviation,
          .limits = motion.limits,
          .program = program,
          .moves = motion.moves,
          .search_ending = motion.search_ending};
}

TEST(LineReport, SaysThatTheBudgetEndedTheSearchForBlends) {
  const Arm arm = built_in("rrr");
  Program program;
  for (const double q : {0.5, 1.0, 0.2, -0.3}) {
    program.moves.push_back(
        {.kind = MoveKind::joint, .q = Configuration{{q, 1, q}}, .blend = 0.05});
  }
  program.moves.back().blend = 0;
  const Configuration start{{0, 0.8, 0.1}};
  int ended = 0;
  for (std::int64_t work = 64; work < (1 << 22); work += work / 4) {
    PathMotionOptions options;
    options.budget.max_work = work;
    const ProgramMotion motion = move_program(arm, start, program, options);
    if (!motion) continue;
    const bool complete = motion.search_ending == Ending::complete;
    const LineReport report = report_of(program, motion);
    const std::string line = "blends        the limit of work ended the search; allow more work";
    EXPECT_EQ(report_text(arm, report, {}, {}).find(line) == std::string::npos, complete);
    const std::string json = report_document(arm, report, {}, {}).text();
    EXPECT_NE(json.find(complete ? "\"search_ending\": \"complete\""
                                 : "\"search_ending\": \"work_limit\""),
              std::string::npos);
    if (complete) break;
    ++ended;
  }
  EXPECT_GT(ended, 0);
}

}  // namespace
}  // namespace beeline::command
