#include <algorithm>
#include <fmt/format.h>

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

/// The options that exempt pairs: the pair of the reason, and pairs of two links.
std::string allow_options(const ClearanceReport& report) {
  constexpr std::size_t most = 10;
  const std::vector<std::string>& links = report.scene->links;
  const auto is_link = [&](const std::string& name) {
    return std::find(links.begin(), links.end(), name) != links.end();
  };
  std::string text;
  std::size_t count = 0;
  for (const NamedPair& pair : report.too_close) {
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

/// Lines of the values of held joints: of the arm, and of each scene.
std::string held_lines(const CheckedScene& scene) {
  std::string text;
  if (!scene.held.empty()) text += fmt::format("held          {}\n", held_text(scene.held));
  for (const auto& [path, held] : scene.scenes_held) {
    text += fmt::format("held          {} ({})\n", held_text(held), path);
  }
  return text;
}

/// The bodies with meshes, each once.
std::vector<std::string> bodies_with_meshes(const CheckedScene& scene) {
  std::vector<std::string> bodies;
  for (const MeshHull& hull : scene.mesh_hulls) {
    if (bodies.empty() || bodies.back() != hull.body) bodies.push_back(hull.body);
  }
  return bodies;
}

std::string meshes_text(const CheckedScene& scene) {
  double padding = 0;
  for (const MeshHull& hull : scene.mesh_hulls) padding = std::max(padding, hull.padding);
  const std::string grown =
      padding > 0 ? fmt::format(", grown by at most {} m", shown(rounded_up(padding, 2))) : "";
  return fmt::format("meshes        taken as their convex hulls{}: {}\n", grown,
                     listed(bodies_with_meshes(scene)));
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

std::string ClearanceReport::reason_text() const {
  const std::string text = sentence(proof.reason);
  if (proof.status != ClearanceStatus::collides) return text;
  return text + hulls_clause(*scene, proof.pair.names) +
         "; if this contact is meant, exempt it by" + allow_options(*this);
}

std::string ClearanceReport::text() const {
  std::string text;
  if (proof && scene->model.pair_count() > 0) {
    text +=
        fmt::format("clearance     kept at all times, proved; all bodies are at least {} m apart\n",
                    shown(rounded_down(proof.least_distance, 6)));
    if (!proof.pair.names[0].empty()) {
      text += fmt::format("closest       {}: {} m at {} s, {} m are required\n",
                          pair_text(proof.pair.names), shown(proof.pair.upper), shown(proof.time),
                          shown(proof.pair.clearance));
    }
  }
  text += fmt::format("pairs         {} of {} and {}", scene->model.pair_count(),
                      counted(static_cast<std::int64_t>(scene->links.size()), "link"),
                      counted(static_cast<std::int64_t>(scene->obstacles.size()), "obstacle"));
  const std::size_t apart = scene->model.apart_count();
  if (apart > 0) text += fmt::format("; {} more never meet within the joint limits, proved", apart);
  text += "\n";
  for (const NamedPair& pair : scene->allowed_pairs) {
    text += fmt::format("may touch     {}\n", pair_text(pair));
  }
  if (!scene->srdf_pairs.empty()) {
    std::vector<std::string> pairs;
    for (const NamedPair& pair : scene->srdf_pairs) pairs.push_back(pair_text(pair));
    text += fmt::format("may touch     by {}: {}\n", scene->srdf, fmt::join(pairs, ", "));
  }
  text += held_lines(*scene);
  if (!scene->mesh_hulls.empty()) text += meshes_text(*scene);
  return text;
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
      {"time", has_pair ? Json(proof.time) : Json()},
      {"lower", has_pair ? Json(proof.pair.lower) : Json()},
      {"upper", has_pair ? Json(proof.pair.upper) : Json()},
      {"on_first", has_pair ? Json(Eigen::VectorXd(proof.pair.on_first)) : Json()},
      {"on_second", has_pair ? Json(Eigen::VectorXd(proof.pair.on_second)) : Json()},
      {"normal", has_pair ? Json(Eigen::VectorXd(proof.pair.normal)) : Json()},
      {"begin", undecided ? Json(proof.begin) : Json()},
      {"end", undecided ? Json(proof.end) : Json()}};
  document.add("too_close", json_pairs(too_close));
  document.add("pairs", scene->model.pair_count());
  document.add("apart_pairs", scene->model.apart_count());
  document.add("links", scene->links);
  document.add("obstacles", scene->obstacles);
  document.add("allowed_pairs", json_pairs(scene->allowed_pairs));
  document.add("srdf_pairs", json_pairs(scene->srdf_pairs));
  document.add("held", json_held(scene->held));
  Json scenes_held = Json::object();
  for (const auto& [path, values] : scene->scenes_held) scenes_held.add(path, json_held(values));
  document.add("scenes_held", scenes_held);
  document.add("mesh_hulls", json_hulls(scene->mesh_hulls));
  document.add("links_without_shapes", scene->links_without_shapes);
  document.add("reason", reason_text());
  document.add(reason_members(proof.reason));
  return document;
}

}  // namespace beeline::command
