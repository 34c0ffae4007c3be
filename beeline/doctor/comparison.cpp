#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <beeline/doctor/comparison.h>
#include <beeline/doctor/internal/explanations.h>
#include <beeline/doctor/internal/hypotheses.h>
#include <beeline/doctor/internal/verdict.h>

namespace beeline {
namespace {

using internal::Hypothesis;
using internal::Reconciliation;

constexpr int few = 20;  // configurations that refute a wrong explanation

/// An explanation that forward kinematics confirms, with the data for its report.
struct Candidate {
  Reconciliation explanation;
  Arm b;  ///< arm B as changed by the hypothesis
  double scale = 1;
  std::vector<std::size_t> kept;  ///< joints of the longer arm that are kept; empty: all
  double cost = 0;
};

bool of_ends(const ModelDifference& difference) {
  return difference.kind == DifferenceKind::mount || difference.kind == DifferenceKind::tool;
}

bool of_joint(const ModelDifference& difference) {
  return difference.kind == DifferenceKind::joint_offset ||
         difference.kind == DifferenceKind::joint_sign;
}

bool only_ends_left(const std::vector<ModelDifference>& differences) {
  return std::all_of(differences.begin() + 1, differences.end(), of_ends);
}

bool of_description_only(const std::vector<ModelDifference>& differences) {
  return std::all_of(differences.begin(), differences.end(),
                     [](const ModelDifference& each) { return of_ends(each) || of_joint(each); });
}

/// Returns the cost of an explanation, a weighted number of differences. A mistake in many numbers
/// explains by chance if other differences remain. It costs more then, unless the others are
/// plausible: mount and tool; for another convention, unit or number of joints also offsets and
/// signs.
double cost_of(const std::vector<ModelDifference>& differences, const Hypothesis* hypothesis) {
  constexpr double implausible = 10;
  const auto number = static_cast<double>(differences.size());
  if (hypothesis == nullptr) return number;
  const DifferenceKind kind = hypothesis->difference.kind;
  const bool usual = kind == DifferenceKind::convention || kind == DifferenceKind::unit ||
                     kind == DifferenceKind::joint_count;
  const bool plausible = std::all_of(
      differences.begin() + 1, differences.end(),
      [&](const ModelDifference& left) { return of_ends(left) || (usual && of_joint(left)); });
  return number + (usual ? 0 : 0.5) + (plausible ? 0 : implausible);
}

/// Collects the explanations of a pair of arms, those with the least cost first.
class Search {
 public:
  explicit Search(double tolerance) : tolerance_(tolerance) {}

  void add(const Hypothesis* hypothesis, const Arm& a, const Arm& b,
           const std::vector<std::size_t>& kept = {}) {
    std::vector<Reconciliation> found = internal::table_explanations(a, b, tolerance_);
    const auto append = [&found](std::vector<Reconciliation> more) {
      found.insert(found.end(), std::make_move_iterator(more.begin()),
                   std::make_move_iterator(more.end()));
    };
    append(internal::frame_explanations(a, b, tolerance_));
    append(internal::screw_explanations(a, b, tolerance_));
    for (Reconciliation& each : found) {
      std::vector<ModelDifference>& differences = each.differences;
      if (hypothesis != nullptr) differences.insert(differences.begin(), hypothesis->difference);
      const double cost = cost_of(differences, hypothesis);
      if (!candidates_.empty() && cost > candidates_.front().cost) continue;
      if (hypothesis != nullptr && described_ && !only_ends_left(differences)) continue;
      if (!internal::negligible(internal::deviation(each, b, few), b, tolerance_)) continue;
      described_ = described_ || (hypothesis == nullptr && of_description_only(differences));
      Candidate candidate{std::move(each), b, hypothesis == nullptr ? 1 : hypothesis->scale, kept,
                          cost};
      const auto place =
          std::upper_bound(candidates_.begin(), candidates_.end(), candidate,
                           [](const Candidate& x, const Candidate& y) { return x.cost < y.cost; });
      candidates_.insert(place, std::move(candidate));
    }
  }

  const std::vector<Candidate>& candidates() const { return candidates_; }

  /// Returns whether no shorter explanation can be found.
  bool settled() const { return !candidates_.empty() && candidates_.front().cost <= 1; }

 private:
  double tolerance_;
  bool described_ = false;  ///< whether mount, tool, offsets and signs explain all differences
  std::vector<Candidate> candidates_;
};

Search explanations(const Arm& a, const Arm& b, double tolerance) {
  Search search(tolerance);
  if (a.joints().size() != b.joints().size()) {
    for (const internal::MissingJoints& missing : internal::missing_joint_hypotheses(a, b)) {
      const Hypothesis& hypothesis = missing.hypothesis;
      search.add(&hypothesis, hypothesis.a, hypothesis.b, missing.kept);
    }
    return search;
  }
  search.add(nullptr, a, b);
  for (const auto hypotheses : {internal::table_hypotheses, internal::scale_hypotheses,
                                internal::rotation_hypotheses, internal::order_hypotheses}) {
    if (search.settled()) break;
    for (const Hypothesis& hypothesis : hypotheses(a, b)) {
      search.add(&hypothesis, hypothesis.a, hypothesis.b);
    }
  }
  return search;
}

/// Returns the differences of the next explanation of equal length that names other things.
std::vector<ModelDifference> alternative_to(const Candidate& best,
                                            const std::vector<Candidate>& candidates) {
  const auto kinds = [](const Candidate& candidate) {
    std::vector<std::pair<DifferenceKind, int>> all;
    for (const ModelDifference& difference : candidate.explanation.differences) {
      all.emplace_back(difference.kind, difference.joint);
    }
    std::sort(all.begin(), all.end());
    return all;
  };
  for (const Candidate& candidate : candidates) {
    if (candidate.cost != best.cost) break;
    if (kinds(candidate) != kinds(best)) return candidate.explanation.differences;
  }
  return {};
}

/// Marks two lengths or two angles that are exchanged.
void mark_exchanged(std::vector<ModelDifference>& differences, double tolerance) {
  const auto exchanged = [&](const ModelDifference& x, const ModelDifference& y) {
    return x.kind == y.kind &&
           (x.kind == DifferenceKind::length || x.kind == DifferenceKind::angle) && x.a && x.b &&
           y.a && y.b && std::abs(*x.a - *y.b) <= tolerance && std::abs(*x.b - *y.a) <= tolerance;
  };
  for (std::size_t i = 0; i < differences.size(); ++i) {
    for (std::size_t j = i + 1; j < differences.size(); ++j) {
      ModelDifference &x = differences[i], &y = differences[j];
      if (!exchanged(x, y)) continue;
      x.remedy = "exchanged with " + y.parameter + " of joint " + std::to_string(y.joint + 1);
      y.remedy = "exchanged with " + x.parameter + " of joint " + std::to_string(x.joint + 1);
    }
  }
}

/// Copies the explanation into the result.
void report(const Candidate& best, const Arm& a, ArmComparison& result) {
  const Reconciliation& explanation = best.explanation;
  result.explained = true;
  result.differences = explanation.differences;
  result.residual = internal::deviation(explanation, best.b, result.configurations);
  const Eigen::Index joints = static_cast<Eigen::Index>(a.joints().size());
  result.gain = Configuration::Zero(joints);
  result.offset = Configuration::Zero(joints);
  const bool all = best.kept.empty() || explanation.gain.size() == joints;
  for (Eigen::Index i = 0; i < explanation.gain.size(); ++i) {
    const auto place = static_cast<std::size_t>(i);
    const Eigen::Index joint = all ? i : static_cast<Eigen::Index>(best.kept[place]);
    const bool slides = kind(explanation.arm.joints()[place]) == JointKind::prismatic;
    result.gain[joint] = explanation.gain[i] * (slides ? best.scale : 1);
    result.offset[joint] = explanation.offset[i];
  }
}

/// Returns the joints that an explanation takes as the same; without one, all if the arms have
/// equally many, else the joints with equal names.
internal::JointPairs joint_pairs(const Arm& a, const Arm& b, const Candidate* best) {
  const std::size_t in_a = a.joints().size(), in_b = b.joints().size();
  internal::JointPairs pairs;
  if (in_a == in_b) {
    for (std::size_t i = 0; i < in_a; ++i) pairs.emplace_back(i, i);
  } else if (best != nullptr) {
    for (std::size_t i = 0; i < best->kept.size(); ++i) {
      const std::size_t longer = best->kept[i];
      in_a > in_b ? pairs.emplace_back(longer, i) : pairs.emplace_back(i, longer);
    }
  } else {
    for (std::size_t i = 0; i < in_a; ++i) {
      for (std::size_t k = 0; k < in_b; ++k) {
        if (a.joints()[i].name == b.joints()[k].name) pairs.emplace_back(i, k);
      }
    }
  }
  return pairs;
}

}  // namespace

ArmComparison compare_arms(const Arm& a, const Arm& b, const ComparisonOptions& options) {
  if (!(options.tolerance > 0) || !(options.tolerance <= 0.1)) {
    throw Error("tolerance " + number(options.tolerance) + " must be above 0 and at most 0.1");
  }
  if (options.configurations < 1) {
    throw Error("configurations " + std::to_string(options.configurations) + " must be 1 or more");
  }
  const Arm bare_a = internal::bare(a), bare_b = internal::bare(b);
  ArmComparison result;
  result.configurations = options.configurations;
  const bool paired = a.joints().size() == b.joints().size();
  const Reconciliation as_they_are(bare_a);
  if (paired) result.before = internal::deviation(as_they_are, bare_b, options.configurations);
  const Search search = explanations(bare_a, bare_b, options.tolerance);
  const Candidate* best = search.candidates().empty() ? nullptr : &search.candidates().front();
  if (best != nullptr) {
    report(*best, a, result);
    mark_exchanged(result.differences, options.tolerance);
    result.alternative = alternative_to(*best, search.candidates());
  } else {
    result.gain = result.offset = Configuration::Zero(static_cast<Eigen::Index>(a.joints().size()));
    result.residual = result.before;
  }
  result.others =
      internal::other_differences(a, b, joint_pairs(a, b, best), result, options.tolerance);
  internal::judge(a, b, result);
  return result;
}

}  // namespace beeline
