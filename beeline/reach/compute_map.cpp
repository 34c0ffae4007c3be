#include <algorithm>

#include <beeline/internal/budget_meter.h>
#include <beeline/reach/internal/map_file.h>
#include <beeline/reach/internal/map_header.h>
#include <beeline/reach/internal/parts.h>
#include <beeline/reach/reach_map.h>

namespace beeline {
namespace {

/// The header of a file of a map. Throws Error for what has no map, or none in a file.
ReachMapHeader header_of(const Arm& arm, const ReachGrid& grid, const ReachOptions& options) {
  if (options.blocked_by && (!options.scene || options.scene->digest.empty())) {
    throw Error::of("scene", "a file of a map with blocked_by needs the digest of its scene");
  }
  if (options.scene && !options.blocked_by) {
    throw Error::of("blocked_by", "a map of a scene needs what is blocked there");
  }
  (void)reach_cells(arm, grid, 0, 0, options);  // refuses what has no map
  return {arm, grid, options.redundant_values, options.samples, options.scene};
}

std::vector<internal::SlabRange> units_of(const ReachShard& shard, const ReachMapHeader& header) {
  if (shard.number < 1 || shard.number > shard.count) {
    throw Error::of("shard", "shard " + std::to_string(shard.number) + " of " +
                                 std::to_string(shard.count) +
                                 " does not exist; the first one is 1/" +
                                 std::to_string(std::max(1, shard.count)));
  }
  const std::vector<internal::SlabRange> all = internal::units_of(header);
  const auto number = static_cast<std::size_t>(shard.number);
  const auto count = static_cast<std::size_t>(shard.count);
  std::vector<internal::SlabRange> units;
  for (std::size_t k = number - 1; k < all.size(); k += count) units.push_back(all[k]);
  return units;
}

/// Whether a file belongs to the map and has the slabs.
bool holds(const std::string& path, const std::vector<internal::SlabRange>& units,
           const ReachMapHeader& header) {
  try {
    const ReachMap map(path);
    internal::check_same_map(path, map.header(), header);
    return std::all_of(units.begin(), units.end(), [&map](const internal::SlabRange& unit) {
      const auto begin = map.slabs().begin();
      return std::all_of(begin + unit.first, begin + unit.last, [](bool filled) { return filled; });
    });
  } catch (const Error&) {
    return false;
  }
}

/// Computes the units whose files are not there.
Ending compute_units(internal::Parts& parts, const std::vector<internal::SlabRange>& units,
                     const ReachOptions& options) {
  internal::BudgetMeter budget(options.budget);
  const auto fraction = [&units](std::size_t i) {
    return static_cast<double>(i) / static_cast<double>(units.size());
  };
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (budget.ended()) return budget.ending();
    if (!parts.has(units[i])) {
      ReachOptions unit = options;
      unit.budget = budget.part(fraction(i), fraction(i + 1));
      const Ending ending = parts.compute(units[i], unit);
      if (ending != Ending::complete) return ending;
    }
    budget.report(fraction(i + 1));
  }
  return Ending::complete;
}

Ending compute_file(const std::vector<internal::SlabRange>& units, const ReachMapHeader& header,
                    const std::string& path, const ReachOptions& options) {
  internal::Parts parts(path, header);
  const Ending ending = compute_units(parts, units, options);
  parts.finish();
  if (ending != Ending::complete) return ending;
  parts.join(units, path);
  parts.remove();
  return ending;
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
  const ReachMapHeader header = header_of(arm, grid, options.reach);
  const std::vector<internal::SlabRange> units = units_of(options.shard, header);
  try {
    return compute_file(units, header, path, options.reach);
  } catch (const FileError&) {
    if (!holds(path, units, header)) throw;  // another process has joined the same slabs
    return Ending::complete;
  }
}

struct ReachMapUnits::Work {
  ReachMapHeader header;
  std::string path;
  ReachOptions options;
  std::vector<internal::SlabRange> units;
  internal::Parts parts;
};

ReachMapUnits::ReachMapUnits(const Arm& arm, const ReachGrid& grid, const std::string& path,
                             const ReachOptions& options) {
  const ReachMapHeader header = header_of(arm, grid, options);
  work_.reset(new Work{header, path, options, internal::units_of(header), {path, header}});
}

ReachMapUnits::~ReachMapUnits() = default;

std::vector<Eigen::Index> ReachMapUnits::missing() const {
  std::vector<Eigen::Index> missing;
  for (std::size_t k = 0; k < work_->units.size(); ++k) {
    if (!work_->parts.has(work_->units[k])) missing.push_back(static_cast<Eigen::Index>(k));
  }
  return missing;
}

Ending ReachMapUnits::compute(const std::function<std::optional<Eigen::Index>()>& next) {
  internal::BudgetMeter budget(work_->options.budget);
  Ending ending = Ending::complete;
  while (const std::optional<Eigen::Index> unit = next()) {
    if (ending != Ending::complete) continue;
    ReachOptions options = work_->options;
    options.budget = budget.part();
    ending = work_->parts.compute(work_->units.at(static_cast<std::size_t>(*unit)), options);
  }
  work_->parts.finish();
  return ending;
}

void ReachMapUnits::join() {
  work_->parts.join(work_->units, work_->path);
  work_->parts.remove();
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
                "; option incomplete joins them nevertheless");
  }
  writer.commit();
}

}  // namespace beeline
