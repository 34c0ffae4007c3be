#include "record.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace beeline::bench {

void Check::begin_pose() {
  ++poses_;
  here_.clear();
}

void Check::add(const Pose& goal, const Configuration& q) {
  const double error = miss(goal, forward(screws_, q));
  if (!(error <= tolerance) || (limits_ && !within_limits(screws_, q, tolerance))) {
    ++wrong_;
    return;
  }
  worst_ = std::max(worst_, error);
  constexpr double same = 1e-4;
  const bool known = std::any_of(here_.begin(), here_.end(), [&](const Configuration& other) {
    return difference(screws_, q, other) < same;
  });
  if (!known) here_.push_back(q);
}

void Check::end_pose() {
  if (!here_.empty()) ++solved_;
  right_ += static_cast<int>(here_.size());
}

double Check::solved() const { return poses_ == 0 ? 0 : static_cast<double>(solved_) / poses_; }
double Check::solutions() const { return poses_ == 0 ? 0 : static_cast<double>(right_) / poses_; }

std::string record(const std::string& arm, const std::string& question, const std::string& solver,
                   const Timing& timing, const Check& check) {
  return nlohmann::json{{"arm", arm},
                        {"case", question},
                        {"solver", solver},
                        {"poses", check.poses()},
                        {"mean_us", timing.mean},
                        {"median_us", timing.median},
                        {"p99_us", timing.p99},
                        {"p999_us", timing.p999},
                        {"max_us", timing.max},
                        {"solved", check.solved()},
                        {"solutions", check.solutions()},
                        {"wrong", check.wrong()},
                        {"worst_error", check.worst_error()}}
      .dump();
}

}  // namespace beeline::bench
