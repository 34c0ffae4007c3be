#include <cmath>

#include <beeline/inverse/analytic/trigonometric_polynomial.h>

namespace beeline::internal {
namespace {

/// Returns 2 pi k index / count.
double angle(int k, int index, int count) {
  return 6.283185307179586477 * (k * index % count) / count;
}

void fill(int count, SampleAngles& samples) {
  samples.count = count;
  for (int j = 0; j < count; ++j) {
    samples.cosine[j] = std::cos(angle(1, j, count));
    samples.sine[j] = std::sin(angle(1, j, count));
    for (int k = 0; k < count / 2; ++k) {
      samples.transform[j][k] = std::cos(angle(k, j, count)) * (k == 0 ? 1 : 2) / count;
      samples.transform[j][count / 2 + k] = std::sin(angle(k, j, count)) * 2 / count;
    }
    samples.transform[j][count / 2] = std::cos(angle(count / 2, j, count)) / count;
  }
}

TrigonometricTables make_tables() {
  TrigonometricTables tables;
  fill(24, tables.usual);
  fill(32, tables.largest);
  for (int k = 0; k < TrigonometricTables::max_degree; ++k) {
    for (int j = 0; j < TrigonometricTables::grid / 2; ++j) {
      tables.cosine[k][j] = std::cos(angle(k + 1, j, TrigonometricTables::grid));
      tables.sine[k][j] = std::sin(angle(k + 1, j, TrigonometricTables::grid));
    }
  }
  return tables;
}

}  // namespace

const TrigonometricTables& trigonometric_tables() {
  static const TrigonometricTables tables = make_tables();
  return tables;
}

}  // namespace beeline::internal
