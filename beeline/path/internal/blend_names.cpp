#include <beeline/path/internal/blend_names.h>

namespace beeline::internal {

std::vector<std::string> blend_names(const BlendedPath& blended, const PoseNumbers& numbers) {
  const auto number_of = [&](std::size_t pose) {
    return std::to_string(numbers.start_first ? pose : pose + 1);
  };
  const auto name_of = [&](std::size_t pose) {
    return numbers.start_first && pose == 0 ? "start" : numbers.noun + " " + number_of(pose);
  };
  const std::size_t lines = blended.lines.back() + 1;
  std::vector<std::string> names;
  for (std::size_t k = 0; k < blended.lines.size(); ++k) {
    const std::size_t i = blended.lines[k];
    if (std::holds_alternative<SplineSegment>(blended.path.segments[k])) {
      names.push_back("the blend at " + name_of(i + 1));
      continue;
    }
    const bool from_start = numbers.start_first && i == 0;
    names.push_back("line " + std::to_string(i + 1) + " of " + std::to_string(lines) + " (" +
                    name_of(i) + " to " + (from_start ? name_of(1) : number_of(i + 1)) + ")");
  }
  return names;
}

}  // namespace beeline::internal
