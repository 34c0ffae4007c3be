#include <string>

#include <beeline/error.h>
#include <beeline/internal/shared_library.h>

#include <dlfcn.h>

namespace beeline::internal {

SharedLibrary::SharedLibrary(const char* file, const char* cure)
    : handle_(dlopen(file, RTLD_LAZY | RTLD_LOCAL)) {
  if (handle_ != nullptr) return;
  throw Error(std::string("a library cannot be loaded: ") + dlerror() + "; " + cure);
}

SharedSymbol SharedLibrary::operator[](const char* name) const {
  void* const address = dlsym(handle_, name);
  if (address == nullptr) throw Error(std::string("a library is not as expected: ") + dlerror());
  return SharedSymbol(address);
}

}  // namespace beeline::internal
