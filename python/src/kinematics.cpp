#include <array>

#include <beeline/batch/batch.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/jacobian.h>

#include "bindings.h"
#include "signature.h"

namespace beeline::python {
namespace {

nb::object forward(const Arm& arm, nb::handle q, nb::handle out) {
  const InputArray values(q, "q", true);
  if (values.dimensions() == 1) {
    const ConfigurationRef ref(std::span(values.data(), static_cast<std::size_t>(values.size())));
    const Pose pose = forward_kinematics(arm, ref);
    if (out.is_none()) {
      NewArray array({4, 4});
      write_pose(pose, array.data());
      return array.release();
    }
    const Index shape[] = {4, 4};
    OutputArray array(out, "out", shape, Real::float64);
    write_pose(pose, array.data());
    return array.finish();
  }
  return nb::none();
}

}  // namespace

void bind_kinematics(nb::module_& m) {
  const Signature s = Signature("forward_kinematics", array_type, "Returns world_T_tool.")
                          .takes("arm", "Arm", "The arm.")
                          .takes("q", array_like, "Configuration.")
                          .keywords()
                          .takes("out", "None", "", "None");
  m.def("forward_kinematics", &forward, nb::arg("arm"), nb::arg("q"), nb::kw_only(),
        nb::arg("out") = nb::none(), nb::sig(s.text()), s.doc());
}

}  // namespace beeline::python
