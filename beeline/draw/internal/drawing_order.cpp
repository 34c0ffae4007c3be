#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include <beeline/draw/internal/drawing_order.h>

namespace beeline::internal {
namespace {

constexpr std::size_t directions = 8;

/// The marks of one source, with their extent in several directions on paper.
struct Group {
  std::size_t begin = 0, end = 0;
  std::array<double, directions> low, high;
};

void include(Group& group, const PaperMark& mark) {
  const auto* stroke = std::get_if<PaperStroke>(&mark);
  const double around = stroke == nullptr ? 100 : stroke->width / 2 + 1;  // texts: far too much
  const std::vector<PaperPoint> centre{stroke == nullptr ? std::get<PaperText>(mark).centre
                                                         : PaperPoint::Zero()};
  const std::vector<PaperPoint>& points = stroke == nullptr ? centre : stroke->path.points;
  for (std::size_t d = 0; d < directions; ++d) {
    const double angle = std::numbers::pi * static_cast<double>(d) / directions;
    const PaperPoint direction(std::cos(angle), std::sin(angle));
    for (const PaperPoint& p : points) {
      group.low[d] = std::min(group.low[d], p.dot(direction) - around);
      group.high[d] = std::max(group.high[d], p.dot(direction) + around);
    }
  }
}

std::vector<Group> groups_of(const std::vector<FrameMark>& marks) {
  std::vector<Group> groups;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    if (i == 0 || marks[i].source != marks[i - 1].source) {
      Group group{i, i, {}, {}};
      group.low.fill(1e300);
      group.high.fill(-1e300);
      groups.push_back(group);
    }
    groups.back().end = i + 1;
    include(groups.back(), marks[i].mark);
  }
  return groups;
}

bool overlap(const Group& a, const Group& b) {
  for (std::size_t d = 0; d < directions; ++d) {
    if (a.low[d] > b.high[d] || b.low[d] > a.high[d]) return false;
  }
  return true;
}

}  // namespace

void keep_order(const std::vector<FrameMark>& before, std::vector<FrameMark>& frame) {
  std::map<MarkSource, std::size_t> rank;
  for (const FrameMark& mark : before) rank.emplace(mark.source, rank.size());
  const std::vector<Group> groups = groups_of(frame);
  std::vector<std::size_t> ranks;
  for (const Group& group : groups) {
    const auto found = rank.find(frame[group.begin].source);
    if (found == rank.end()) return;
    ranks.push_back(found->second);
  }
  if (std::is_sorted(ranks.begin(), ranks.end())) return;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    for (std::size_t j = i + 1; j < groups.size(); ++j) {
      if (ranks[i] > ranks[j] && overlap(groups[i], groups[j])) return;
    }
  }
  std::vector<std::size_t> order(groups.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return ranks[a] < ranks[b]; });
  std::vector<FrameMark> sorted;
  for (const std::size_t i : order) {
    for (std::size_t n = groups[i].begin; n < groups[i].end; ++n) {
      sorted.push_back(std::move(frame[n]));
    }
  }
  frame = std::move(sorted);
}

}  // namespace beeline::internal
