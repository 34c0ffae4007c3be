#include <beeline/reason/reason_text.h>

namespace beeline::internal {

std::string reach_sentence(const ReasonText& reason) {
  using enum ReasonField;
  const auto mounts = [&](ReasonField field) {
    return reason.number(field) + (reason.number(field) == "1" ? " mount" : " mounts");
  };
  switch (reason.code()) {
    case ReasonCode::ended_in_batch:
      return reason.ended() + " after " + reason.number(count) +
             (reason.number(count) == "1" ? " row" : " rows") +
             (reason.is(without_file) ? "; no file is written" : "") + reason.how_to_continue();
    case ReasonCode::ended_in_map:
      return reason.ended() + ": the slabs computed so far are in " + reason.text(parts) +
             "; the same command continues" +
             (reason.how_to_continue().empty()
                  ? ""
                  : ", with a larger limit if it has completed no slab");
    case ReasonCode::poses_too_far_apart:
      return "the poses are farther apart than the arm reaches";
    case ReasonCode::no_mount_reaches:
      return std::string("the arm reaches all poses ") +
             (reason.details().empty() ? "" : "with free solutions ") + "from none of the " +
             reason.number(count) +
             (reason.number(count) == reason.number(of) ? " mounts"
                                                        : " mounts that the map ranks first") +
             (reason.details().empty()
                  ? ""
                  : "; at the first one that reaches them: " + sentence(reason.required_detail()));
    case ReasonCode::no_mount_moves_in_lines:
      return "the arm reaches all poses from " + mounts(of) +
             ", but moves in straight lines from none of the " + reason.number(count) + " best";
    default:
      return "";
  }
}

}  // namespace beeline::internal
