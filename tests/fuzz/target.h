#pragma once

#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <string_view>

#include <beeline/error.h>

/// BEELINE_FUZZ_TARGET(name) { ... } defines a fuzz target: a function of `input`, any bytes. With
/// libFuzzer each is a program of its own; the test of the stored corpus links all of them.
#ifdef BEELINE_LIBFUZZER
#define BEELINE_FUZZ_TARGET(name)                                              \
  static void name(std::string_view input);                                    \
  extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, size_t n) { \
    name({reinterpret_cast<const char*>(data), n});                            \
    return 0;                                                                  \
  }                                                                            \
  static void name(std::string_view input)
#else
#define BEELINE_FUZZ_TARGET(name)                                                           \
  static void name(std::string_view input);                                                 \
  static const bool name##_is_known = beeline::fuzz::targets().emplace(#name, name).second; \
  static void name(std::string_view input)
#endif

namespace beeline::fuzz {

using Target = void (*)(std::string_view);

/// The targets by name, in the test of the corpus.
inline std::map<std::string, Target>& targets() {
  static std::map<std::string, Target> all;
  return all;
}

/// Ends the program where a law does not hold.
inline void require(bool holds, const std::string& law) {
  if (holds) return;
  std::fprintf(stderr, "violated: %s\n", law.c_str());
  std::abort();
}

/// Calls `read`, which may refuse its input with a message of one line.
template <class Read>
void may_refuse(Read&& read) {
  try {
    read();
  } catch (const Error& error) {
    const std::string_view message = error.what();
    require(!message.empty() && message.find('\n') == std::string_view::npos, "one line");
  }
}

}  // namespace beeline::fuzz
