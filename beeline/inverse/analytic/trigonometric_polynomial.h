#pragma once

namespace beeline::internal {

/// Equidistant angles at which a trigonometric polynomial is sampled, and the discrete Fourier
/// transform from the samples to the coefficients.
struct SampleAngles {
  static constexpr int max_count = 32;
  /// More than the number of coefficients: the others measure the error of the samples.
  int count = 0;
  alignas(64) double cosine[max_count], sine[max_count];
  /// Column k gives the coefficient of cos kx, and column count / 2 + k the coefficient of sin kx.
  /// The column of sin 0 gives the coefficient of cos(count / 2 x) instead.
  alignas(64) double transform[max_count][max_count];
};

/// Sample angles and a grid, computed once.
struct TrigonometricTables {
  static constexpr int usual_degree = 8;  ///< sixteen zeros
  static constexpr int max_degree = 12;
  SampleAngles usual, largest;  ///< 24 samples up to usual_degree, 32 up to max_degree
  static constexpr int grid = 256;
  /// cos and sin of (k + 1) x in row k, over half the grid.
  alignas(64) double cosine[max_degree][grid / 2], sine[max_degree][grid / 2];
};
const TrigonometricTables& trigonometric_tables();

}  // namespace beeline::internal
