# rgc_add_graph(TARGET FILE [DEFINE name=value ...] [OPTIONS option ...] [OUTPUT folder])
#
# Compiles the frame FILE when TARGET is built, and again exactly when FILE, a module it imports, or a shader or include of one of them has changed. TARGET gets the
# generated header (`#include "<module>.h"`), the plan, and rgc::runtime. OUTPUT: where the files go; commit them if engines without rgc build from them.
set(rgc_digest_script "${CMAKE_CURRENT_LIST_DIR}/rgcDigest.cmake")
function(rgc_add_graph target file)
  cmake_parse_arguments(ARG "" "OUTPUT" "DEFINE;OPTIONS" ${ARGN})
  if(NOT TARGET rgc::compiler)
    message(FATAL_ERROR "rgc_add_graph: no rgc was found; set RGC_EXECUTABLE to the compiler for the machine that builds")
  endif()
  get_filename_component(source "${file}" ABSOLUTE BASE_DIR "${CMAKE_CURRENT_SOURCE_DIR}")
  if(NOT EXISTS "${source}")
    message(FATAL_ERROR "rgc_add_graph: `${source}` does not exist")
  endif()
  file(STRINGS "${source}" module REGEX "^[ \t]*module[ \t]+[A-Za-z_][A-Za-z_0-9]*" LIMIT_COUNT 1)
  if(NOT module)
    message(FATAL_ERROR "rgc_add_graph: `${source}` does not begin with `module NAME`")
  endif()
  string(REGEX REPLACE "^[ \t]*module[ \t]+([A-Za-z_0-9]+).*" "\\1" module "${module}")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${source}")  # the module's name names files

  set(output "${CMAKE_CURRENT_BINARY_DIR}/rgc/${module}")
  if(ARG_OUTPUT)
    get_filename_component(output "${ARG_OUTPUT}" ABSOLUTE BASE_DIR "${CMAKE_CURRENT_SOURCE_DIR}")
  endif()
  set(stamp "${CMAKE_CURRENT_BINARY_DIR}/rgc/${module}.stamp")
  set(defines)
  foreach(define IN LISTS ARG_DEFINE)
    list(APPEND defines -D "${define}")
  endforeach()
  # Files whose contents stay the same are not written, so what only includes them is not compiled again.
  file(MAKE_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}/rgc")
  add_custom_command(
    OUTPUT "${stamp}"
    BYPRODUCTS "${output}/${module}_plan.cpp" "${output}/${module}.h"
    COMMAND rgc::compiler build "${source}" --output "${output}" --depfile "${stamp}.d" --stamp "${stamp}" --quiet ${defines} ${ARG_OPTIONS}
    DEPENDS "${source}" rgc::compiler
    DEPFILE "${stamp}.d"
    COMMENT "rgc ${file}"
    VERBATIM)
  # The plan includes one file a shader, whose names follow from the frame: what they hold is summed up in a file that changes only with them.
  set(digest "${stamp}.digest")
  add_custom_command(
    OUTPUT "${digest}"
    COMMAND "${CMAKE_COMMAND}" "-DFOLDER=${output}/shaders" "-DDIGEST=${digest}" -P "${rgc_digest_script}"
    DEPENDS "${stamp}"
    COMMENT ""
    VERBATIM)
  set_property(SOURCE "${output}/${module}_plan.cpp" APPEND PROPERTY OBJECT_DEPENDS "${digest}")
  add_custom_target(${target}_${module}_graph DEPENDS "${stamp}" "${digest}")
  set_source_files_properties("${output}/${module}_plan.cpp" "${output}/${module}.h" PROPERTIES GENERATED TRUE)
  target_sources(${target} PRIVATE "${output}/${module}_plan.cpp")
  target_include_directories(${target} PRIVATE "${output}")
  target_link_libraries(${target} PRIVATE rgc::runtime)
  add_dependencies(${target} ${target}_${module}_graph)
endfunction()
