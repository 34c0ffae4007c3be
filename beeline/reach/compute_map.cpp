#include <algorithm>

#include <beeline/internal/budget_meter.h>
#include <beeline/reach/compute_map.h>
#include <beeline/reach/internal/map_file.h>
#include <beeline/reach/internal/map_header.h>
#include <beeline/reach/internal/parts.h>

namespace beeline {
namespace {

std::vector<Eigen::Index> slabs_of(const ReachShard& shard, Eigen::Index count) {
  if (shard.number < 1 || shard.number > shard.count) {
    throw Error("shard " + std::to_string(shard.number) + " of " + std::to_string(shard.count) +
                " does not exist; the first one is 1/" + std::to_string(std::max(1, shard.count)));
  }
  if (shard.count > count) {
    throw Error("the map has " + std::to_string(count) + " slabs, which is the largest number of " +
                "shards, not " + std::to_string(shard.count));
  }
  std::vector<Eigen::Index> slabs;
  for (Eigen::Index s = shard.number - 1; s < count; s += shard.count) slabs.push_back(s);
  return slabs;
}

/// "3, 7 and 12 more".
std::string listed_slabs(const std::vector<std::size_t>& slabs) {
  constexpr std::size_t most = 8;
  std::string text;
  for (std::size_t i = 0; i < std::min(slabs.size(), most); ++i) {
    text += (i == 0 ? "" : ", ") + std::to_string(slabs[i]);
  }
  return slabs.size() <= most ? text
                              : text + " and " + std::to_string(slabs.size() - most) + " more";
}

}  // namespace

Ending compute_reach_map(const Arm& arm, const ReachGrid& grid, const std::string& path,
                         const ReachMapOptions& options) {
  const std::vector<Eigen::Index> slabs = slabs_of(options.shard, internal::Slabs(grid).count());
  (void)reach_cells(arm, grid, 0, 0, options.reach);  // refuses what has no map
  const internal::Parts parts(path, {arm, grid, options.reach.redundant_values});
  internal::BudgetMeter budget(options.reach.budget);
  const auto fraction = [&slabs](std::size_t i) {
    return static_cast<double>(i) / static_cast<double>(slabs.size());
  };
  for (std::size_t i = 0; i < slabs.size(); ++i) {
    if (budget.ended()) return budget.ending();
    if (!parts.has(slabs[i])) {
      ReachOptions slab = options.reach;
      slab.budget = budget.part(fraction(i), fraction(i + 1));
      const Ending ending = parts.compute(slabs[i], slab);
      if (ending != Ending::complete) return ending;
    }
    if (budget.reports()) budget.report(fraction(i + 1));
  }
  parts.join(slabs, path);
  parts.remove();
  return Ending::complete;
}

void merge_reach_maps(const std::vector<std::string>& parts, const std::string& path,
                      bool incomplete) {
  if (parts.empty()) throw Error("there are no parts to join");
  const ReachMapHeader header =
      internal::read_header({parts.front(), internal::Hdf5File::Mode::read}, parts.front());
  internal::MapWriter writer(path, header);
  for (const std::string& part : parts) writer.copy_slabs(part);
  std::vector<std::size_t> missing;
  for (std::size_t s = 0; s < writer.slabs().size(); ++s) {
    if (!writer.slabs()[s]) missing.push_back(s);
  }
  if (!missing.empty() && !incomplete) {
    throw Error("the parts lack " + std::to_string(missing.size()) + " of " +
                std::to_string(writer.slabs().size()) + " slabs: " + listed_slabs(missing) +
                "; `incomplete` joins them nevertheless");
  }
  writer.commit();
}

}  // namespace beeline
