#include "memory.h"

#include <cstdlib>

#include "fault.h"

namespace beeline::web {
namespace {

std::string& last_error() {
  static std::string message;
  return message;
}

}  // namespace

void set_error(const std::string& message) { last_error() = message; }

}  // namespace beeline::web

double* beeline_allocate(int count) {
  constexpr int largest = 1 << 26;  // 512 MB
  if (count < 0 || count > largest) return nullptr;
  return static_cast<double*>(std::calloc(static_cast<std::size_t>(count), sizeof(double)));
}

void beeline_release(void* memory) { std::free(memory); }

const char* beeline_error() { return beeline::web::last_error().c_str(); }
