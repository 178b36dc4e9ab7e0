# polder_embed(TARGET FILE VARIABLE): the text of FILE as `const std::string_view polder::VARIABLE`, so that a report
# needs nothing but the program.
function(polder_embed target file variable)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  file(READ ${file} hex HEX)
  string(LENGTH "${hex}" digits)
  math(EXPR bytes "${digits} / 2")
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "'\\\\x\\1'," array "${hex}")
  string(REPEAT "." 112 line)  # sixteen bytes
  string(REGEX REPLACE "(${line})" "\\1\n" array "${array}")
  file(GENERATE OUTPUT ${CMAKE_BINARY_DIR}/embedded/${variable}.cpp CONTENT
"#include <string_view>
namespace polder {
namespace {
constexpr char bytes[] = {${array}};
}
extern const std::string_view ${variable};
const std::string_view ${variable}(bytes, ${bytes});
}  // namespace polder
")
  target_sources(${target} PRIVATE ${CMAKE_BINARY_DIR}/embedded/${variable}.cpp)
endfunction()
