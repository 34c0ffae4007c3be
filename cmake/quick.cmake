# What makes the build quick: a third of the time that the same files take one by one.

# GCC collects garbage whenever its heap has doubled, which takes a tenth of the build time. This
# parameter defers it until the heap has 500 MB.
add_compile_options($<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=500000>)

# beeline_optimise(target -O2): instead of -O3, where -O3 takes long and gains nothing. Under a sanitizer, which takes -O1,
# a target of -O2 is compiled with BEELINE_SANITIZER_OPTIONS: -O0 takes two thirds of the time. Kernels need -O1 or more then
# (BEELINE_KERNEL_OPTIONS): without inlining, their vectors are passed in two ways.
set(BEELINE_SANITIZER_OPTIONS "" CACHE STRING "Further options for what is not compiled with -O3, under a sanitizer")
option(BEELINE_WEB_QUICK "Optimise the page's modules less: built in two thirds of the time, twice as large" OFF)
function(beeline_optimise target level)
  if(CMAKE_CXX_FLAGS_RELEASE MATCHES "-O3")
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:${level}>)
  endif()
  if(level STREQUAL "-O2")
    target_compile_options(${target} PRIVATE ${BEELINE_SANITIZER_OPTIONS})
    if(EMSCRIPTEN)  # -Os: a smaller page, and compiled in three quarters of the time
      target_compile_options(${target} PRIVATE $<IF:$<BOOL:${BEELINE_WEB_QUICK}>,-O0,-Os>)
    endif()
  endif()
endfunction()

# Libraries of their own: GCC takes a precompiled header only where every macro that was defined when
# it was made is defined again, and with the header its -O level.
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/precompiled.cpp CONTENT "")
foreach(name precompiled precompiled_core)
  add_library(beeline_${name} OBJECT ${PROJECT_BINARY_DIR}/precompiled.cpp)
  target_link_libraries(beeline_${name} PRIVATE Eigen3::Eigen)
  target_precompile_headers(beeline_${name} PRIVATE ${PROJECT_SOURCE_DIR}/cmake/precompiled.h)
  set_target_properties(beeline_${name} PROPERTIES UNITY_BUILD OFF)
endforeach()
beeline_optimise(beeline_precompiled -O2)

# beeline_group(target): the sources of a folder and its internal/ are compiled as one
# (CMAKE_UNITY_BUILD, on in the presets), except for the kernels, which Highway compiles once for each
# instruction set. These have no precompiled header either: with it, GCC takes the -O level from the
# header.
function(beeline_group target)
  set(kernel_options ${BEELINE_KERNEL_OPTIONS})
  if(CMAKE_CXX_FLAGS_RELEASE MATCHES "-O3")
    list(APPEND kernel_options $<$<CONFIG:Release>:-O3>)  # behind the -O2 of beeline_optimise
  elseif(BEELINE_WEB_QUICK)
    list(APPEND kernel_options -O2)
  endif()
  get_target_property(sources ${target} SOURCES)
  get_target_property(folder ${target} SOURCE_DIR)
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
  foreach(source IN LISTS sources)
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${folder})
    if(NOT source MATCHES "\\.cpp$")
      continue()
    endif()
    file(STRINGS ${source} kernel REGEX "foreach_target\\.h" LIMIT_COUNT 1)
    if(kernel)
      set_source_files_properties(${source} PROPERTIES SKIP_PRECOMPILE_HEADERS ON
        COMPILE_OPTIONS "${kernel_options}")
    else()
      cmake_path(RELATIVE_PATH source BASE_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE group)
      cmake_path(GET group PARENT_PATH group)
      string(REGEX REPLACE "/internal$" "" group ${group})
      string(REPLACE "/" "_" group ${group})
      set_property(SOURCE ${source} PROPERTY UNITY_GROUP ${group})
    endif()
  endforeach()
endfunction()

option(BEELINE_OPTIMISE_MOTION
  "Optimise the core's folders from collision to control as the rest of the core; OFF: as the other libraries" ON)

# beeline_quick(target): groups the sources as beeline_group() does and uses a precompiled header. The core is compiled with
# -O3: with -O2 its loops over links and samples take 5 to 35 % longer, as Eigen's small products are
# calls, and it is compiled no quicker.
function(beeline_quick target)
  beeline_group(${target})
  if(target STREQUAL beeline_core OR (target STREQUAL beeline_core_motion AND BEELINE_OPTIMISE_MOTION))
    target_precompile_headers(${target} REUSE_FROM beeline_precompiled_core)
  else()
    beeline_optimise(${target} -O2)
    target_precompile_headers(${target} REUSE_FROM beeline_precompiled)
  endif()
endfunction()
