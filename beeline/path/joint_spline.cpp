#include <beeline/error.h>
#include <beeline/path/joint_spline.h>

namespace beeline {
namespace {

/// The slopes at the samples of the spline of four samples or more: the tridiagonal system of de
/// Boor's eq. IV (12), by elimination. Its ends' rows are not-a-knot.
std::vector<Configuration> spline_slopes(std::span<const Configuration> q,
                                         std::span<const double> s) {
  const std::size_t last = q.size() - 1;
  std::vector<double> h(last), upper(last);
  std::vector<Configuration> chord(last), slopes(last + 1);
  for (std::size_t k = 0; k < last; ++k) {
    h[k] = s[k + 1] - s[k];
    chord[k] = (q[k + 1] - q[k]) / h[k];
  }
  const double begin = h[0] + h[1], end = h[last - 2] + h[last - 1];
  upper[0] = begin / h[1];
  slopes[0] = ((h[0] + 2 * begin) * h[1] * chord[0] + h[0] * h[0] * chord[1]) / (begin * h[1]);
  for (std::size_t k = 1; k < last; ++k) {
    const double pivot = 2 * (h[k - 1] + h[k]) - h[k] * upper[k - 1];
    upper[k] = h[k - 1] / pivot;
    slopes[k] = (3 * (h[k] * chord[k - 1] + h[k - 1] * chord[k]) - h[k] * slopes[k - 1]) / pivot;
  }
  const double pivot = h[last - 2] - end * upper[last - 1];
  const Configuration right = (h[last - 1] * h[last - 1] * chord[last - 2] +
                               (2 * end + h[last - 1]) * h[last - 2] * chord[last - 1]) /
                              end;
  slopes[last] = (right - end * slopes[last - 1]) / pivot;
  for (std::size_t k = last; k-- > 0;) slopes[k] -= upper[k] * slopes[k + 1];
  return slopes;
}

/// Of the line through two samples, the parabola through three.
std::vector<Configuration> few_slopes(std::span<const Configuration> q, std::span<const double> s) {
  const Configuration first = (q[1] - q[0]) / (s[1] - s[0]);
  if (q.size() == 2) return {first, first};
  const Configuration second = (q[2] - q[1]) / (s[2] - s[1]);
  const Configuration bend = (second - first) / (s[2] - s[0]);
  return {first - (s[1] - s[0]) * bend, first + (s[1] - s[0]) * bend,
          second + (s[2] - s[1]) * bend};
}

}  // namespace

JointPath joint_spline(std::span<const Configuration> samples, std::span<const double> parameter) {
  JointPath path{{parameter.begin(), parameter.end()}, {samples.begin(), samples.end()}, {}, {}};
  path.dq = path.ddq = path.q;  // so that they can be checked
  check_path(path);
  const auto& [s, q, dq, ddq] = path;
  path.dq = q.size() < 4 ? few_slopes(samples, parameter) : spline_slopes(samples, parameter);
  const std::size_t last = q.size() - 1;
  for (std::size_t k = 0; k < last; ++k) {
    const double h = s[k + 1] - s[k];
    const Configuration chord = (q[k + 1] - q[k]) / h;
    path.ddq[k] = (6 * chord - 4 * dq[k] - 2 * dq[k + 1]) / h;
    if (k + 1 == last) path.ddq[last] = (2 * dq[k] + 4 * dq[last] - 6 * chord) / h;
  }
  return path;
}

std::vector<double> chord_length(std::span<const Configuration> samples) {
  std::vector<double> length;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    length.push_back(k == 0 ? 0 : length.back() + (samples[k] - samples[k - 1]).norm());
  }
  return length;
}

}  // namespace beeline
