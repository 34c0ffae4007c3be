# What Beeline needs. Everything that is missing is named in one message, with the command that installs it.
set(beeline_missing)
set(beeline_debian)
set(beeline_packages)  # of Python

# beeline_require(Eigen3 3.4 libeigen3-dev): find_package() of at least that version.
macro(beeline_require name version debian)
  find_package(${name} QUIET ${ARGN})
  if(NOT ${name}_FOUND)
    list(APPEND beeline_missing "${name} ${version}")
    list(APPEND beeline_debian ${debian})
  elseif(${name}_VERSION VERSION_LESS ${version})
    list(APPEND beeline_missing "${name} ${version} (found ${${name}_VERSION})")
    list(APPEND beeline_debian ${debian})
  endif()
endmacro()

# `pip install .`: libraries of the build environment are installed below its prefix, or below cmeel.prefix beside
# its Python packages.
if(SKBUILD)
  find_package(Python 3.10 REQUIRED COMPONENTS Interpreter)
  execute_process(
    COMMAND ${Python_EXECUTABLE} -c "import nanobind; print(nanobind.__file__)"
    OUTPUT_VARIABLE site OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  cmake_path(GET site PARENT_PATH site)
  cmake_path(GET site PARENT_PATH site)
  cmake_path(SET prefix NORMALIZE ${site}/../../..)
  set(beeline_build_environment ${prefix})
  list(PREPEND CMAKE_PREFIX_PATH ${site}/cmeel.prefix ${prefix})
endif()

# Eigen 5 is compatible with 3.4; its version file says otherwise.
beeline_require(Eigen3 3.4 libeigen3-dev)
beeline_require(hwy 1.0 libhwy-dev NO_MODULE)  # Highway
beeline_require(TBB 2021 libtbb-dev COMPONENTS tbb)
beeline_require(tinyxml2 9 libtinyxml2-dev)
# tinyxml2 11 defines _FILE_OFFSET_BITS=64 for those who use it. On 64 bits this is the default, and GCC rejects a
# precompiled header that was made without it.
if(TARGET tinyxml2::tinyxml2 AND CMAKE_SIZEOF_VOID_P EQUAL 8)
  get_target_property(definitions tinyxml2::tinyxml2 INTERFACE_COMPILE_DEFINITIONS)
  if(definitions)
    list(REMOVE_ITEM definitions _FILE_OFFSET_BITS=64)
    set_target_properties(tinyxml2::tinyxml2 PROPERTIES INTERFACE_COMPILE_DEFINITIONS "${definitions}")
  endif()
endif()
beeline_require(yaml-cpp 0.7 libyaml-cpp-dev)
set(beeline_yaml yaml-cpp)
if(TARGET yaml-cpp::yaml-cpp)  # its name since 0.8
  set(beeline_yaml yaml-cpp::yaml-cpp)
endif()
beeline_require(CLI11 2.1 libcli11-dev)
beeline_require(fmt 9 libfmt-dev)
# Clang 20 and later find the format strings in the headers of fmt 9 and 10 not constant.
if(TARGET fmt::fmt-header-only AND fmt_VERSION VERSION_LESS 11
   AND CMAKE_CXX_COMPILER_ID STREQUAL Clang AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 20)
  target_compile_definitions(fmt::fmt-header-only INTERFACE FMT_CONSTEVAL=)
endif()
set(beeline_fmt fmt::fmt)
if(SKBUILD)  # a wheel needs no library of it
  set(beeline_fmt fmt::fmt-header-only)
endif()
beeline_require(FastFloat 3 libfast-float-dev)

# The Python package of nlohmann-json has the headers alone.
if(SKBUILD AND EXISTS ${site}/nlohmann_json/include/nlohmann/json.hpp)
  add_library(nlohmann_json::nlohmann_json INTERFACE IMPORTED)
  target_include_directories(nlohmann_json::nlohmann_json INTERFACE ${site}/nlohmann_json/include)
else()
  beeline_require(nlohmann_json 3.11 nlohmann-json3-dev)
endif()

if(BEELINE_PYTHON)
  find_package(Python 3.10 QUIET COMPONENTS Interpreter Development.Module NumPy)
  if(NOT Python_Interpreter_FOUND OR Python_VERSION VERSION_LESS 3.10)
    message(FATAL_ERROR "Python 3.10 or newer is needed: -DPython_EXECUTABLE=ENVIRONMENT/bin/python")
  endif()
  if(NOT Python_Development.Module_FOUND)
    list(APPEND beeline_missing "Python.h of Python ${Python_VERSION}")
    list(APPEND beeline_debian python3-dev)
  endif()
  execute_process(COMMAND ${Python_EXECUTABLE} -c "import nanobind; print(nanobind.__version__)"
    OUTPUT_VARIABLE nanobind OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  execute_process(COMMAND ${Python_EXECUTABLE} -c "import nanobind_backend" RESULT_VARIABLE no_backend ERROR_QUIET)
  if(NOT Python_NumPy_FOUND)
    list(APPEND beeline_packages numpy)
  endif()
  if(nanobind STREQUAL "" OR nanobind VERSION_LESS 3.1)
    list(APPEND beeline_packages "nanobind 3.1")
  endif()
  if(no_backend)
    list(APPEND beeline_packages nanobind-backend)
  endif()
endif()

if(BEELINE_CAIRO)
  find_package(PkgConfig QUIET)
  if(PkgConfig_FOUND)
    pkg_check_modules(beeline_cairo QUIET IMPORTED_TARGET cairo)
  endif()
  if(NOT beeline_cairo_FOUND)
    list(APPEND beeline_missing "cairo (or -DBEELINE_CAIRO=OFF)")
    list(APPEND beeline_debian pkg-config libcairo2-dev)
  endif()
endif()

if(BEELINE_HDF5)
  find_package(PkgConfig QUIET)
  if(PkgConfig_FOUND)
    pkg_check_modules(beeline_hdf5 QUIET IMPORTED_TARGET hdf5)
  endif()
  if(NOT beeline_hdf5_FOUND)
    list(APPEND beeline_missing "hdf5 (or -DBEELINE_HDF5=OFF)")
    list(APPEND beeline_debian pkg-config libhdf5-dev)
  endif()
endif()

if(BEELINE_ASSIMP)
  find_package(assimp QUIET)
  if(NOT assimp_FOUND)
    message(STATUS "Without assimp (Debian: libassimp-dev): meshes are read as STL and OBJ, not Collada or glTF")
    set(BEELINE_ASSIMP OFF)
  endif()
endif()

set(beeline_message)
if(BEELINE_VIEW)
  find_package(PkgConfig QUIET)
  if(PkgConfig_FOUND)
    pkg_check_modules(beeline_httplib QUIET IMPORTED_TARGET cpp-httplib)
  endif()
  if(NOT beeline_httplib_FOUND)
    list(APPEND beeline_missing "cpp-httplib (or -DBEELINE_VIEW=OFF)")
    list(APPEND beeline_debian pkg-config libcpp-httplib-dev)
  elseif(beeline_httplib_CFLAGS MATCHES OPENSSL_SUPPORT)  # then functions of its header call libcrypto
    target_link_libraries(PkgConfig::beeline_httplib INTERFACE ${beeline_httplib_STATIC_LDFLAGS})
  endif()
  find_package(ZLIB QUIET)  # for saved pages
  if(NOT ZLIB_FOUND)
    list(APPEND beeline_missing "zlib (or -DBEELINE_VIEW=OFF)")
    list(APPEND beeline_debian zlib1g-dev)
  endif()
endif()

if(beeline_missing)
  list(JOIN beeline_missing ", " missing)
  list(JOIN beeline_debian " " debian)
  string(APPEND beeline_message "Missing: ${missing}. On Debian:\n  apt-get install ${debian}\n")
endif()
if(beeline_packages)
  list(JOIN beeline_packages ", " packages)
  string(APPEND beeline_message "Missing packages of ${Python_EXECUTABLE}: ${packages}. In a virtual environment:\n"
    "  pip install numpy 'nanobind>=3.1,<4' 'nanobind-backend>=1,<2'\n"
    "and -DPython_EXECUTABLE=ENVIRONMENT/bin/python.\n")
endif()
if(beeline_message)
  message(FATAL_ERROR "${beeline_message}")
endif()
