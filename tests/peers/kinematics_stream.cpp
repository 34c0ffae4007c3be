// Usage: kinematics_stream FILE.urdf BASE TIP < configurations > kinematics
//
// Beeline's kinematics for another implementation to be compared with. The answer begins with one
// line of text, the names of the arm's coordinates with a tab between them. From there on both
// streams are doubles in the machine's own order: for each configuration and joint velocities read,
// the tool's pose as a 4 x 4 matrix by rows, then the Jacobians in base, tool and space frames,
// each 6 x dof by rows, then their time derivatives.
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include <beeline/io/text/arm.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/jacobian.h>

namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

void write(const Rows& matrix) {
  std::fwrite(matrix.data(), sizeof(double), static_cast<std::size_t>(matrix.size()), stdout);
}

void answer(const beeline::Arm& arm) {
  std::string names;
  for (const std::string& name : arm.joint_names()) names += (names.empty() ? "" : "\t") + name;
  std::printf("%s\n", names.c_str());

  constexpr beeline::Frame frames[] = {beeline::Frame::base, beeline::Frame::tool,
                                       beeline::Frame::space};
  std::vector<double> values(2 * static_cast<std::size_t>(arm.dof()));
  while (std::fread(values.data(), sizeof(double), values.size(), stdin) == values.size()) {
    const Eigen::Map<const Eigen::VectorXd> q(values.data(), arm.dof()),
        dq(values.data() + arm.dof(), arm.dof());
    write(beeline::forward_kinematics(arm, q).matrix());
    for (const auto frame : frames) write(beeline::jacobian(arm, q, frame));
    for (const auto frame : frames) write(beeline::jacobian_derivative(arm, q, dq, frame));
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: kinematics_stream FILE.urdf BASE TIP\n");
    return 2;
  }
  try {
    answer(beeline::read_arm(argv[1], {.base = argv[2], .tip = argv[3]}));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 3;
  }
}
