#include "branch_table.h"

#include <fmt/core.h>

using namespace beeline;

void print_branches(const Arm& arm, const std::vector<Branch>& branches, const UnitArgument& unit) {
  fmt::print("branches      {}\n", branches.size());
  if (branches.empty()) return;
  fmt::print("   # pieces done  margin  inv. cond.  start ({})\n", unit.name());
  for (std::size_t i = 0; i < branches.size(); ++i) {
    const Branch& branch = branches[i];
    fmt::print("  {:>2}  {:>10}  {:>4.0f} %  {:>10}  {}\n", i + 1, shown(branch.path_parameter),
               100 * branch.limit_margin, shown(branch.dexterity),
               shown(unit.shown(arm, branch.start)));
    if (!branch.reason.empty()) fmt::print("      {}: {}\n", name(branch.status), branch.reason);
  }
}

OrderedJson json_branches(const Arm& arm, const std::vector<Branch>& branches,
                          const UnitArgument& unit) {
  OrderedJson list = OrderedJson::array();
  for (const Branch& branch : branches) {
    list.push_back({{"start", json_vector(unit.shown(arm, branch.start))},
                    {"status", name(branch.status)},
                    {"done", branch.path_parameter},
                    {"limit_margin", json_number(branch.limit_margin)},
                    {"dexterity", json_number(branch.dexterity)},
                    {"reason", branch.reason}});
  }
  return list;
}
