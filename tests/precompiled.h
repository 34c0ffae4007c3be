// What nearly every test includes, compiled once; see cmake/quick.cmake.
#include "../cmake/precompiled.h"

#include <random>

#include <gtest/gtest.h>
