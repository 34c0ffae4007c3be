#include <algorithm>

#include <beeline/control/internal/recorded_sections.h>
#include <beeline/trajectory/internal/end_velocity.h>
#include <beeline/trajectory/internal/limit_fraction.h>

namespace beeline::internal {
namespace {

constexpr double still_distance = 1e-5;  // radians or metres, max motion in a dwell
constexpr double zero_velocity = 1e-9;   // fraction of the largest velocity
constexpr double pass_ratio = 0.1;  // fraction of the velocities beside a stop that is not exact
constexpr double rise_ratio = 1.5;  // ratio of successive velocities of linear joints beside a stop
constexpr double parallel = 0.9;    // cosine of the angle up to which a direction does not change
constexpr double least_move = 1e-12;  // radians or metres; nearer positions count as equal

class StopSearch {
 public:
  StopSearch(const Arm& arm, const Trajectory& recording) : recording_(recording) {
    limits_ = motion_limits_of(arm);
    for (const Configuration& v : recording.velocities) {
      largest_ = std::max(largest_, v.lpNorm<Eigen::Infinity>());
    }
  }

  /// Whether the arm stops at an inner sample.
  bool stops_at(std::size_t k) const {
    return recording_.velocities.empty() ? stops_between_lines(k) : stops_with_velocity(k);
  }

 private:
  bool stops_with_velocity(std::size_t k) const {
    const auto& v = recording_.velocities;
    const double speed = v[k].norm();
    if (v[k].lpNorm<Eigen::Infinity>() <= zero_velocity * largest_) return true;
    return counts_as_rest(recording_, limits_, v[k], 0) && speed <= pass_ratio * v[k - 1].norm() &&
           speed <= pass_ratio * v[k + 1].norm();
  }

  double duration_after(std::size_t k) const {
    return recording_.times[k + 1] - recording_.times[k];
  }
  Configuration move_after(std::size_t k) const {
    return recording_.positions[k + 1] - recording_.positions[k];
  }
  double speed_after(std::size_t k) const { return move_after(k).norm() / duration_after(k); }

  bool stops_between_lines(std::size_t k) const {
    const Configuration before = move_after(k - 1), after = move_after(k);
    const double h_before = duration_after(k - 1), h_after = duration_after(k);
    if (!counts_as_rest(recording_, limits_, before / h_before, h_before) ||
        !counts_as_rest(recording_, limits_, after / h_after, h_after)) {
      return false;
    }
    if (before.norm() <= least_move || after.norm() <= least_move) return true;
    if (before.dot(after) < parallel * before.norm() * after.norm()) return true;
    const bool falls = k == 1 || speed_after(k - 2) >= rise_ratio * speed_after(k - 1);
    const bool rises =
        k + 2 == recording_.size() || speed_after(k + 1) >= rise_ratio * speed_after(k);
    return falls && rises;
  }

  const Trajectory& recording_;
  std::vector<Limits> limits_ = {};
  double largest_ = 0;  // velocity
};

/// Returns whether the positions after sample `begin` up to `end` are near q.
bool stays(const Trajectory& recording, const Configuration& q, std::size_t begin,
           std::size_t end) {
  for (std::size_t k = end; k > begin; --k) {
    if ((recording.positions[k] - q).lpNorm<Eigen::Infinity>() > still_distance) return false;
  }
  return true;
}

}  // namespace

std::vector<RecordedSection> sections_between_stops(const Arm& arm, const Trajectory& recording) {
  std::vector<RecordedSection> sections;
  if (recording.size() < 2) return sections;
  const StopSearch search(arm, recording);
  const std::size_t last = recording.size() - 1;
  for (std::size_t begin = 0, k = 1; k <= last; ++k) {
    if (k < last && !search.stops_at(k)) continue;
    const auto near = [&](std::size_t from) {
      return stays(recording, recording.positions[from], begin, k);
    };
    const bool rests = near(begin);
    const bool continues =
        rests && !sections.empty() && sections.back().rests && near(sections.back().begin);
    if (continues) {
      sections.back().end = k;
    } else {
      sections.push_back({begin, k, rests});
    }
    begin = k;
  }
  return sections;
}

}  // namespace beeline::internal
