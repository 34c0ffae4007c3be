#pragma once

#include <string>
#include <utility>

#include <beeline/error.h>

namespace beeline::testing {

/// The message of the Error that `call` throws, or "accepted". Other exceptions pass through.
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

/// Expects that the call throws beeline::Error with one line that contains `culprit`. It is no
/// lambda: Clang before 16 lets none capture a structured binding.
#define EXPECT_REFUSED(call, culprit)                                            \
  do {                                                                           \
    std::string refused_message = "accepted";                                    \
    try {                                                                        \
      (void)(call);                                                              \
    } catch (const beeline::Error& error) {                                      \
      refused_message = error.what();                                            \
    }                                                                            \
    EXPECT_NE(refused_message.find(culprit), std::string::npos)                  \
        << #call << " said: " << refused_message;                                \
    EXPECT_NE(refused_message, "accepted") << #call;                             \
    EXPECT_EQ(refused_message.find('\n'), std::string::npos) << refused_message; \
  } while (false)
