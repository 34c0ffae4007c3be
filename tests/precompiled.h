// What nearly every test includes, compiled once; see cmake/quick.cmake.
#include <gtest/gtest.h>
#include <random>

#include "../cmake/precompiled.h"
