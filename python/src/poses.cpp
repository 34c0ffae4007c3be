#include <beeline/pose/angle.h>
#include <beeline/pose/orientation.h>

#include "bindings.h"
#include "signature.h"

namespace beeline::python {
namespace {

Vector3 position_from(nb::handle value) { return Value<Vector3>::from(value, "position"); }

Eigen::VectorXd numbers_from(nb::handle value, const char* name, Index count) {
  Eigen::VectorXd numbers = Value<Eigen::VectorXd>::from(value, name);
  if (numbers.size() != count) {
    throw Error(std::string(name) + " has " + std::to_string(numbers.size()) +
                " values; expected " + std::to_string(count));
  }
  if (!numbers.allFinite()) throw Error(std::string(name) + " has a value that is not finite");
  return numbers;
}

}  // namespace

void bind_poses(nb::module_& m) {
  (void)position_from;
  (void)numbers_from;
  (void)m;
}

}  // namespace beeline::python
