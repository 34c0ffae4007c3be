#pragma once

namespace beeline {

/// Equidistant angles at which a trigonometric polynomial is sampled.
struct CircleSamples {
  static constexpr int most = 32;
  int count = 0;  ///< more than the coefficients: the others tell the samples' error
  alignas(64) double cosine[most], sine[most];
  /// From values to coefficients: of cos kx in column k, of sin kx in count / 2 + k. In place of
  /// sin 0 there is cos count / 2 x.
  alignas(64) double transform[most][most];
};

struct CircleTables {
  static constexpr int usual_degree = 8;  ///< sixteen roots
  static constexpr int max_degree = 12;
  CircleSamples usual, most;
  static constexpr int grid = 256;
  /// Of k + 1 times the angle, over half a turn.
  alignas(64) double cosine[max_degree][grid / 2], sine[max_degree][grid / 2];
};
const CircleTables& circle_tables();

}  // namespace beeline
