#include <algorithm>
#include <cmath>

#include <beeline/certificate/internal/path_checks.h>
#include <beeline/certificate/internal/path_interval.h>
#include <beeline/kinematics/internal/tool_motion.h>
#include <beeline/path/internal/following.h>
#include <beeline/trajectory/internal/interval_polynomial.h>

namespace beeline::internal {
namespace {

/// The segments from path parameter s_a to s_b, and the spans from the beginning of the first one.
class Division {
 public:
  Division(const ToolPath& path, const Task& task, double s_a, double s_b) {
    first_ = std::min(static_cast<std::size_t>(s_a), path.segments.size() - 1);
    last_ = std::max(first_, segment_at(path, s_b));
    for (std::size_t i = first_; i <= last_; ++i) {
      spans_.push_back(stands_still(path.segments[i], task) ? 0 : path.spans[i]);
    }
  }

  std::size_t first() const { return first_; }
  std::size_t last() const { return last_; }

  /// The span from the beginning of the first segment to the path parameter s of segment i.
  double span_to(std::size_t i, double s) const {
    double span = 0;
    for (std::size_t j = first_; j < i; ++j) span += spans_[j - first_];
    return span + (s - static_cast<double>(i)) * spans_[i - first_];
  }

  double span(std::size_t i) const { return spans_[i - first_]; }

 private:
  std::size_t first_ = 0, last_ = 0;
  std::vector<double> spans_;
};

/// Returns the first u in [from, 1] at which p reaches the value; 1 if p does not reach it.
double reaching(const Polynomial& p, double value, double from) {
  constexpr int scan = 32;
  double low = from;
  for (int i = 1; i <= scan; ++i) {
    double high = from + (1 - from) * i / scan;
    if (p(high) < value) {
      low = high;
      continue;
    }
    for (;;) {
      const double middle = 0.5 * (low + high);
      if (!(middle > low && middle < high)) return high;
      (p(middle) < value ? low : high) = middle;
    }
  }
  return 1;
}

}  // namespace

std::vector<PathInterval> path_intervals(const Arm& arm, const Trajectory& trajectory,
                                         std::size_t k, const ToolPath& path, const Task& task,
                                         double s_a, double s_b) {
  Interval whole{interval_polynomials(trajectory, k), {}};
  const Division division(path, task, s_a, s_b);
  const std::size_t first = division.first(), last = division.last();
  const auto local = [](double s, std::size_t i) { return s - static_cast<double>(i); };
  const ParameterRates begin = following(path.segments[first], local(s_a, first), task,
                                         tool_motion(arm, whole.coordinates, 0));
  const ParameterRates end = following(path.segments[last], local(s_b, last), task,
                                       tool_motion(arm, whole.coordinates, 1));
  if (first == last) {
    whole.s = quintic_between(local(s_a, first), local(s_b, first), begin.first, end.first,
                              begin.second, end.second);
    return {{first, 0, 1, std::move(whole)}};
  }
  const Polynomial span =
      quintic_between(division.span_to(first, s_a), division.span_to(last, s_b),
                      begin.first * division.span(first), end.first * division.span(last),
                      begin.second * division.span(first), end.second * division.span(last));
  std::vector<PathInterval> parts;
  double from = 0;
  std::size_t last_moving = last;  // the part of this segment extends to the end
  while (last_moving > first && !(division.span(last_moving) > 0)) --last_moving;
  for (std::size_t i = first; i <= last_moving; ++i) {
    const double to =
        i == last_moving
            ? 1
            : reaching(span, division.span_to(i + 1, static_cast<double>(i + 1)), from);
    if (!(division.span(i) > 0) || !(to > from)) continue;
    PathInterval piece{i, from, to, part(whole, from, to)};
    piece.interval.s = span.part(from, to);
    piece.interval.s.c[0] -= division.span_to(i, static_cast<double>(i));
    for (double& c : piece.interval.s.c) c /= division.span(i);
    parts.push_back(std::move(piece));
    from = to;
  }
  if (parts.empty()) {  // the path is at rest in the task's rows
    whole.s.c[0] = local(s_b, last);
    parts.push_back({last, 0, 1, std::move(whole)});
  }
  return parts;
}

}  // namespace beeline::internal
