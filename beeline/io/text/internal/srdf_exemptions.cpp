#include <algorithm>
#include <set>
#include <unordered_set>

#include <beeline/io/text/scene.h>

namespace beeline {
namespace {

NamedPair in_order(const NamedPair& pair) {
  return {std::min(pair[0], pair[1]), std::max(pair[0], pair[1])};
}

}  // namespace

std::vector<NamedPair> exempted_pairs(const Srdf& srdf, const std::vector<LinkShapes>& links) {
  std::unordered_set<std::string> names;
  for (const LinkShapes& body : links) names.insert(body.name);
  std::set<NamedPair> enabled, known;
  for (const NamedPair& pair : srdf.enabled_collisions) enabled.insert(in_order(pair));
  std::vector<NamedPair> exempted;
  const auto exempt = [&](const NamedPair& pair) {
    const bool counts = names.contains(pair[0]) && names.contains(pair[1]) && pair[0] != pair[1];
    if (counts && known.insert(in_order(pair)).second) exempted.push_back(pair);
  };
  for (const NamedPair& pair : srdf.disabled_collisions) exempt(pair);
  const std::set<std::string> disabled(srdf.disabled_links.begin(), srdf.disabled_links.end());
  for (const std::string& link : disabled) {
    if (!names.contains(link)) continue;
    for (const LinkShapes& body : links) {
      if (!enabled.contains(in_order({link, body.name}))) exempt({link, body.name});
    }
  }
  return exempted;
}

}  // namespace beeline
