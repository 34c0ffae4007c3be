#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include <beeline/error.h>
#include <beeline/inverse/analytic/raghavan_roth_solutions.h>
#include <beeline/inverse/analytic/raghavan_roth_solver.h>
#include <beeline/math/decompositions.h>

namespace beeline::internal {
namespace {

using SixAngles = Eigen::Matrix<double, 6, 1>;

// More trials improve the choice of the eliminations and take longer. These take a few
// milliseconds, as bad eliminations, which take longest, are left out early. The choice affects the
// time of a solve; the solutions are checked in any case.
struct Round {
  int trials;    ///< for each elimination that is left
  int selected;  ///< number of eliminations that are left then, of each hidden joint
};
constexpr Round rounds[] = {{1, 2}, {3, 1}};
constexpr int trials_of_selected = 48;  // for each of the selected
constexpr int trials_together = 300;    // for the selected together, if they miss one of the first
constexpr int first_together = 32;
constexpr std::size_t max_selected = std::tuple_size_v<decltype(EliminationChoice::chosen)>;

/// Returns the product of all links, from frame 0 to the last.
Pose links_transform(const Chain& chain, const SixAngles& q) {
  Pose transform = Pose::Identity();
  for (int i = 0; i < 6; ++i) transform = transform * link_transform(chain.links[i], q[i]);
  return transform;
}

void check(const Chain& chain) {
  if (chain.links.size() != 6) {
    throw Error("general six-axis inverse kinematics: the arm has " +
                std::to_string(chain.links.size()) + " joints, 6 are needed");
  }
  for (int i = 0; i < 6; ++i) {
    const Chain::Link& link = chain.links[i];
    if (link.theta_per_q == 1 && link.d_per_q == 0 && link.coordinate == i) continue;
    throw Error("general six-axis inverse kinematics: joint " + std::to_string(i + 1) +
                " is not revolute with a coordinate of its own, as all six must be");
  }
}

/// Returns RevoluteLinks::determinant_scale, from a sample.
double mean_determinant(const Chain& chain, double unit) {
  constexpr int count = 64;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> angle(-3.14159265358979, 3.14159265358979);
  double sum = 0;
  for (int k = 0; k < count; ++k) {
    Eigen::Matrix<double, 6, 6> J;
    Pose frame = Pose::Identity();
    for (int i = 0; i < 6; ++i) {
      frame = frame * link_transform(chain.links[i], angle(random));
      const Vector3 axis = frame.linear().col(2);
      J.col(i) << (frame.translation() / unit).cross(axis), axis;
    }
    const double determinant = J.determinant();
    sum += determinant * determinant;
  }
  return std::sqrt(sum / count);
}

/// The links of a chain that fits.
struct Links {
  explicit Links(const Chain& its_chain) : chain(its_chain) {
    check(chain);
    links = revolute_links(chain);
    links.determinant_scale = mean_determinant(chain, links.unit);
    last_T_first_at_zero = links_transform(chain, SixAngles::Zero()).inverse();
  }

  const Chain& chain;
  RevoluteLinks links;
  Pose last_T_first_at_zero;
};

/// A random configuration and its goal.
struct Sample {
  SixAngles q;
  RigidMotion goal;     ///< pose of the last frame
  RigidMotion closure;  ///< G of the elimination
};

/// Returns random configurations of an arm, the same for the same arm.
class Sampler {
 public:
  explicit Sampler(const Links& links) : links_(links) {}

  Sample next() {
    Sample sample;
    for (double& each : sample.q) each = angle_(random_);
    const Pose pose = links_transform(links_.chain, sample.q);
    sample.goal = rigid_motion(pose, links_.links.unit);
    sample.closure = rigid_motion(pose * links_.last_T_first_at_zero, links_.links.unit);
    return sample;
  }

 private:
  const Links& links_;
  std::mt19937_64 random_{1};
  std::uniform_real_distribution<double> angle_{-3.14159265358979, 3.14159265358979};
};

/// The results of an elimination on random configurations.
struct Trial {
  Elimination elimination;
  int goals = 0;         ///< number of random configurations
  int missed = 0;        ///< number of those that were not found
  int inconsistent = 0;  ///< number of goals that need a second elimination
  int double_zeros = 0;  ///< number of goals with zeros that may be double
  double digits = 0;     ///< sum of the logarithms of the corrections
};

bool better(const Trial& a, const Trial& b) {
  if (a.missed != b.missed) return a.missed < b.missed;
  if (a.inconsistent != b.inconsistent) return a.inconsistent < b.inconsistent;
  return a.digits < b.digits;
}

void run_trial(const RevoluteLinks& links, const Sample& sample, Trial& trial) {
  RaghavanRothSolutions solutions;
  add_solutions(links, trial.elimination, sample.goal, sample.closure, solutions);
  ++trial.goals;
  if (!solutions.consistent) ++trial.inconsistent;
  if (solutions.double_zeros) ++trial.double_zeros;
  if (const auto index = find_solution(sample.q.data(), solutions)) {
    trial.digits += std::log10(std::max(solutions.correction[*index], 1e-12));
  } else {
    ++trial.missed;
  }
}

/// Runs the same trials for all eliminations and sorts them, best first.
void compare(const RevoluteLinks& links, int count, Sampler& sampler, std::vector<Trial>& trials) {
  for (int k = 0; k < count; ++k) {
    const Sample sample = sampler.next();
    for (Trial& trial : trials) run_trial(links, sample, trial);
  }
  std::sort(trials.begin(), trials.end(), better);
}

/// Sets the degree of the elimination's determinant, by a random configuration.
void set_degree(const Sample& sample, Elimination& elimination) {
  EliminationCandidates candidates;
  elimination_candidates(elimination, sample.closure, candidates);
  if (candidates.noise > EliminationCandidates::max_noise) elimination.degree = 12;
}

/// All eliminations, with the degrees of their determinants.
std::vector<Trial> all_eliminations(const Chain& chain, Sampler& sampler) {
  std::vector<Trial> trials(elimination_count);
  const Sample sample = sampler.next();
  for (int i = 0; i < elimination_count; ++i) {
    trials[i].elimination = make_elimination(chain, i);
    set_degree(sample, trials[i].elimination);
  }
  return trials;
}

/// Keeps the best eliminations of each hidden joint, up to `most` of each, in the order of
/// `trials`. If one elimination determines a solution badly, another one of the same hidden joint
/// does too.
void keep_best(std::vector<Trial>& trials, int most) {
  int kept[6] = {};
  std::erase_if(trials,
                [&](const Trial& trial) { return ++kept[trial.elimination.hidden] > most; });
}

/// Solves by successive eliminations until the solutions are complete.
void solve_all(const RevoluteLinks& links, const std::vector<Elimination>& eliminations,
               const RigidMotion& goal, const RigidMotion& closure,
               RaghavanRothSolutions& solutions) {
  for (const Elimination& elimination : eliminations) {
    add_solutions(links, elimination, goal, closure, solutions);
    if (solutions.complete) return;
  }
}

/// Returns the number of random configurations that solve_all() does not find.
int missed_by_all(const RevoluteLinks& links, const std::vector<Elimination>& eliminations,
                  int count, Sampler& sampler) {
  int missed = 0;
  for (int k = 0; k < count; ++k) {
    const Sample sample = sampler.next();
    RaghavanRothSolutions solutions;
    solve_all(links, eliminations, sample.goal, sample.closure, solutions);
    if (!find_solution(sample.q.data(), solutions)) ++missed;
  }
  return missed;
}

EliminationChoice choice_of(const std::vector<Elimination>& eliminations, bool reliable) {
  EliminationChoice choice{.count = static_cast<int>(eliminations.size()), .reliable = reliable};
  for (int i = 0; i < choice.count; ++i) {
    const Elimination& elimination = eliminations[i];
    choice.chosen[i] = {elimination.index, elimination.degree, elimination.double_zeros};
  }
  return choice;
}

}  // namespace

EliminationChoice choose_eliminations(const Chain& chain) {
  const Links links(chain);
  Sampler sampler(links);
  std::vector<Trial> trials = all_eliminations(chain, sampler);
  for (const Round& round : rounds) {
    compare(links.links, round.trials, sampler, trials);
    keep_best(trials, round.selected);
  }
  if (trials.size() > max_selected) trials.resize(max_selected);
  compare(links.links, trials_of_selected, sampler, trials);
  std::vector<Elimination> selected;
  for (Trial& trial : trials) {
    trial.elimination.double_zeros = 2 * trial.double_zeros > trial.goals;
    selected.push_back(trial.elimination);
  }
  int missed = missed_by_all(links.links, selected, first_together, sampler);
  if (missed > 0 && missed < first_together / 2) {
    missed += missed_by_all(links.links, selected, trials_together - first_together, sampler);
  }
  return choice_of(selected, 100 * missed <= trials_together);
}

EliminationChoice choose_eliminations(const Chain& chain, const EliminationChoice& similar) {
  const Links links(chain);
  Sampler sampler(links);
  const Sample sample = sampler.next();
  std::vector<Elimination> selected;
  for (int i = 0; i < similar.count; ++i) {
    const EliminationChoice::Chosen& chosen = similar.chosen[i];
    Elimination& elimination = selected.emplace_back(make_elimination(chain, chosen.index));
    elimination.double_zeros = chosen.double_zeros;
    set_degree(sample, elimination);
  }
  return choice_of(selected, missed_by_all(links.links, selected, first_together, sampler) == 0);
}

EliminationChoice EliminationChoice::make(const Arm& arm, const Key&,
                                          const EliminationChoice* similar) {
  if (similar != nullptr) {
    const EliminationChoice choice = choose_eliminations(chain_of(arm), *similar);
    if (choice.reliable) return choice;
  }
  return choose_eliminations(chain_of(arm));
}

RaghavanRothSolver::RaghavanRothSolver(const Chain& chain, const EliminationChoice& choice)
    : base_inverse_(chain.base.inverse()), tool_inverse_(chain.tool.inverse()) {
  const Links links(chain);
  links_ = links.links;
  last_T_first_at_zero_ = links.last_T_first_at_zero;
  eliminations_.reserve(choice.count);
  for (int i = 0; i < choice.count; ++i) {
    const EliminationChoice::Chosen& chosen = choice.chosen[i];
    Elimination& elimination = eliminations_.emplace_back(make_elimination(chain, chosen.index));
    elimination.degree = chosen.degree;
    elimination.double_zeros = chosen.double_zeros;
  }
}

RaghavanRothSolver::Result RaghavanRothSolver::solve(
    const Pose& world_T_tool, Eigen::Ref<Eigen::Matrix<double, 6, Eigen::Dynamic>> q) const {
  if (q.cols() < max_solutions) {
    throw Error("general six-axis inverse kinematics: the result has " + std::to_string(q.cols()) +
                " columns, 16 are needed");
  }
  if (!world_T_tool.matrix().allFinite()) {
    throw Error("general six-axis inverse kinematics: the pose is not finite");
  }
  const Pose pose = base_inverse_ * world_T_tool * tool_inverse_;
  RaghavanRothSolutions solutions;
  solve_all(links_, eliminations_, rigid_motion(pose, links_.unit),
            rigid_motion(pose * last_T_first_at_zero_, links_.unit), solutions);
  const int count = std::min(solutions.count, max_solutions);
  for (int k = 0; k < count; ++k) q.col(k) = Eigen::Map<const SixAngles>(solutions.q[k]);
  return {count, solutions.complete};
}

}  // namespace beeline::internal
