#include "arms.h"

#include <cli/arm_document.h>

#include <beeline/io/text/arm.h>
#include <beeline/model/catalog.h>

#include "beeline.h"
#include "fault.h"
#include "handles.h"

namespace beeline::web {
namespace {

Handles<Arm>& arms() {
  static Handles<Arm> handles("arm");
  return handles;
}

}  // namespace

const Arm& arm_of(int handle) { return arms().at(handle); }

}  // namespace beeline::web

using namespace beeline;
using web::arm_of;
using web::guarded;

int beeline_arm(const char* name, const char* text, const char* base, const char* tip) {
  return guarded([&] {
    const ChainEnds ends{.base = base, .tip = tip};
    const Arm arm = text == nullptr ? read_arm(name, ends) : arm_from_text(text, name, ends);
    return web::arms().add(arm);
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
