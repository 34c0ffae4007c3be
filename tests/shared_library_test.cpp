#include <cmath>
#include <gtest/gtest.h>

#include <beeline/internal/shared_library.h>

#include <tests/refusal.h>

namespace beeline {
namespace {

TEST(SharedLibrary, HasItsFunctionsByName) {
  const internal::SharedLibrary library("libm.so.6");
  double (*const cosine)(double) = library["cos"];
  EXPECT_EQ(cosine(0.5), std::cos(0.5));
}

TEST(SharedLibrary, WhatIsNotThereIsNamed) {
  EXPECT_REFUSED(internal::SharedLibrary("libbeeline_of_nobody.so.7"), "libbeeline_of_nobody.so.7");
  const internal::SharedLibrary library("libm.so.6");
  EXPECT_REFUSED(library["nobodys_function"], "nobodys_function");
}

}  // namespace
}  // namespace beeline
