#pragma once

#include <exception>
#include <string>

#include <beeline/error.h>

namespace beeline::web {

/// Keeps a message for beeline_error().
void set_error(const std::string& message);

/// Returns work()'s value, or -1 if it throws, with the message in beeline_error().
template <class Work>
int guarded(const Work& work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    set_error("the input needs more memory than is available");
  } catch (const std::exception& error) {
    set_error(error.what());
  }
  return -1;
}

/// Returns work()'s text, valid until the next call, or null if it throws, as guarded().
template <class Work>
const char* text(const Work& work) {
  static std::string result;
  const int done = guarded([&] {
    result = work();
    return 0;
  });
  return done == 0 ? result.c_str() : nullptr;
}

}  // namespace beeline::web
