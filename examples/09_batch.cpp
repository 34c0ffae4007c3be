// Batches: a million configurations of a Panda, their tool poses, and inverse kinematics of some.
#include <iostream>

#include <beeline/batch/batch.h>
#include <beeline/model/catalog.h>

int main() {
  const beeline::Arm panda = beeline::built_in("panda");
  const Eigen::VectorXd middle = middle_configuration(panda);
  Eigen::MatrixXd q = Eigen::MatrixXd::Random(panda.dof(), 1'000'000);  // in [-1, 1]
  q = (0.5 * q).colwise() + middle;

  const beeline::BatchOptions options{.layout = beeline::PoseLayout::position_quaternion};
  Eigen::MatrixXd poses(size(options.layout), q.cols());  // x y z qw qx qy qz in each column
  beeline::batch_forward<double>(panda, q, poses, options);
  std::cout << "mean height of the tool " << poses.row(2).mean() << " m\n";

  const Eigen::Index count = 1000;
  Eigen::MatrixXd solutions(panda.dof(), count);
  const beeline::BatchResult result = beeline::batch_inverse(
      panda, poses.leftCols(count), q.leftCols(count), solutions, {}, options);
  Eigen::MatrixXd again(poses.rows(), count);
  beeline::batch_forward<double>(panda, solutions, again, options);
  const double error = (again - poses.leftCols(count)).topRows(3).cwiseAbs().maxCoeff();
  std::cout << result.solved << " of " << count << " solved, error at most " << error << " m\n";
  return result.solved == count && error < 1e-9 ? 0 : 1;
}
