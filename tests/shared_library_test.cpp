#include <cmath>
#include <gtest/gtest.h>

#include <beeline/internal/shared_library.h>

#include <tests/refusal.h>

namespace beeline {
namespace {

TEST(SharedLibrary, HasItsFunctionsByName) {
  const internal::SharedLibrary library("libm.so.6", "");
  double (*const cosine)(double) = library["cos"];
  EXPECT_NEAR(cosine(0.5), std::cos(0.5), 1e-15);
}

TEST(SharedLibrary, WhatIsNotThereIsNamed) {
  EXPECT_REFUSED(internal::SharedLibrary("libnobodys.so.7", "install it"), "libnobodys.so.7");
  EXPECT_REFUSED(internal::SharedLibrary("libnobodys.so.7", "install it"), "; install it");
  const internal::SharedLibrary library("libm.so.6", "");
  EXPECT_REFUSED(library["nobodys_function"], "nobodys_function");
}

}  // namespace
}  // namespace beeline
