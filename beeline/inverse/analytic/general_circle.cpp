#include <cmath>

#include <beeline/inverse/analytic/general_circle.h>

namespace beeline {
namespace {

double angle(int k, int step, int steps) {
  return 6.283185307179586477 * (k * step % steps) / steps;
}

void fill(int count, CircleSamples& samples) {
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

CircleTables make_tables() {
  CircleTables tables;
  fill(24, tables.usual);
  fill(32, tables.most);
  for (int k = 0; k < CircleTables::max_degree; ++k) {
    for (int j = 0; j < CircleTables::grid / 2; ++j) {
      tables.cosine[k][j] = std::cos(angle(k + 1, j, CircleTables::grid));
      tables.sine[k][j] = std::sin(angle(k + 1, j, CircleTables::grid));
    }
  }
  return tables;
}

}  // namespace

const CircleTables& circle_tables() {
  static const CircleTables tables = make_tables();
  return tables;
}

}  // namespace beeline
