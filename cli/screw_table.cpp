#include "screw_table.h"

#include <vector>

#include "format.h"

namespace beeline::command {
namespace {

/// One row for each joint: angular velocity, then linear velocity, as in Lynch & Park.
std::string rows(const Arm& arm, const std::vector<Twist>& twists) {
  std::vector<std::string> names;
  Eigen::MatrixXd matrix(static_cast<Eigen::Index>(twists.size()), 6);
  for (std::size_t i = 0; i < twists.size(); ++i) {
    names.push_back(arm.joints()[i].name);
    matrix.row(static_cast<Eigen::Index>(i)) << twists[i].tail<3>().transpose(),
        twists[i].head<3>().transpose();
  }
  return matrix_text(matrix, names);
}

}  // namespace

std::string screw_table(const Arm& arm) {
  return "\nspace screws S, in the world: wx wy wz vx vy vz, all joints at 0\n" +
         rows(arm, screws(arm, ScrewFrame::space)) +
         "\nbody screws B, in the tool: wx wy wz vx vy vz, all joints at 0\n" +
         rows(arm, screws(arm, ScrewFrame::body)) +
         "\nhome pose M of the tool in the world: T = exp(S1 q1) ... exp(Sn qn) M = M exp(B1 q1) "
         "... exp(Bn qn)\n" +
         matrix_text(home_pose(arm).matrix(), {"", "", "", ""});
}

Json screw_document(const Arm& arm) {
  const std::vector<Twist> space = screws(arm, ScrewFrame::space);
  const std::vector<Twist> body = screws(arm, ScrewFrame::body);
  Json joints = Json::list();
  for (std::size_t i = 0; i < space.size(); ++i) {
    const std::string& name = arm.joints()[i].name;
    joints.append(Json{
        {"name", name}, {"space", Eigen::VectorXd(space[i])}, {"body", Eigen::VectorXd(body[i])}});
  }
  const std::vector<std::string> rows{"vx", "vy", "vz", "wx", "wy", "wz"};
  return {{"rows", rows}, {"home", json_matrix(home_pose(arm).matrix())}, {"joints", joints}};
}

}  // namespace beeline::command
