#include "verbs.h"

namespace beeline::command {

std::vector<Verb> all_verbs() {
  std::vector<Verb> verbs{
      arms_verb(),   show_verb(), fk_verb(),     jacobian_verb(), ik_verb(),     batch_verb(),
      move_verb(),   line_verb(), check_verb(),  retime_verb(),   replay_verb(), diff_verb(),
      export_verb(), draw_verb(), figure_verb(), formula_verb(),  doctor_verb()};
#ifdef BEELINE_HDF5
  verbs.push_back(reach_verb());
#endif
#ifdef BEELINE_VIEW
  verbs.push_back(view_verb());
#endif
  return verbs;
}

}  // namespace beeline::command
