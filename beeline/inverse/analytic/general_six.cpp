#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include <beeline/error.h>
#include <beeline/inverse/analytic/general_six.h>
#include <beeline/inverse/analytic/general_solutions.h>

namespace beeline {
namespace {

Pose links_motion(const Chain& chain, const Eigen::Matrix<double, 6, 1>& q) {
  Pose motion = Pose::Identity();
  for (int i = 0; i < 6; ++i) motion = motion * link_transform(chain.links[i], q[i]);
  return motion;
}

Motion plain(const Pose& pose, double unit) {
  Motion motion;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) motion.rotation[r][c] = pose.linear()(r, c);
    motion.translation[r] = pose.translation()[r] / unit;
  }
  return motion;
}

/// How an elimination does on random configurations.
struct Trial {
  GeneralElimination elimination;
  int missed = 0;       ///< configurations that were not found again
  int unexplained = 0;  ///< where it would like a second opinion, see GeneralSolutions
  int close = 0;        ///< where it met zeros close together
  double digits = 0;    ///< decimal digits by which its candidates are off, summed
};

bool better(const Trial& a, const Trial& b) {
  if (a.missed != b.missed) return a.missed < b.missed;
  return a.unexplained != b.unexplained ? a.unexplained < b.unexplained : a.digits < b.digits;
}

void add_case(const SixLinks& six, const Motion& goal, const Motion& loop, const double* q,
              Trial& trial) {
  GeneralSolutions solutions;
  add_solutions(six, trial.elimination, goal, loop, solutions);
  const int place = place_of(q, solutions);
  if (place < 0) ++trial.missed;
  if (!solutions.explained) ++trial.unexplained;
  if (solutions.close) ++trial.close;
  trial.digits += place < 0 ? 0 : std::log10(std::max(solutions.step[place], 1e-12));
}

/// Asks one elimination after the other until all is explained.
void find(const SixLinks& six, const std::vector<GeneralElimination>& eliminations,
          const Motion& goal, const Motion& loop, GeneralSolutions& solutions) {
  for (const GeneralElimination& elimination : eliminations) {
    add_solutions(six, elimination, goal, loop, solutions);
    if (solutions.complete) return;
  }
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

constexpr int first_trials = 24;  // for each way to cut
constexpr int more_trials = 100;  // for those chosen
constexpr int last_trials = 300;  // for all together
constexpr int opinions = 4;

}  // namespace

GeneralSix::GeneralSix(const Chain& chain) {
  check(chain);
  six_ = six_links(chain);
  base_inverse_ = chain.base.inverse();
  tool_inverse_ = chain.tool.inverse();
  rest_inverse_ = links_motion(chain, Eigen::Matrix<double, 6, 1>::Zero()).inverse();

  std::vector<Trial> by_merit(general_eliminations);
  for (int i = 0; i < general_eliminations; ++i) {
    by_merit[i].elimination = general_elimination(chain, i);
  }
  std::mt19937_64 random(1);  // the same arm is always solved the same way
  std::uniform_real_distribution<double> angle(-3.14159265358979, 3.14159265358979);
  const auto anywhere = [&] {
    Eigen::Matrix<double, 6, 1> q;
    for (double& each : q) each = angle(random);
    return q;
  };
  const Motion some = plain(links_motion(chain, anywhere()) * rest_inverse_, six_.unit);
  for (Trial& trial : by_merit) {
    GeneralCandidates candidates;
    general_candidates(trial.elimination, some, candidates);
    if (candidates.noise > GeneralCandidates::loudest) trial.elimination.degree = 12;
  }
  const auto for_random_cases = [&](int cases, const auto& use) {
    for (int k = 0; k < cases; ++k) {
      const Eigen::Matrix<double, 6, 1> q = anywhere();
      const Pose reached = links_motion(chain, q);
      use(q, plain(reached, six_.unit), plain(reached * rest_inverse_, six_.unit));
    }
  };
  using Six = Eigen::Matrix<double, 6, 1>;
  const auto try_all = [&](const Six& q, const Motion& goal, const Motion& loop) {
    for (Trial& trial : by_merit) add_case(six_, goal, loop, q.data(), trial);
  };
  for_random_cases(first_trials, try_all);
  std::sort(by_merit.begin(), by_merit.end(), better);
  // Second opinions are worth most from where another joint is hidden.
  std::vector<Trial> chosen;
  for (const Trial& trial : by_merit) {
    const bool known = std::any_of(chosen.begin(), chosen.end(), [&](const Trial& other) {
      return other.elimination.hidden == trial.elimination.hidden;
    });
    if (!known && chosen.size() < opinions) chosen.push_back(trial);
  }
  by_merit = std::move(chosen);
  for_random_cases(more_trials, try_all);
  std::sort(by_merit.begin(), by_merit.end(), better);
  for (Trial& trial : by_merit) {
    trial.elimination.twofold = 2 * trial.close > first_trials + more_trials;
    eliminations_.push_back(trial.elimination);
  }

  int missed = 0;
  for_random_cases(last_trials, [&](const Six& q, const Motion& goal, const Motion& loop) {
    GeneralSolutions solutions;
    find(six_, eliminations_, goal, loop, solutions);
    if (place_of(q.data(), solutions) < 0) ++missed;
  });
  reliable_ = 100 * missed <= last_trials;
}

GeneralSix::Found GeneralSix::solve(const Pose& world_T_tool,
                                    Eigen::Ref<Eigen::Matrix<double, 6, Eigen::Dynamic>> q) const {
  if (q.cols() < max_solutions) {
    throw Error("general six-axis inverse kinematics: room for " + std::to_string(q.cols()) +
                " solutions, 16 are needed");
  }
  if (!world_T_tool.matrix().allFinite()) {
    throw Error("general six-axis inverse kinematics: the pose is not finite");
  }
  const Pose reached = base_inverse_ * world_T_tool * tool_inverse_;
  const Motion goal = plain(reached, six_.unit), loop = plain(reached * rest_inverse_, six_.unit);
  GeneralSolutions solutions;
  find(six_, eliminations_, goal, loop, solutions);
  const int count = std::min(solutions.count, max_solutions);
  for (int k = 0; k < count; ++k)
    q.col(k) = Eigen::Map<Eigen::Matrix<double, 6, 1>>(solutions.q[k]);
  return {count, solutions.complete};
}

}  // namespace beeline
