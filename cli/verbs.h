#pragma once

#include <vector>

#include "command/verb.h"

namespace beeline::command {

/// The verbs of the command, in the order of its overview.
std::vector<Verb> all_verbs();

/// One function for each verb, each in the file of its name.
Verb arms_verb();
Verb show_verb();
Verb fk_verb();
Verb jacobian_verb();
Verb ik_verb();
Verb batch_verb();
Verb move_verb();
Verb line_verb();
Verb check_verb();
Verb retime_verb();
Verb replay_verb();
Verb diff_verb();
Verb export_verb();
Verb draw_verb();
Verb figure_verb();
Verb formula_verb();
Verb doctor_verb();
Verb reach_verb();
Verb view_verb();

/// The parts of reach, except merge, which is in reach.cpp.
Verb reach_map_verb();
Verb reach_query_verb();
Verb reach_slice_verb();
Verb reach_export_verb();
Verb reach_compare_verb();
Verb reach_place_verb();

}  // namespace beeline::command
