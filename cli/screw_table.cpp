#include "screw_table.h"

#include <vector>

#include <beeline/pose/se3.h>

#include "format.h"

namespace beeline::command {
namespace {

/// An arm at zero joint values. Twists are [v w].
struct HomeScrews {
  Pose home = Pose::Identity();  ///< of the tool in the world
  std::vector<Twist> space = {}, body = {};
};

HomeScrews home_screws(const Arm& arm) {
  HomeScrews found{.home = arm.base()};
  for (const Joint& joint : arm.joints()) {
    found.home = found.home * joint.offset;
    found.space.push_back(adjoint(found.home, joint.screw));
  }
  found.home = found.home * arm.tool();
  for (const Twist& screw : found.space) {
    found.body.push_back(adjoint(found.home.inverse(), screw));
  }
  return found;
}

/// One row for each joint: angular velocity, then linear velocity, as in Lynch & Park.
std::string rows(const Arm& arm, const std::vector<Twist>& screws) {
  std::vector<std::string> names;
  Eigen::MatrixXd matrix(static_cast<Eigen::Index>(screws.size()), 6);
  for (std::size_t i = 0; i < screws.size(); ++i) {
    names.push_back(arm.joints()[i].name);
    matrix.row(static_cast<Eigen::Index>(i)) << screws[i].tail<3>().transpose(),
        screws[i].head<3>().transpose();
  }
  return matrix_text(matrix, names);
}

}  // namespace

std::string screw_table(const Arm& arm) {
  const HomeScrews screws = home_screws(arm);
  return "\nspace screws S, in the world: wx wy wz vx vy vz, all joints at 0\n" +
         rows(arm, screws.space) +
         "\nbody screws B, in the tool: wx wy wz vx vy vz, all joints at 0\n" +
         rows(arm, screws.body) +
         "\nhome pose M of the tool in the world: T = exp(S1 q1) ... exp(Sn qn) M = M exp(B1 q1) "
         "... "
         "exp(Bn qn)\n" +
         matrix_text(screws.home.matrix(), {"", "", "", ""});
}

Json screw_document(const Arm& arm) {
  const HomeScrews screws = home_screws(arm);
  Json joints = Json::list();
  for (std::size_t i = 0; i < screws.space.size(); ++i) {
    const std::string& name = arm.joints()[i].name;
    joints.append(Json{{"name", name},
                       {"space", Eigen::VectorXd(screws.space[i])},
                       {"body", Eigen::VectorXd(screws.body[i])}});
  }
  const std::vector<std::string> rows{"vx", "vy", "vz", "wx", "wy", "wz"};
  return {{"rows", rows}, {"home", json_matrix(screws.home.matrix())}, {"joints", joints}};
}

}  // namespace beeline::command
