#pragma once

#include <gtest/gtest.h>
#include <optional>

#include <beeline/reason.h>

namespace beeline::testing {

/// The value of a field of a reason; none where it has no such field.
template <class T>
std::optional<T> field(const Reason& reason, ReasonField name) {
  const ReasonValue* value = reason.find(name);
  if (value == nullptr) return {};
  EXPECT_TRUE(std::holds_alternative<T>(*value)) << beeline::name(name);
  return std::get<T>(*value);
}

/// The name of its joint.
inline std::string joint(const Reason& reason) {
  return field<std::string>(reason, ReasonField::joint).value_or("");
}

}  // namespace beeline::testing
