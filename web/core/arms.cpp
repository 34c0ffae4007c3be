#include "arms.h"

#include <cli/arm_document.h>
#include <map>
#include <utility>

#include <beeline/io/text/arm.h>
#include <beeline/model/catalog.h>

#include "beeline.h"
#include "fault.h"
#include "handles.h"

namespace beeline::web {
namespace {

struct KnownArm {
  Arm arm;
  std::map<std::pair<bool, bool>, InverseSolver> solvers = {};  ///< by `all` and `ignore_limits`
};

Handles<KnownArm>& arms() {
  static Handles<KnownArm> handles("arm");
  return handles;
}

}  // namespace

const Arm& arm_of(int handle) { return arms().at(handle).arm; }

InverseSolver& solver_of(int handle, bool all, bool ignore_limits) {
  KnownArm& known = arms().at(handle);
  const std::pair options{all, ignore_limits};
  const auto found = known.solvers.find(options);
  if (found != known.solvers.end()) return found->second;
  // The default task by name: of a planar arm it ignores the height and tilt of a dragged tool.
  const InverseSolver solver(
      known.arm, {.task = default_task(known.arm), .all = all, .ignore_limits = ignore_limits});
  return known.solvers.emplace(options, solver).first->second;
}

}  // namespace beeline::web

using namespace beeline;
using web::arm_of;
using web::guarded;

int beeline_arm(const char* name, const char* text, const char* base, const char* tip) {
  return guarded([&] {
    const ChainEnds ends{.base = base, .tip = tip};
    const Arm arm = text == nullptr ? read_arm(name, ends) : arm_from_text(text, name, ends);
    return web::arms().add({arm});
  });
}

const char* beeline_arm_json(int arm) {
  return web::text([&] { return arm_to_json(arm_of(arm)); });
}

const char* beeline_arm_description(int arm) {
  return web::text([&] { return command::arm_document(arm_of(arm), false).text(); });
}

const char* beeline_built_in_names() {
  return web::text([] { return Json(built_in_names()).text(); });
}

int beeline_arm_release(int arm) {
  return guarded([&] { return web::arms().release(arm), 0; });
}

int beeline_arm_dof(int arm) {
  return guarded([&] { return arm_of(arm).dof(); });
}

int beeline_arm_links(int arm) {
  return guarded([&] { return static_cast<int>(arm_of(arm).joints().size()) + 1; });
}

int beeline_arm_planar(int arm) {
  return guarded([&] { return arm_of(arm).planar() ? 1 : 0; });
}
