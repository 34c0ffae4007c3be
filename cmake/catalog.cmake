# Writes the C++ source of the built-in arms: the numbers of each file of beeline/model/arms/ as constants, because functions
# take six times as long to compile. The core reads no JSON. tests/io/text/catalog_test.py compares each arm with its file.
# As a script: cmake -D FOLDER=beeline/model/arms -D OUTPUT=catalog_entries.cpp -P catalog.cmake
cmake_minimum_required(VERSION 3.25)

# get(variable default member...): the value of `json` at these members, or the default.
function(get variable default)
  string(JSON value ERROR_VARIABLE error GET "${json}" ${ARGN})
  if(error)
    set(value "${default}")
  endif()
  set(${variable} "${value}" PARENT_SCOPE)
endfunction()

# vector(variable default member...): `{x, y, z}`.
function(vector variable default)
  get(found "" ${ARGN})
  set(value "${default}")
  if(found)
    set(numbers)
    foreach(i RANGE 2)
      string(JSON number GET "${found}" ${i})
      list(APPEND numbers ${number})
    endforeach()
    list(JOIN numbers ", " value)
  endif()
  set(${variable} "{${value}}" PARENT_SCOPE)
endfunction()

function(pose variable)
  vector(xyz "0, 0, 0" ${ARGN} xyz)
  vector(rpy "0, 0, 0" ${ARGN} rpy)
  set(${variable} "{${xyz}, ${rpy}}" PARENT_SCOPE)
endfunction()

# limits(variable unit member...): `{.lower = -170 * degree, ...}` of the joint at these members.
function(limits variable unit)
  set(fields)
  foreach(key lower upper velocity acceleration jerk)
    get(value "" ${ARGN} limits ${key})
    if(NOT value STREQUAL "")
      list(APPEND fields ".${key} = ${value}${unit}")
    endif()
  endforeach()
  list(JOIN fields ", " fields)
  set(${variable} "{${fields}}" PARENT_SCOPE)
endfunction()

function(dh_joint variable number)
  get(degrees OFF dh degrees)
  math(EXPR default_name "${number} + 1")
  get(name "joint${default_name}" dh rows ${number} name)
  get(type "revolute" dh rows ${number} type)
  set(unit)
  if(degrees)
    set(unit " * degree")
  endif()
  set(fields)
  foreach(key a alpha d theta)
    get(value 0 dh rows ${number} ${key})
    if(key MATCHES "alpha|theta")
      string(APPEND value "${unit}")
    endif()
    list(APPEND fields ".${key} = ${value}")
  endforeach()
  list(APPEND fields ".kind = JointKind::${type}")
  list(JOIN fields ", " fields)
  if(type STREQUAL "prismatic")
    set(unit)
  endif()
  limits(limits "${unit}" dh rows ${number})
  set(${variable} "{.name = \"${name}\", .limits = ${limits}, .row = {${fields}}}" PARENT_SCOPE)
endfunction()

function(free_joint variable number)
  get(name "" joints ${number} name)
  get(type "" joints ${number} type)
  pose(offset joints ${number} origin)
  vector(axis "0, 0, 1" joints ${number} axis)
  vector(point "0, 0, 0" joints ${number} point)
  limits(limits "" joints ${number})
  if(NOT type MATCHES "^(revolute|prismatic)$")
    message(FATAL_ERROR "${file}: joint ${name} is ${type}; built-in arms have revolute and prismatic joints")
  endif()
  set(${variable} "{.name = \"${name}\", .limits = ${limits}, .kind = JointKind::${type}, .offset = ${offset}, .axis = ${axis}, .point = ${point}}"
    PARENT_SCOPE)
endfunction()

# names(variable member...): `"a\tb\t\nc\td\t\n"`, a line for each of the lists of names at these members.
function(names variable)
  set(lines)
  string(JSON count ERROR_VARIABLE error LENGTH "${json}" ${ARGN})
  if(NOT error AND count GREATER 0)
    math(EXPR last "${count} - 1")
    foreach(i RANGE ${last})
      string(JSON length LENGTH "${json}" ${ARGN} ${i})
      foreach(k RANGE 1 ${length})
        math(EXPR k "${k} - 1")
        string(JSON name GET "${json}" ${ARGN} ${i} ${k})
        string(APPEND lines "${name}\\t")
      endforeach()
      string(APPEND lines "\\n")
    endforeach()
  endif()
  set(${variable} "\"${lines}\"" PARENT_SCOPE)
endfunction()

file(GLOB files ${FOLDER}/*.json)
foreach(file IN LISTS files)
  file(READ ${file} json)
  get(name "" name)
  set(about)
  foreach(key name maker model source note shapes_source)
    get(text "" ${key})
    string(APPEND about ".${key} = R\"~(${text})~\", ")
  endforeach()
  names(joint_names joint_names)
  string(APPEND about ".joint_names = ${joint_names}, ")

  set(kind dh_joint)
  get(convention "" dh convention)
  string(JSON count ERROR_VARIABLE error LENGTH "${json}" dh rows)
  if(error)
    set(kind free_joint)
    string(JSON count LENGTH "${json}" joints)
  else()
    string(APPEND about ".convention = DhConvention::${convention}, ")
  endif()
  if(count EQUAL 0)
    message(FATAL_ERROR "${file} has no joints")
  endif()
  string(MAKE_C_IDENTIFIER "joints_of_${name}" joints_of_arm)
  string(APPEND joints "constexpr CatalogJoint ${joints_of_arm}[] = {\n")
  math(EXPR last "${count} - 1")
  foreach(number RANGE ${last})
    cmake_language(CALL ${kind} joint ${number})
    string(APPEND joints "    ${joint},\n")
  endforeach()
  string(APPEND joints "};\n")
  pose(tool tool)
  pose(base base)
  set(controller)
  get(stated "" controller_base)
  get(flange_stated "" flange)
  if(stated AND flange_stated)
    pose(root controller_base)
    pose(flange flange)
    set(controller ", .controller = CatalogFrames{${root}, ${flange}}")
  elseif(stated OR flange_stated)
    message(FATAL_ERROR "${file} states one of controller_base and flange; it needs both or none")
  endif()
  string(APPEND entries "    {${about}.joints = ${joints_of_arm},
     .tool = ${tool}, .base = ${base}${controller}},\n")
endforeach()

file(WRITE ${OUTPUT} "// Written by cmake/catalog.cmake.
#include <beeline/model/internal/catalog_entry.h>

namespace beeline::internal {
namespace {

${joints}
constexpr CatalogEntry entries[] = {
${entries}};

}  // namespace

std::span<const CatalogEntry> catalog_entries() { return entries; }

}  // namespace beeline::internal
")
