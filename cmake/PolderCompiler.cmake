# One place for the flags that decide what the numbers are: instruction set and floating-point contraction
# are fixed here so that two builds of one commit agree.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})

add_library(polder_flags INTERFACE)
target_compile_options(polder_flags INTERFACE
  -march=${POLDER_ARCH} -ffp-contract=fast -fno-math-errno -fno-trapping-math
  -Wall -Wextra -Wconversion -Wshadow -Wno-sign-conversion)
if(POLDER_WERROR)
  target_compile_options(polder_flags INTERFACE -Werror)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # -Wrestrict sees overlaps in libstdc++'s string concatenation that are not there (GCC bug 105651),
  # -Wstringop-overflow writes of {fmt} 9 past a buffer that are not there either; out of a precompiled
  # <string> -Warray-bounds and -Wstringop-overread do the like.
  target_compile_options(polder_flags INTERFACE
    -Wno-psabi -Wno-restrict -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
endif()
target_include_directories(polder_flags INTERFACE ${CMAKE_SOURCE_DIR}/src)
