# beeline_library(core FOLDERS . pose): the library beeline::core from beeline/pose, all folders below
# it included; "." stands for the files beside the folders. MOTION: further folders of it, compiled by a target of their
# own, beeline_core_motion, which a sanitizer optimises less (BEELINE_OPTIMISE_MOTION). Its public headers are installed
# with it. Not public: headers in a folder internal/, in math/, reason/, inverse/analytic/ and inverse/numerical/, and the
# kernels in -inl.h, which Highway compiles once for each instruction set.
function(beeline_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "FOLDERS;MOTION")
  set(sources)
  set(motion)
  set(headers)
  foreach(folder IN LISTS arg_FOLDERS arg_MOTION)
    set(mode GLOB_RECURSE)
    if(folder STREQUAL ".")
      set(mode GLOB)
    endif()
    file(${mode} found CONFIGURE_DEPENDS beeline/${folder}/*.cpp)
    if(folder IN_LIST arg_MOTION)
      list(APPEND motion ${found})
    else()
      list(APPEND sources ${found})
    endif()
    file(${mode} found CONFIGURE_DEPENDS beeline/${folder}/*.h)
    list(APPEND headers ${found})
  endforeach()
  list(FILTER headers EXCLUDE REGEX "-inl\\.h$|/internal/|/beeline/(math|reason)/|/inverse/(analytic|numerical)/")

  add_library(beeline_${name} ${sources})
  add_library(beeline::${name} ALIAS beeline_${name})
  set_target_properties(beeline_${name} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(beeline_${name} PUBLIC cxx_std_20)
  target_include_directories(beeline_${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_sources(beeline_${name} PUBLIC
    FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${headers})
  beeline_quick(beeline_${name})
  if(motion)
    add_library(beeline_${name}_motion OBJECT ${motion})
    target_include_directories(beeline_${name}_motion PRIVATE ${PROJECT_SOURCE_DIR})
    beeline_quick(beeline_${name}_motion)
    target_sources(beeline_${name} PRIVATE $<TARGET_OBJECTS:beeline_${name}_motion>)
  endif()
endfunction()

# beeline_load_when_needed(target hdf5): the library that pkg-config found under that name is not linked: the target loads
# it by the name that BEELINE_HDF5_LIBRARY has then (internal/shared_library.h).
function(beeline_load_when_needed target name)
  list(FILTER beeline_${name}_LINK_LIBRARIES INCLUDE REGEX "lib${name}[^/]*$")
  execute_process(COMMAND ${CMAKE_OBJDUMP} -p ${beeline_${name}_LINK_LIBRARIES} OUTPUT_VARIABLE headers ERROR_QUIET)
  string(TOUPPER ${name} upper)
  if(NOT headers MATCHES "SONAME +([^\n]+)")
    message(FATAL_ERROR "No shared library of ${name} in \"${beeline_${name}_LINK_LIBRARIES}\": install one, or "
      "-DBEELINE_${upper}=OFF")
  endif()
  target_compile_definitions(${target} PRIVATE BEELINE_${upper}_LIBRARY="${CMAKE_MATCH_1}")
  target_include_directories(${target} PRIVATE ${beeline_${name}_INCLUDE_DIRS})
endfunction()
