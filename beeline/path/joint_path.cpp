#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/math/hermite.h>
#include <beeline/path/joint_path.h>

namespace beeline {
namespace {

void check_column(const JointPath& path, const std::vector<Configuration>& column,
                  const char* what) {
  if (column.size() != path.size()) {
    throw Error("a path of " + std::to_string(path.size()) + " grid points has " +
                std::to_string(column.size()) + " values of " + what);
  }
  for (std::size_t k = 0; k < column.size(); ++k) {
    if (column[k].size() == path.q[0].size() && column[k].allFinite()) continue;
    throw Error("grid point " + std::to_string(k + 1) + " of the path needs " +
                std::to_string(path.q[0].size()) + " finite values of " + what);
  }
}

/// The number of parts into which refined() divides the step. A blend curves in the middle of its
/// step only.
int parts(const JointPath& path, std::size_t k, const RefineOptions& options) {
  const double length = path.s[k + 1] - path.s[k];
  const double longest = (path.s.back() - path.s.front()) / double(options.min_steps);
  const double change =
      std::max({path.ddq[k].norm(), path_point(path, k, 0.5).ddq.norm(), path.ddq[k + 1].norm()}) *
      length;
  const double rate = std::max({path.dq[k].norm(), path.dq[k + 1].norm(), 1e-300});  // not 0
  const double wanted = std::max(length / longest, change / rate / options.max_change);
  return static_cast<int>(std::clamp(std::ceil(wanted - 1e-9), 1.0, double(options.max_parts)));
}

/// Returns the number of grid points of the refined path, or more. Throws Error where they would
/// exhaust the memory.
std::size_t refined_size(const JointPath& path, const RefineOptions& options) {
  constexpr double most = 1e7;
  double all = 1;
  for (std::size_t k = 0; k + 1 < path.size(); ++k) all += parts(path, k, options);
  if (all <= most) return static_cast<std::size_t>(all);
  throw Error("the refined path would have " + number(all) + " grid points, at most " +
              number(most) + " are possible; lower min_steps or max_parts, or raise max_change");
}

/// The derivatives at the samples of a spline through at least four: solves the tridiagonal system
/// of de Boor's eq. IV (12) by elimination. Its first and last row are the not-a-knot conditions.
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

/// The derivatives at the samples of the line through two, or the parabola through three.
std::vector<Configuration> few_slopes(std::span<const Configuration> q, std::span<const double> s) {
  const Configuration first = (q[1] - q[0]) / (s[1] - s[0]);
  if (q.size() == 2) return {first, first};
  const Configuration second = (q[2] - q[1]) / (s[2] - s[1]);
  const Configuration half_second = (second - first) / (s[2] - s[0]);
  return {first - (s[1] - s[0]) * half_second, first + (s[1] - s[0]) * half_second,
          second + (s[2] - s[1]) * half_second};
}

}  // namespace

void check_path(const JointPath& path) {
  if (path.size() < 2) throw Error("a path needs two grid points or more");
  if (path.q.empty() || path.q[0].size() == 0) throw Error("a path needs configurations");
  check_column(path, path.q, "q");
  check_column(path, path.dq, "dq");
  check_column(path, path.ddq, "ddq");
  for (std::size_t k = 0; k < path.size(); ++k) {
    if (std::isfinite(path.s[k]) && (k == 0 || path.s[k] > path.s[k - 1])) continue;
    throw Error("the parameter does not increase at grid point " + std::to_string(k + 1) +
                " of the path: " + number(path.s[k]));
  }
}

PathPoint path_point(const JointPath& path, std::size_t step, double u) {
  const Configuration &q0 = path.q[step], &q1 = path.q[step + 1];
  const Configuration &v0 = path.dq[step], &v1 = path.dq[step + 1];
  const Configuration &a0 = path.ddq[step], &a1 = path.ddq[step + 1];
  const double h = path.s[step + 1] - path.s[step];
  const Eigen::Index joints = q0.size();
  PathPoint point{Configuration(joints), Configuration(joints), Configuration(joints),
                  Configuration(joints)};
  for (Eigen::Index i = 0; i < joints; ++i) {
    const auto quintic = internal::quintic_between<double>(q1[i] - q0[i], h * v0[i], h * h * a0[i],
                                                           h * v1[i], h * h * a1[i]);
    point.q[i] = q0[i] + quintic.change(u);
    point.dq[i] = quintic.first(u) / h;
    point.ddq[i] = quintic.second(u) / (h * h);
    point.dddq[i] = quintic.third(u) / (h * h * h);
  }
  return point;
}

JointPath joint_spline(std::span<const Configuration> samples, std::span<const double> parameter) {
  JointPath path{{parameter.begin(), parameter.end()}, {samples.begin(), samples.end()}, {}, {}};
  path.dq = path.ddq = path.q;  // of the right size for check_path()
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

void smooth_derivatives(JointPath& path) {
  check_path(path);
  using Rows = Eigen::Matrix<double, 2, Eigen::Dynamic>;  // of dq and ddq
  const std::vector<double>& s = path.s;
  const std::vector<Configuration>& q = path.q;
  const std::size_t last = path.size() - 1;
  const auto at_end = [&path](std::size_t k) {
    Rows rows(2, path.q[0].size());
    rows << path.dq[k].transpose(), path.ddq[k].transpose();
    return rows;
  };
  // Block elimination of the equations that the third and fourth derivatives, times h^3 and h^4 of
  // the step after the grid point, are the same on both sides.
  std::vector<Eigen::Matrix2d> upper(path.size(), Eigen::Matrix2d::Zero());
  std::vector<Rows> right(path.size(), at_end(0));
  for (std::size_t k = 1; k < last; ++k) {
    const double a = s[k] - s[k - 1], b = s[k + 1] - s[k], r = b / a;
    Eigen::Matrix2d before, here, after;
    before << 24 * r * r * b, 3 * r * b * b, 168 * r * r * r * b, 24 * r * r * b * b;
    here << 36 * (r * r - 1) * b, -9 * (r + 1) * b * b, 192 * (r * r * r + 1) * b,
        36 * (1 - r * r) * b * b;
    after << -24 * b, 3 * b * b, 168 * b, -24 * b * b;
    Rows equal(2, q[0].size());
    const Configuration left = r * r * r * (q[k] - q[k - 1]), next = q[k + 1] - q[k];
    equal << 60 * (left - next).transpose(), 360 * (r * left + next).transpose();
    const Eigen::Matrix2d pivot = (here - before * upper[k - 1]).inverse();
    upper[k] = pivot * after;
    right[k] = pivot * (equal - before * right[k - 1]);
  }
  right[last] = at_end(last);
  for (std::size_t k = last; k-- > 1;) {
    right[k] -= upper[k] * right[k + 1];
    path.dq[k] = right[k].row(0);
    path.ddq[k] = right[k].row(1);
  }
}

std::vector<double> chord_length(std::span<const Configuration> samples) {
  std::vector<double> length;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    length.push_back(k == 0 ? 0 : length.back() + (samples[k] - samples[k - 1]).norm());
  }
  return length;
}

JointPath refined(const JointPath& path, const RefineOptions& options) {
  check_path(path);
  const std::size_t size = refined_size(path, options);
  internal::BudgetMeter budget(options.budget);
  const std::size_t between_reports = 1 + path.size() / 100;
  JointPath fine;
  fine.s.reserve(size);
  for (auto* column : {&fine.q, &fine.dq, &fine.ddq}) column->reserve(size);
  const auto append = [&fine](double s, Configuration q, Configuration dq, Configuration ddq) {
    fine.s.push_back(s);
    fine.q.push_back(std::move(q));
    fine.dq.push_back(std::move(dq));
    fine.ddq.push_back(std::move(ddq));
  };
  for (std::size_t k = 0; k + 1 < path.size(); ++k) {
    if (budget.ended()) return {};
    if (k % between_reports == 0) budget.report(double(k) / double(path.size()));
    append(path.s[k], path.q[k], path.dq[k], path.ddq[k]);
    const int count = parts(path, k, options);
    for (int part = 1; part < count; ++part) {
      if (budget.ended()) return {};
      const double u = double(part) / count;
      const double s = path.s[k] + u * (path.s[k + 1] - path.s[k]);
      if (!(s > fine.s.back() && s < path.s[k + 1]))
        continue;  // the step is of the size of rounding
      PathPoint point = path_point(path, k, u);
      append(s, std::move(point.q), std::move(point.dq), std::move(point.ddq));
    }
  }
  append(path.s.back(), path.q.back(), path.dq.back(), path.ddq.back());
  budget.report(1);
  return fine;
}

}  // namespace beeline
