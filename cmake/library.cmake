# beeline_library(core error pose/*): the library beeline::core from beeline/error.cpp, beeline/pose
# and their headers, which are installed with it and must each compile alone; not so the kernels in
# -inl.h, which Highway compiles once for each kind of machine.
function(beeline_library name)
  list(TRANSFORM ARGN PREPEND beeline/ OUTPUT_VARIABLE stems)
  list(TRANSFORM stems APPEND .cpp OUTPUT_VARIABLE source_globs)
  list(TRANSFORM stems APPEND .h OUTPUT_VARIABLE header_globs)
  file(GLOB sources CONFIGURE_DEPENDS ${source_globs})
  file(GLOB headers CONFIGURE_DEPENDS ${header_globs})
  list(FILTER headers EXCLUDE REGEX "-inl\\.h$")

  add_library(beeline_${name} ${sources})
  add_library(beeline::${name} ALIAS beeline_${name})
  set_target_properties(beeline_${name} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(beeline_${name} PUBLIC cxx_std_20)
  target_sources(beeline_${name} PUBLIC
    FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${headers})
endfunction()
