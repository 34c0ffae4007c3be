#include <algorithm>

#include <beeline/error.h>
#include <beeline/read/internal/name.h>
#include <beeline/read/internal/pose_form.h>
#include <beeline/read/pose_list.h>

namespace beeline::internal {
namespace {

using Names = std::vector<std::string>;

bool contains(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Returns the names of `wanted` that `present` lacks.
Names missing_from(const Names& present, const Names& wanted) {
  Names missing;
  for (const std::string& name : wanted) {
    if (!contains(present, name)) missing.push_back(name);
  }
  return missing;
}

}  // namespace

const Names& pose_form_of(const Names& header) {
  const std::string known = std::string("; poses are ") + known_forms + "; programs also have " +
                            listed(program_columns());
  const auto distance = [&header](const Names& form) {
    return missing_from(header, form).size() + missing_from(form, header).size();
  };
  for (const std::string& name : header) {
    const bool is_known =
        std::any_of(pose_forms().begin(), pose_forms().end(),
                    [&](const Names& candidate) { return contains(candidate, name); });
    if (!is_known) throw Error("unknown column " + in_quotes(name) + known);
  }
  for (const Names& form : pose_forms()) {
    if (distance(form) == 0) return form;
  }
  const Names& form =  // the nearest with an orientation
      *std::min_element(pose_forms().begin(), pose_forms().begin() + 3,
                        [&](const Names& a, const Names& b) { return distance(a) < distance(b); });
  const Names missing = missing_from(header, form);
  if (!missing.empty()) throw Error("column " + listed(missing) + " is missing" + known);
  const Names extra = missing_from(form, header);
  if (!extra.empty()) {
    throw Error("column " + listed(extra) + " does not belong to " + listed(form) + known);
  }
  return form;
}

}  // namespace beeline::internal
