#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include <beeline/error.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/urdf_mimic.h>

namespace beeline::internal {
namespace {

using FileJoints = std::unordered_map<std::string, const UrdfFile::Joint*>;

/// Limits the first follower of a leader beside the chain to the values that the leader's range
/// gives it. A leader without a range, such as 0 to 0 of a file without numbers, is ignored.
void keep_within(const UrdfFile::Joint& leader, const Mimic& mimic, Limits& limits) {
  if (!has_one_dof(leader)) return;
  double lower = mimic.multiplier * leader.limits.lower + mimic.offset;
  double upper = mimic.multiplier * leader.limits.upper + mimic.offset;
  if (mimic.multiplier < 0) std::swap(lower, upper);
  lower = std::max(lower, limits.lower);
  upper = std::min(upper, limits.upper);
  if (lower < upper) {
    limits.lower = lower;
    limits.upper = upper;
  }
  for (double Limits::*const rate : {&Limits::velocity, &Limits::acceleration, &Limits::jerk}) {
    if (leader.limits.*rate < Limits::min_rate) continue;
    limits.*rate = std::min(limits.*rate, std::abs(mimic.multiplier) * (leader.limits.*rate));
  }
}

class LeaderResolution {
 public:
  LeaderResolution(const UrdfFile& file, std::vector<Joint>& joints)
      : joints_(joints), path_(file.path) {
    for (const UrdfFile::Joint& joint : file.joints) of_file_.emplace(joint.name, &joint);
    for (const Joint& joint : joints) on_chain_.insert(joint.name);
  }

  void run() {
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      if (!joints_[i].mimic) continue;
      joints_[i].mimic = resolved(joints_[i]);
      const Mimic& mimic = *joints_[i].mimic;
      if (!on_chain_.contains(mimic.leader)) followers_[mimic.leader].push_back(i);
    }
    for (auto& [leader, followers] : followers_) {
      std::sort(followers.begin(), followers.end(), [&](std::size_t a, std::size_t b) {
        return of_file_.at(joints_[a].name) < of_file_.at(joints_[b].name);  // in the file's order
      });
      eliminate(*of_file_.at(leader), followers);
    }
  }

 private:
  /// Follows the leaders beside the chain up to one on the chain, or to the last one: they have no
  /// leader_cycle.
  Mimic resolved(const Joint& joint) const {
    Mimic mimic = *joint.mimic;
    while (!on_chain_.contains(mimic.leader)) {
      const UrdfFile::Joint& leader = *of_file_.at(mimic.leader);
      if (!leader.mimic || !of_file_.contains(leader.mimic->leader)) return mimic;
      mimic = {leader.mimic->leader, mimic.multiplier * leader.mimic->multiplier,
               mimic.multiplier * leader.mimic->offset + mimic.offset};
    }
    return mimic;
  }

  void eliminate(const UrdfFile::Joint& leader, const std::vector<std::size_t>& followers) {
    if (is_free(leader)) {
      const UrdfFile::Joint& follower = *of_file_.at(joints_[followers.front()].name);
      throw FileError(path_, follower.mimic_line,
                      "joint " + follower.name + " mimics joint " + leader.name + ", which is " +
                          leader.type + " and has several coordinates; a leader has one");
    }
    const auto moves = [&](std::size_t i) { return joints_[i].mimic->multiplier != 0; };
    const auto first = std::find_if(followers.begin(), followers.end(), moves);
    const std::size_t coordinate = first == followers.end() ? followers.front() : *first;
    Joint& own = joints_[coordinate];
    const Mimic to_own = *own.mimic;
    own.mimic.reset();
    if (first != followers.end()) keep_within(leader, to_own, own.limits);
    for (const std::size_t i : followers) {
      if (i == coordinate) continue;
      Mimic& mimic = *joints_[i].mimic;
      const double ratio = to_own.multiplier == 0 ? 0 : mimic.multiplier / to_own.multiplier;
      mimic = {own.name, ratio, mimic.offset - ratio * to_own.offset};
    }
  }

  std::vector<Joint>& joints_;
  const std::string& path_;
  FileJoints of_file_;
  std::unordered_set<std::string> on_chain_;
  std::map<std::string, std::vector<std::size_t>> followers_;  // of a leader beside the chain
};

}  // namespace

void resolve_leaders(const UrdfFile& file, std::vector<Joint>& joints) {
  LeaderResolution(file, joints).run();
}

}  // namespace beeline::internal
