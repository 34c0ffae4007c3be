#include <tests/reason/said.h>

namespace beeline::testing {
namespace {

/// A body that a held joint carries; `bodies` are the fields of its pair.
std::vector<Said> said_of_held_bodies(const Fields& bodies) {
  using enum ReasonField;
  return {
      {{ReasonCode::bodies_too_close,
        with(bodies,
             {{distance, 0.0004}, {held_body, "hand"}, {held_joint, "slide"}, {held_value, 0.02}})},
       "at 0.5 s hand is 0.0004 m from table at (0.1, 0, 0.3) m, closer than the clearance of "
       "0.001 m; hand is carried by joint slide, held at 0.02; the option hold sets another value, "
       "slide=VALUE"},
      {{ReasonCode::bodies_collide, with(bodies, {{depth, 0.012},
                                                  {normal, Eigen::Vector3d(0, 0, 1)},
                                                  {held_body, "table"},
                                                  {held_joint, "slide"},
                                                  {held_value, 0.0}})},
       "at 0.5 s hand and table collide at (0.1, 0, 0.3) m: a translation of hand by 0.012 m "
       "along (0, 0, 1) would separate them; table is carried by joint slide, held at 0; the "
       "option hold sets another value, slide=VALUE"},
  };
}

}  // namespace

std::vector<Said> said_of_clearances() {
  using enum ReasonField;
  const Fields bodies{{body, "hand"},
                      {other_body, "table"},
                      {clearance, 0.001},
                      {time, 0.5},
                      {position, Eigen::Vector3d(0.1, 0, 0.3)}};
  const Fields of_configuration{{body, "hand"}, {other_body, "table"}, {clearance, 0.001}};
  const Reason close{ReasonCode::bodies_too_close,
                     {{body, "hand"},
                      {other_body, "table"},
                      {clearance, 0.01},
                      {distance, 0.004},
                      {position, Eigen::Vector3d(0.1, 0, 0.3)}}};
  const std::string said_close =
      "hand is 0.004 m from table at (0.1, 0, 0.3) m, closer than the clearance of 0.01 m";
  std::vector<Said> said{
      {{ReasonCode::all_solutions_blocked, {{count, std::size_t{8}}}, {close}},
       "every solution is blocked, 8 in all; the first: " + said_close},
      {{ReasonCode::solutions_blocked, {{count, std::size_t{90}}}, {close}},
       "every solution that was found is blocked, 90 in all; the first: " + said_close +
           "; others may exist"},
      {{ReasonCode::clearance_not_decided, with(of_configuration, {{distance, 0.001}})},
       "hand is about 0.001 m from table, too near to the clearance of 0.001 m to decide"},
      {{ReasonCode::bodies_too_close,
        with(of_configuration, {{distance, 0.0004}, {position, Eigen::Vector3d(0.1, 0, 0.3)}})},
       "hand is 0.0004 m from table at (0.1, 0, 0.3) m, closer than the clearance of 0.001 m"},
      {{ReasonCode::bodies_collide,
        with(bodies, {{depth, 0.012}, {normal, Eigen::Vector3d(0, 0, 1)}})},
       "at 0.5 s hand and table collide at (0.1, 0, 0.3) m: a translation of hand by 0.012 m "
       "along (0, 0, 1) would separate them"},
      {{ReasonCode::bodies_too_close,
        with(of_configuration, {{distance, 0.0004},
                                {position, Eigen::Vector3d(0.1, 0, 0.3)},
                                {search_ending, Ending::time_limit}})},
       "hand is 0.0004 m from table at (0.1, 0, 0.3) m, closer than the clearance of 0.001 m; the "
       "time limit ended the search for another motion"},
      {{ReasonCode::bodies_too_close, with(bodies, {{distance, 0.0004}})},
       "at 0.5 s hand is 0.0004 m from table at (0.1, 0, 0.3) m, closer than the clearance of "
       "0.001 m"},
      {{ReasonCode::bodies_too_close,
        with(bodies, {{distance, 0.0004}, {move, std::size_t{4}}, {move_name, "move 4 (line)"}})},
       "move 4 (line), at 0.5 s: hand is 0.0004 m from table at (0.1, 0, 0.3) m, closer than the "
       "clearance of 0.001 m"},
      {{ReasonCode::clearance_not_decided,
        with(bodies, {{distance, 0.00101}, {begin, 0.49}, {end, 0.51}})},
       "between 0.49 s and 0.51 s hand is about 0.00101 m from table, too near to the clearance of "
       "0.001 m to decide; a smaller clearance or a finer resolution decides"},
      {{ReasonCode::start_not_free, {}, {close}}, "at the start " + said_close},
      {{ReasonCode::goal_not_free, {{count, std::size_t{1}}}, {close}},
       "at the goal " + said_close},
      {{ReasonCode::goal_not_free, {{count, std::size_t{8}}}, {close}},
       "at each of the 8 goals a limit or a clearance is not kept; at the first " + said_close},
      {{ReasonCode::no_free_path, {{count, std::size_t{900}}}},
       "no path was found that keeps the clearance, with 900 straight joint motions; one may "
       "exist"},
  };
  for (Said& row : said_of_held_bodies(bodies)) said.push_back(std::move(row));
  return said;
}

}  // namespace beeline::testing
