#pragma once

#include <string>
#include <utility>

#include <beeline/error.h>

namespace beeline::testing {

/// The message with which `call` refuses, or "accepted" when it does not. Other exceptions pass.
template <class Call>
std::string refusal(Call&& call) {
  try {
    std::forward<Call>(call)();
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace beeline::testing

/// The call throws beeline::Error with one line that holds `culprit`.
#define EXPECT_REFUSED(call, culprit)                                                     \
  do {                                                                                    \
    const std::string refused = beeline::testing::refusal([&] { (void)(call); });         \
    EXPECT_NE(refused.find(culprit), std::string::npos) << #call << " said: " << refused; \
    EXPECT_NE(refused, "accepted") << #call;                                              \
    EXPECT_EQ(refused.find('\n'), std::string::npos) << refused;                          \
  } while (false)
