#include <algorithm>

#include <beeline/math/hermite.h>
#include <beeline/timing/internal/averaged_scaling.h>

namespace beeline::internal {

AveragedScaling::AveragedScaling(const TimeScaling& scaling, double width)
    : scaling_(scaling), width_(width) {}

Quintic<double> AveragedScaling::polynomial(std::size_t k) const {
  const double h = scaling_.t[k + 1] - scaling_.t[k];
  return quintic_between(scaling_.s[k + 1] - scaling_.s[k], h * scaling_.speed[k],
                         h * h * scaling_.acceleration[k], h * scaling_.speed[k + 1],
                         h * h * scaling_.acceleration[k + 1]);
}

AveragedScaling::Change AveragedScaling::after(std::size_t k, double x) const {
  const double h = scaling_.t[k + 1] - scaling_.t[k];
  const double v0 = scaling_.speed[k], v1 = scaling_.speed[k + 1];
  if (!scaling_.smooth) {
    const double a = (v1 - v0) / h;
    return {{x * (v0 + 0.5 * x * a), v0 + x * a, a}, x * x * (v0 / 2 + x * a / 6)};
  }
  const double u = x / h;
  const Quintic<double> p = polynomial(k);
  const double area =
      u * u *
      (p.c[0] / 2 + u * (p.c[1] / 3 + u * (p.c[2] / 4 + u * (p.c[3] / 5 + u * p.c[4] / 6))));
  return {{p.change(u), p.first(u) / h, p.second(u) / (h * h)}, h * area};
}

double AveragedScaling::highest(std::size_t k, double x) const {
  if (!scaling_.smooth) return after(k, x).change.acceleration;
  const double h = scaling_.t[k + 1] - scaling_.t[k];
  return polynomial(k).third(x / h) / (h * h * h);
}

std::size_t AveragedScaling::step_at(double t) const {
  const auto& times = scaling_.t;
  const auto next = std::upper_bound(times.begin() + 1, times.end() - 1, t);
  return static_cast<std::size_t>(next - times.begin()) - 1;
}

ParameterState AveragedScaling::given(double t) const {
  if (t <= 0) return {scaling_.s.front(), 0, 0};
  if (t >= scaling_.duration()) return {scaling_.s.back(), 0, 0};
  const std::size_t k = step_at(t);
  ParameterState now = after(k, t - scaling_.t[k]).change;
  now.s += scaling_.s[k];
  return now;
}

ParameterState AveragedScaling::at(double t) const {
  if (!(width_ > 0)) {
    if (t <= 0) return {scaling_.s.front(), 0, scaling_.acceleration.front()};
    if (t >= scaling_.duration()) return {scaling_.s.back(), 0, scaling_.acceleration.back()};
    return given(t);
  }
  const double begin = t - width_, end = t;
  const ParameterState a = given(begin), b = given(end);
  // The integral of s(x) - a.s over the window; s is constant before 0 and after the end.
  double integral = 0;
  const double last = scaling_.duration();
  const double from = std::max(begin, 0.0), to = std::min(end, last);
  if (to > from) {
    for (std::size_t k = step_at(from); k + 1 < scaling_.t.size() && scaling_.t[k] < to; ++k) {
      const double low = std::max(from, scaling_.t[k]), high = std::min(to, scaling_.t[k + 1]);
      integral += (high - low) * (scaling_.s[k] - a.s) + after(k, high - scaling_.t[k]).integral -
                  after(k, low - scaling_.t[k]).integral;
    }
  }
  if (end > last) integral += (end - std::max(begin, last)) * (scaling_.s.back() - a.s);
  return {a.s + integral / width_, (b.s - a.s) / width_, (b.speed - a.speed) / width_};
}

double AveragedScaling::time_of(double s, BudgetMeter& budget) const {
  double low = 0, high = duration();
  for (;;) {
    const double middle = 0.5 * (low + high);
    if (!(middle > low && middle < high) || budget.ended(0)) return high;
    (at(middle).s < s ? low : high) = middle;
  }
}

std::vector<double> AveragedScaling::kinks(double fraction) const {
  const std::size_t points = scaling_.t.size();
  std::vector<double> jumps(points);
  double largest = 0, before = 0;
  for (std::size_t k = 0; k < points; ++k) {
    const bool last = k + 1 == points;
    const double h = last ? 0 : scaling_.t[k + 1] - scaling_.t[k];
    const double here = last ? 0 : highest(k, 0);
    jumps[k] = std::abs(here - before);
    before = last ? 0 : highest(k, h);
    largest = std::max({largest, std::abs(here), std::abs(before)});
  }
  std::vector<double> times;
  for (std::size_t k = 0; k < points; ++k) {
    if (!(jumps[k] > fraction * largest)) continue;
    times.push_back(scaling_.t[k]);
    times.push_back(scaling_.t[k] + width_);
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  std::erase_if(times, [&](double t) { return !(t > 0 && t < duration()); });
  return times;
}

}  // namespace beeline::internal
