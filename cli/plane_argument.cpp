#include "plane_argument.h"

#include <beeline/error.h>
#include <beeline/io/text/numbers.h>

namespace beeline::command {
namespace {

constexpr ReachMeasure measures[] = {ReachMeasure::directions, ReachMeasure::branches,
                                     ReachMeasure::manipulability, ReachMeasure::margin};

}  // namespace

std::vector<Option> PlaneArgument::options(bool required) {
  std::vector<std::string> names;
  for (const ReachMeasure measure : measures) names.push_back(name(measure));
  return {
      Option("--at PLANE", "The plane: x=, y= or z= and a coordinate, m.", &plane_,
             {.required = required}),
      Option("--measure MEASURE", "What is shown of a position.", &measure_, {.choices = names})};
}

// "z=0.3"
int PlaneArgument::normal() const {
  const std::size_t axis = plane_.empty() ? std::string::npos : std::string("xyz").find(plane_[0]);
  if (axis == std::string::npos || plane_.size() < 3 || plane_[1] != '=') {
    throw Error("--at: \"" + plane_ + "\" is no plane, such as z=0.3");
  }
  return static_cast<int>(axis);
}

double PlaneArgument::at() const {
  (void)normal();  // refuses what is no plane
  return parse_number(plane_.substr(2), "--at");
}

ReachMeasure PlaneArgument::measure() const {
  for (const ReachMeasure measure : measures) {
    if (measure_ == name(measure)) return measure;
  }
  return ReachMeasure::directions;
}

}  // namespace beeline::command
