#pragma once

#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

// Compiled once, in decompositions.cpp: a file that compiles its own takes up to 7 s longer. The
// determinant of a 6 x 6 matrix is computed by its PartialPivLU.
extern template class Eigen::ColPivHouseholderQR<Eigen::Matrix3d>;
extern template class Eigen::ColPivHouseholderQR<Eigen::MatrixXd>;
extern template class Eigen::JacobiSVD<Eigen::MatrixXd>;
extern template class Eigen::PartialPivLU<Eigen::Matrix<double, 6, 6>>;
