#include <beeline/math/decompositions.h>

template class Eigen::ColPivHouseholderQR<Eigen::Matrix3d>;
template class Eigen::ColPivHouseholderQR<Eigen::MatrixXd>;
template class Eigen::JacobiSVD<Eigen::MatrixXd>;
template class Eigen::PartialPivLU<Eigen::Matrix<double, 6, 6>>;
