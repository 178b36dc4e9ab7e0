# polder_room(NAME [USES room...] [LINKS target...]): the library polder_NAME from src/polder/NAME/*.cpp.
# A room without sources yet is header-only.
function(polder_room name)
  cmake_parse_arguments(ARG "" "" "USES;LINKS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/src/polder/${name}/*.cpp)
  list(TRANSFORM ARG_USES PREPEND polder_)
  if(sources)
    add_library(polder_${name} STATIC ${sources})
    target_link_libraries(polder_${name} PUBLIC polder_flags ${ARG_USES} ${ARG_LINKS})
    if(TARGET polder_case)  # those below it do not know {fmt}
      polder_use_headers(polder_${name} polder_room_headers)
    endif()
  else()
    add_library(polder_${name} INTERFACE)
    target_link_libraries(polder_${name} INTERFACE polder_flags ${ARG_USES} ${ARG_LINKS})
  endif()
endfunction()
