#include <algorithm>
#include <limits>

#include <beeline/path/internal/consistent_parameters.h>

namespace beeline::internal {
namespace {

/// A possible path parameter of a sample, with the least cost of the samples up to it.
struct Candidate {
  double s = 0, cost = 0;
  std::size_t before = 0;  ///< the candidate of the sample before it
};

class Assignment {
 public:
  Assignment(const PathTracker& tracker, std::span<const Pose> poses,
             const std::vector<double>& first, const std::function<double(std::size_t)>& moved,
             BudgetMeter& budget)
      : tracker_(tracker),
        poses_(poses),
        first_(first),
        last_(first),
        moved_(moved),
        budget_(budget) {
    for (std::size_t k = first.size() - 1; k-- > 1;) {
      if (budget.ended()) return;
      last_[k] = tracker.last_within(poses[k], last_[k + 1], first[k]);
    }
  }

  std::vector<double> run() {
    const std::size_t size = first_.size();
    all_ = {{{first_.front()}}};
    for (std::size_t k = 1; k < size; ++k) {
      if (budget_.ended()) return first_;
      all_.push_back(candidates(k));
    }
    std::vector<double> result(size);
    std::size_t chosen = 0;  // the last sample has one candidate
    for (std::size_t k = size; k-- > 0;) {
      result[k] = all_[k][chosen].s;
      chosen = all_[k][chosen].before;
    }
    return result;
  }

 private:
  /// The candidates of sample k, each with the best one before it.
  std::vector<Candidate> candidates(std::size_t k) const {
    if (k + 1 == first_.size()) return {reached(k, last_[k], moved_(k - 1))};
    const std::vector<double> fits = tracker_.fits(poses_[k], first_[k], last_[k]);
    const double motion = fits.size() > 1 || all_.back().size() > 1 ? moved_(k - 1) : 0;
    std::vector<Candidate> all;
    for (const double s : fits) {
      const Candidate candidate = reached(k, s, motion);
      if (candidate.cost < std::numeric_limits<double>::infinity()) all.push_back(candidate);
    }
    // last_[k] is within the tolerance and not less than any candidate of sample k - 1.
    if (all.empty()) all.push_back(reached(k, last_[k], motion));
    return all;
  }

  /// The candidate at s or, where that is before one of sample k - 1, there.
  Candidate reached(std::size_t k, double s, double motion) const {
    const std::vector<Candidate>& before = all_.back();
    Candidate best{s, std::numeric_limits<double>::infinity()};
    for (std::size_t i = 0; i < before.size(); ++i) {
      const double here = std::max(s, before[i].s);
      if (here > last_[k] || (here > s && !tracker_.within_tolerance(poses_[k], here))) continue;
      const double length = tracker_.length(before[i].s, here) - motion;
      const double off = tracker_.distance(tracker_.pose(here), poses_[k]);
      const double cost = before[i].cost + length * length + off * off;
      if (cost < best.cost) best = {here, cost, i};
    }
    return best;
  }

  const PathTracker& tracker_;
  std::span<const Pose> poses_;
  const std::vector<double>& first_;
  std::vector<double> last_;  ///< the largest parameters that later samples allow
  const std::function<double(std::size_t)>& moved_;
  BudgetMeter& budget_;
  std::vector<std::vector<Candidate>> all_;
};

}  // namespace

std::vector<double> consistent_parameters(const PathTracker& tracker, std::span<const Pose> poses,
                                          const std::vector<double>& first_within,
                                          const std::function<double(std::size_t)>& moved,
                                          BudgetMeter& budget) {
  return Assignment(tracker, poses, first_within, moved, budget).run();
}

}  // namespace beeline::internal
