# Headers of the standard library and of {fmt}, compiled once: reading them is a sixth of a build. Larger sets cost every
# file more than they save the few that need them. Our own headers are not among them, so that a change of one rebuilds
# what includes it and no more. With a compiler launcher (ccache) there are none: it caches better without, and a header
# that a file forgot to include is found there.
set(POLDER_HEADERS <algorithm> <array> <cmath> <cstdint> <filesystem> <fstream> <functional> <limits> <map> <memory>
  <numbers> <optional> <span> <stdexcept> <string> <string_view> <utility> <vector> <fmt/format.h>)
if(CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_DISABLE_PRECOMPILE_HEADERS ON)
endif()

# polder_headers(NAME [LINKS target...] [ADD header...]): the set and more, for polder_use_headers(TARGET NAME); LINKS are
# the libraries whose definitions the headers look at.
function(polder_headers name)
  cmake_parse_arguments(ARG "" "" "LINKS;ADD" ${ARGN})
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/headers/${name}.cpp CONTENT "// Nothing but its headers.\n")
  add_library(${name} OBJECT ${CMAKE_BINARY_DIR}/headers/${name}.cpp)
  target_link_libraries(${name} PRIVATE polder_flags fmt::fmt ${ARG_LINKS})
  target_precompile_headers(${name} PRIVATE ${POLDER_HEADERS} ${ARG_ADD})
endfunction()

function(polder_use_headers target name)
  target_precompile_headers(${target} REUSE_FROM ${name})
endfunction()

polder_headers(polder_room_headers)
