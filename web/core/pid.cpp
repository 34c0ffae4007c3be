#include <beeline/control/joint.h>

#include "arms.h"
#include "beeline.h"
#include "fault.h"
#include "handles.h"

using namespace beeline;
using web::guarded;
using web::joint_values;

namespace {

struct Controller {
  Pid pid;
  int dof = 0;
};

web::Handles<Controller>& controllers() {
  static web::Handles<Controller> handles("PID controller");
  return handles;
}

}  // namespace

int beeline_pid(int dof, double kp, double ki, double kd, const double* q, const double* goal) {
  return guarded([&] {
    if (dof < 1) throw Error("dof is " + std::to_string(dof) + "; it is 1 or more");
    Controller controller{Pid({.kp = kp, .ki = ki, .kd = kd}, joint_values(goal, dof)), dof};
    controller.pid.start(joint_values(q, dof));
    return controllers().add(std::move(controller));
  });
}

int beeline_pid_step(int pid, double* q) {
  return guarded([&] {
    Controller& controller = controllers().at(pid);
    Eigen::Map<Configuration> values(q, controller.dof);
    values += controller.pid.step(joint_values(q, controller.dof));
    return 0;
  });
}

int beeline_pid_release(int pid) {
  return guarded([&] { return controllers().release(pid), 0; });
}
