#pragma once

namespace beeline::internal {

/// The address of a function or of a variable; becomes a pointer of the type that it is assigned
/// to.
class SharedSymbol {
 public:
  explicit SharedSymbol(void* address) : address_(address) {}
  template <class T>
  operator T*() const {
    return reinterpret_cast<T*>(address_);
  }

 private:
  void* address_;
};

/// A library that the program loads when it first needs it, and keeps. HDF5, Cairo and the fifty
/// libraries that they need take 7 ms to load, longer than most commands run.
class SharedLibrary {
 public:
  /// `file`: the name by which the system's loader finds it, as "libcairo.so.2"; `cure`: what helps
  /// where it cannot be loaded, for the Error that is thrown then.
  SharedLibrary(const char* file, const char* cure);

  /// The function or variable of that name. Throws Error where the library has none.
  SharedSymbol operator[](const char* name) const;

 private:
  void* handle_;
};

}  // namespace beeline::internal
