#include "fault_report.h"

#include <fmt/format.h>

#include "format.h"
#include "json_reason.h"

namespace beeline::command {

std::string faults_text(const Verification& verification) {
  std::string text;
  for (const FaultsOfKind& faults : verification.faults) {
    const bool single = faults.worst == faults.first;
    text += fmt::format("fault         {}, first at {} s, sample {}{}\n", name(faults.kind),
                        shown(faults.time), faults.sample + 1,
                        single ? "" : "; worst " + sentence(faults.worst));
  }
  return text;
}

Json json_faults(const Verification& verification) {
  Json list = Json::list();
  for (const FaultsOfKind& faults : verification.faults) {
    list.append({{"fault", name(faults.kind)},
                 {"sample", faults.sample + 1},
                 {"time", faults.time},
                 {"first", json_reason(faults.first)},
                 {"worst", json_reason(faults.worst)},
                 {"amount", faults.amount}});
  }
  return list;
}

}  // namespace beeline::command
