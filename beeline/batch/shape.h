#pragma once

#include <string>

#include <beeline/batch/batch.h>
#include <beeline/error.h>

namespace beeline {

template <class Matrix>
void check_rows(const Arm& arm, const std::string& name, const Matrix& matrix, Eigen::Index rows) {
  if (matrix.rows() == rows) return;
  throw Error(name + " has " + std::to_string(matrix.rows()) + " rows; arm " + arm.name() +
              " needs " + std::to_string(rows));
}

template <class Matrix>
void check_shape(const Arm& arm, const std::string& name, const Matrix& matrix, Eigen::Index rows,
                 Eigen::Index columns) {
  check_rows(arm, name, matrix, rows);
  if (matrix.cols() == columns) return;
  throw Error(name + " has " + std::to_string(matrix.cols()) + " columns, not " +
              std::to_string(columns) + ", one for each configuration");
}

}  // namespace beeline
