# Writes the C++ source of the built-in arms' shapes: the texts of the files of beeline/model/arms/ that have a list `shapes`,
# which read_arm_shapes() reads as it reads other arm files. The core has no shapes of arms.
# As a script: cmake -D FOLDER=beeline/model/arms -D OUTPUT=catalog_shapes.cpp -P catalog_shapes.cmake
cmake_minimum_required(VERSION 3.25)

file(GLOB files ${FOLDER}/*.json)
foreach(file IN LISTS files)
  file(READ ${file} json)
  string(JSON shapes ERROR_VARIABLE error GET "${json}" shapes)
  string(JSON source ERROR_VARIABLE no_source GET "${json}" shapes_source)
  if((error AND NOT no_source) OR (no_source AND NOT error))
    message(FATAL_ERROR "${file} has one of shapes and shapes_source; it needs both or none")
  endif()
  if(NOT error)
    string(JSON name GET "${json}" name)
    string(APPEND entries "  if (name == \"${name}\") return R\"~(${json})~\";\n")
  endif()
endforeach()

file(WRITE ${OUTPUT} "// Written by cmake/catalog_shapes.cmake.
#include <beeline/io/text/internal/built_in_shapes.h>

namespace beeline::internal {

std::string_view built_in_shapes(std::string_view name) {
${entries}  return {};
}

}  // namespace beeline::internal
")
