#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <beeline/error.h>
#include <beeline/io/text/file.h>

#include "format.h"
#include "json_reason.h"
#include "scene_argument.h"

namespace beeline::command {
namespace {

std::string pair_text(const NamedPair& pair) { return pair[0] + " and " + pair[1]; }

Json json_pairs(const std::vector<NamedPair>& pairs) {
  Json list = Json::list();
  for (const NamedPair& pair : pairs) list.append(std::vector<std::string>{pair[0], pair[1]});
  return list;
}

/// The options that exempt pairs: the first one, which the reason names, and pairs of two links.
std::string allow_options(const CheckedScene& scene, const std::vector<NamedPair>& too_close) {
  constexpr std::size_t most = 10;
  const std::vector<std::string>& links = scene.links;
  const auto is_link = [&](const std::string& name) {
    return std::find(links.begin(), links.end(), name) != links.end();
  };
  std::string text;
  std::size_t count = 0;
  for (const NamedPair& pair : too_close) {
    const bool listed = count == 0 || (is_link(pair[0]) && is_link(pair[1]));
    if (!listed || count == most) continue;
    text += " --allow " + shell_word(pair[0] + "," + pair[1]);
    ++count;
  }
  return text;
}

std::string held_text(const std::map<std::string, double>& held) {
  std::vector<std::string> texts;
  for (const auto& [joint, value] : held) texts.push_back(joint + " at " + shown(value));
  return listed(texts);
}

/// The joints of the arm's file that are held, with the named states that give their values.
std::vector<SceneLine> held_lines(const CheckedScene& scene) {
  std::map<std::string, std::map<std::string, double>> by_state;  // empty: of no state
  for (const auto& [joint, value] : scene.held) {
    const auto state = scene.held_by_state.find(joint);
    by_state[state == scene.held_by_state.end() ? "" : state->second].emplace(joint, value);
  }
  std::vector<SceneLine> lines;
  for (const auto& [state, held] : by_state) {
    const std::string source = state.empty() ? "" : " (state " + state + " of " + scene.srdf + ")";
    lines.push_back({"held", held_text(held) + source});
  }
  return lines;
}

std::string pairs_text(const std::vector<NamedPair>& pairs) {
  std::vector<std::string> texts;
  for (const NamedPair& pair : pairs) texts.push_back(pair_text(pair));
  return fmt::format("{}", fmt::join(texts, ", "));
}

/// The pairs that may touch: each allowed pair, pairs of the SRDF file, and neighbours.
std::vector<SceneLine> exempted_lines(const CheckedScene& scene) {
  std::vector<SceneLine> lines;
  for (const NamedPair& pair : scene.allowed_pairs) {
    lines.push_back({"may touch", pair_text(pair)});
  }
  if (!scene.srdf_pairs.empty()) {
    lines.push_back({"may touch", "by " + (scene.srdf.empty() ? "the arm's file" : scene.srdf) +
                                      ": " + pairs_text(scene.srdf_pairs)});
  }
  if (!scene.exempted_pairs.empty()) {
    lines.push_back({"may touch", "by the scene's matrix: " + pairs_text(scene.exempted_pairs)});
  }
  const std::vector<NamedPair> neighbours = scene.model.neighbour_pairs();
  if (!scene.self_collision) {
    lines.push_back({"may touch", "by --no-self: all pairs of links"});
  } else if (!neighbours.empty()) {
    lines.push_back({"may touch", "at a joint: " + pairs_text(neighbours)});
  }
  return lines;
}

/// The bodies with meshes, each once.
std::vector<std::string> bodies_with_meshes(const CheckedScene& scene) {
  std::vector<std::string> bodies;
  for (const MeshHull& hull : scene.mesh_hulls) {
    if (bodies.empty() || bodies.back() != hull.body) bodies.push_back(hull.body);
  }
  return bodies;
}

SceneLine meshes_line(const CheckedScene& scene) {
  double padding = 0;
  for (const MeshHull& hull : scene.mesh_hulls) padding = std::max(padding, hull.padding);
  const std::string grown =
      padding > 0 ? fmt::format(", grown by at most {} m", shown(rounded_up(padding, 2))) : "";
  return {"meshes", fmt::format("taken as their convex hulls{}: {}", grown,
                                listed(bodies_with_meshes(scene)))};
}

/// The clause of a collision that names which of the two bodies are hulls of meshes.
std::string hulls_clause(const CheckedScene& scene, const NamedPair& pair) {
  std::vector<std::string> names;
  for (const std::string& body : bodies_with_meshes(scene)) {
    if (body == pair[0] || body == pair[1]) names.push_back(body);
  }
  if (names.empty()) return "";
  return names.size() == 1 ? "; the mesh of " + names[0] + " is taken as its convex hull"
                           : "; the meshes of " + names[0] + " and " + names[1] +
                                 " are taken as their convex hulls";
}

Json json_hulls(const std::vector<MeshHull>& hulls) {
  Json list = Json::list();
  for (const MeshHull& hull : hulls) {
    list.append(Json{{"body", hull.body},
                     {"mesh", hull.mesh},
                     {"vertices", hull.vertices},
                     {"padding", hull.padding}});
  }
  return list;
}

Json json_held(const std::map<std::string, double>& held) {
  Json values = Json::object();
  for (const auto& [joint, value] : held) values.add(joint, value);
  return values;
}

/// A line for each part that is attached: from when, until when, and what it may touch.
std::vector<SceneLine> attached_lines(const ClearanceReport& report) {
  std::vector<SceneLine> lines;
  for (std::size_t i = 0; i < report.attached.size(); ++i) {
    const Attachment& attachment = report.attachments[i];
    const AttachedPart& part = report.attached[i];
    std::string text =
        fmt::format("{} from {} s ({})", part.part, shown(part.attached), attachment.place);
    if (part.detached) {
      text += fmt::format(" to {} s ({})", shown(*part.detached), attachment.detach_place);
    }
    if (!part.touch.empty()) text += "; may touch " + listed(part.touch);
    lines.push_back({"attached", std::move(text)});
  }
  return lines;
}

Json json_attached(const ClearanceReport& report) {
  Json list = Json::list();
  for (std::size_t i = 0; i < report.attached.size(); ++i) {
    const Attachment& attachment = report.attachments[i];
    const AttachedPart& part = report.attached[i];
    const bool detached = part.detached.has_value();
    list.append(Json{{"part", part.part},
                     {"row", attachment.line},
                     {"place", attachment.place},
                     {"time", part.attached},
                     {"detach_place", detached ? Json(attachment.detach_place) : Json()},
                     {"detach_time", detached ? Json(*part.detached) : Json()},
                     {"tool_T_part", json_matrix(part.tool_T_part.matrix())},
                     {"touch", part.touch}});
  }
  return list;
}

Json json_clearance_recovery(const ClearanceProof& proof) {
  if (!proof || !proof.recovery) return nullptr;
  const ClearanceRecovery& recovery = *proof.recovery;
  return {{"pair", std::vector<std::string>{recovery.names[0], recovery.names[1]}},
          {"depth", recovery.depth},
          {"distance", recovery.distance},
          {"pairs", recovery.pairs},
          {"sample", recovery.sample + 1},
          {"time", recovery.time}};
}

/// How a contact is exempted: in the row that attaches one of the two bodies, if it is attached
/// then, or by options.
std::string exemption(const ClearanceReport& report) {
  const ClearanceProof& proof = report.proof;
  for (std::size_t i = 0; i < report.attached.size(); ++i) {
    const AttachedPart& part = report.attached[i];
    const bool held =
        part.attached <= proof.time && (!part.detached || proof.time < *part.detached);
    const bool is_first = proof.pair.names[0] == part.part;
    if (!held || (!is_first && proof.pair.names[1] != part.part)) continue;
    return "name " + proof.pair.names[is_first ? 1 : 0] + " in the column touch of " +
           report.attachments[i].place;
  }
  return "exempt it by" + allow_options(*report.scene, report.too_close);
}

}  // namespace

MotionStatus ClearanceReport::refusal() const {
  switch (proof.status) {
    case ClearanceStatus::clear:
      return MotionStatus::reached;
    case ClearanceStatus::collides:
      return MotionStatus::collides;
    case ClearanceStatus::not_decided:
      return MotionStatus::not_decided;
    case ClearanceStatus::time_limit:
      return MotionStatus::time_limit;
    case ClearanceStatus::cancelled:
      return MotionStatus::cancelled;
    case ClearanceStatus::work_limit:
      return MotionStatus::work_limit;
  }
  return MotionStatus::not_decided;
}

void ClearanceReport::add_search_ending(const Reason& of_motion) {
  const ReasonValue* ending = of_motion.find(ReasonField::search_ending);
  if (ending != nullptr) proof.reason.set(ReasonField::search_ending, *ending);
}

std::string ClearanceReport::reason_text() const {
  const std::string text = sentence(proof.reason);
  if (proof.status != ClearanceStatus::collides) return text + start_clause;
  return text + hulls_clause(*scene, proof.pair.names) + start_clause +
         "; if this contact is meant, " + exemption(*this);
}

bool ClearanceReport::checks_nothing() const {
  if (!attached.empty()) return proof.pairs == 0;
  return proof.pairs == 0 && scene->model.apart_count() == 0;
}

std::string ClearanceReport::guarantee() const {
  if (proof.pairs == 0) return "no pair of bodies meets within the joint limits";
  const std::string least = shown(rounded_down(proof.least_distance, 6));
  if (!attached.empty()) return fmt::format("all pairs that count keep at least {} m", least);
  if (proof.pairs == 1) return fmt::format("the pair that counts keeps at least {} m", least);
  return fmt::format("each of the {} pairs that count keeps at least {} m", proof.pairs, least);
}

std::vector<SceneLine> conditions(const CheckedScene& scene) {
  std::vector<SceneLine> lines = exempted_lines(scene);
  for (SceneLine& line : held_lines(scene)) lines.push_back(std::move(line));
  for (const auto& [path, held] : scene.scenes_held) {
    lines.push_back({"held", held_text(held) + " (" + path + ")"});
  }
  if (!scene.mesh_hulls.empty()) lines.push_back(meshes_line(scene));
  if (!scene.links_without_shapes.empty()) {
    lines.push_back({"no shapes", listed(scene.links_without_shapes)});
  }
  for (const auto& [path, links] : scene.scenes_without_shapes) {
    lines.push_back({"no shapes", listed(links) + " (" + path + ")"});
  }
  return lines;
}

std::string ClearanceReport::when() const {
  return proof.recovery ? "from " + shown(proof.recovery->time) + " s on" : "at all times";
}

std::vector<SceneLine> ClearanceReport::recovery() const {
  if (!proof || !proof.recovery) return {};
  const ClearanceRecovery& out = *proof.recovery;
  const std::string others =
      out.pairs == 1 ? "" : fmt::format(", the deepest of {} pairs", out.pairs);
  return {{"recovery", fmt::format("starts {} m closer than the clearance, {}{}; out of it {}",
                                   shown(out.depth), pair_text(out.names), others, when())}};
}

std::vector<SceneLine> ClearanceReport::conditions() const {
  std::vector<SceneLine> lines = attached_lines(*this);
  for (SceneLine& line : command::conditions(*scene)) lines.push_back(std::move(line));
  return lines;
}

std::string exemption_clause(const CheckedScene& scene, const ConfigurationRef& q) {
  std::vector<NamedPair> names;
  for (const BodyDistance& pair : pairs_too_close(scene.model, q)) names.push_back(pair.names);
  if (names.empty()) return "";
  return "; if this contact is meant, exempt it by" + allow_options(scene, names);
}

std::string number_of_bodies(const CheckedScene& scene) {
  return counted(static_cast<std::int64_t>(scene.links.size()), "link") + " and " +
         counted(static_cast<std::int64_t>(scene.obstacles.size()), "obstacle");
}

std::string lines_text(const std::vector<SceneLine>& lines) {
  std::string text;
  for (const SceneLine& line : lines) text += fmt::format("{:<14}{}\n", line.label, line.text);
  return text;
}

Json conditions_document(const CheckedScene& scene) {
  Json document{{"self_collision", scene.self_collision},
                {"neighbour_pairs", json_pairs(scene.model.neighbour_pairs())},
                {"links", scene.links},
                {"obstacles", scene.obstacles},
                {"allowed_pairs", json_pairs(scene.allowed_pairs)},
                {"srdf_pairs", json_pairs(scene.srdf_pairs)},
                {"exempted_pairs", json_pairs(scene.exempted_pairs)},
                {"held", json_held(scene.held)}};
  Json held_by_state = Json::object();
  for (const auto& [joint, state] : scene.held_by_state) held_by_state.add(joint, state);
  document.add("held_by_state", held_by_state);
  Json scenes_held = Json::object();
  for (const auto& [path, values] : scene.scenes_held) scenes_held.add(path, json_held(values));
  document.add("scenes_held", scenes_held);
  document.add("mesh_hulls", json_hulls(scene.mesh_hulls));
  document.add("links_without_shapes", scene.links_without_shapes);
  Json scenes_without = Json::object();
  for (const auto& [path, links] : scene.scenes_without_shapes) scenes_without.add(path, links);
  document.add("scenes_without_shapes", scenes_without);
  return document;
}

std::string ClearanceReport::text() const {
  std::string text;
  if (proof && checks_nothing()) {
    text += "clearance     nothing was checked: no pair of bodies counts\n";
  } else if (proof) {
    text += fmt::format("clearance     kept {}, proved; {}\n", when(), guarantee());
  }
  text += lines_text(recovery());
  if (proof && !proof.pair.names[0].empty()) {
    text +=
        fmt::format("closest       {}: {} m at {} s, {} m are required\n", names_text(proof.pair),
                    shown(proof.pair.upper), shown(proof.time), shown(proof.pair.clearance));
  }
  if (!picture.empty()) {
    text += fmt::format("picture       {}: the arm at {} s\n", picture, shown(proof.time));
  }
  const std::string bodies = number_of_bodies(*scene);
  const std::size_t apart = scene->model.apart_count();
  if (!attached.empty()) {
    return text + fmt::format("pairs         at most {} at a time, of {}\n", proof.pairs, bodies) +
           lines_text(conditions());
  }
  text += fmt::format("pairs         {} of {}", proof.pairs, bodies);
  if (proof.pairs > scene->model.pair_count()) {
    text +=
        fmt::format("; {} of them only outside the joint limits, which the motion leaves", apart);
  } else if (apart > 0) {
    text += fmt::format("; {} more never meet within the joint limits, proved", apart);
  }
  return text + "\n" + lines_text(conditions());
}

Json ClearanceReport::document() const {
  const bool has_pair = !proof.pair.names[0].empty();
  const bool undecided = proof.status == ClearanceStatus::not_decided;
  Json document{
      {"status", name(proof.status)},
      {"clearance", clearance},
      {"least_distance", proof ? Json(proof.least_distance) : Json()},
      {"pair", has_pair ? Json(std::vector<std::string>{proof.pair.names[0], proof.pair.names[1]})
                        : Json()},
      {"point", has_pair && proof.pair.point ? Json(*proof.pair.point) : Json()},
      {"time", has_pair ? Json(proof.time) : Json()},
      {"lower", has_pair ? Json(proof.pair.lower) : Json()},
      {"upper", has_pair ? Json(proof.pair.upper) : Json()},
      {"on_first", has_pair ? Json(Eigen::VectorXd(proof.pair.on_first)) : Json()},
      {"on_second", has_pair ? Json(Eigen::VectorXd(proof.pair.on_second)) : Json()},
      {"normal", has_pair ? Json(Eigen::VectorXd(proof.pair.normal)) : Json()},
      {"begin", undecided ? Json(proof.begin) : Json()},
      {"end", undecided ? Json(proof.end) : Json()}};
  document.add("recovery", json_clearance_recovery(proof));
  document.add("picture", picture.empty() ? Json() : Json(picture));
  document.add("too_close", json_pairs(too_close));
  document.add("nothing_checked", checks_nothing());
  document.add("pairs", proof.pairs);
  const std::size_t all = scene->model.pair_count() + scene->model.apart_count();
  document.add("apart_pairs", attached.empty() ? Json(all - proof.pairs) : Json());
  document.add("attachments", json_attached(*this));
  document.add(conditions_document(*scene));
  document.add("reason", reason_text());
  document.add(reason_members(proof.reason));
  return document;
}

}  // namespace beeline::command
