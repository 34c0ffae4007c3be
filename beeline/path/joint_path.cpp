#include <algorithm>
#include <cmath>

#include <beeline/error.h>
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

/// Into how many parts the step is cut.
int parts(const JointPath& path, std::size_t k, const RefineOptions& options) {
  const double length = path.s[k + 1] - path.s[k];
  const double longest = (path.s.back() - path.s.front()) / double(options.steps);
  const double bend = std::max(path.ddq[k].norm(), path.ddq[k + 1].norm()) * length;
  const double slope = std::max({path.dq[k].norm(), path.dq[k + 1].norm(), 1e-300});
  const double wanted = std::max(length / longest, bend / slope / options.largest_turn);
  return static_cast<int>(std::clamp(std::ceil(wanted - 1e-9), 1.0, double(options.max_parts)));
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

PathPoint path_point(const JointPath& path, std::size_t step, double share) {
  const std::size_t k = step;
  const double h = path.s[k + 1] - path.s[k], x = share;
  // Newton's form of the quintic about the left end; c3 to c5 from what is left at the right end.
  const Configuration c1 = h * path.dq[k], c2 = 0.5 * h * h * path.ddq[k];
  const Configuration r0 = path.q[k + 1] - path.q[k] - c1 - c2;
  const Configuration r1 = h * path.dq[k + 1] - c1 - 2 * c2;
  const Configuration r2 = h * h * path.ddq[k + 1] - 2 * c2;
  const Configuration c3 = 10 * r0 - 4 * r1 + 0.5 * r2;
  const Configuration c4 = -15 * r0 + 7 * r1 - r2;
  const Configuration c5 = 6 * r0 - 3 * r1 + 0.5 * r2;
  PathPoint point;
  point.q = path.q[k] + x * (c1 + x * (c2 + x * (c3 + x * (c4 + x * c5))));
  point.dq = (c1 + x * (2 * c2 + x * (3 * c3 + x * (4 * c4 + x * 5 * c5)))) / h;
  point.ddq = (2 * c2 + x * (6 * c3 + x * (12 * c4 + x * 20 * c5))) / (h * h);
  point.dddq = (6 * c3 + x * (24 * c4 + x * 60 * c5)) / (h * h * h);
  return point;
}

JointPath refined(const JointPath& path, const RefineOptions& options) {
  check_path(path);
  JointPath fine;
  const auto append = [&fine](double s, Configuration q, Configuration dq, Configuration ddq) {
    fine.s.push_back(s);
    fine.q.push_back(std::move(q));
    fine.dq.push_back(std::move(dq));
    fine.ddq.push_back(std::move(ddq));
  };
  for (std::size_t k = 0; k + 1 < path.size(); ++k) {
    append(path.s[k], path.q[k], path.dq[k], path.ddq[k]);
    const int count = parts(path, k, options);
    for (int part = 1; part < count; ++part) {
      const double share = double(part) / count;
      const double s = path.s[k] + share * (path.s[k + 1] - path.s[k]);
      if (!(s > fine.s.back() && s < path.s[k + 1])) continue;  // a step of rounding's size
      PathPoint point = path_point(path, k, share);
      append(s, std::move(point.q), std::move(point.dq), std::move(point.ddq));
    }
  }
  append(path.s.back(), path.q.back(), path.dq.back(), path.ddq.back());
  return fine;
}

}  // namespace beeline
