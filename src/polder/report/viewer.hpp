#pragma once
// The viewer's bundle, made from web/ and kept in web/dist; cmake/PolderViewer.cmake embeds it.
#include <string_view>

namespace polder {

extern const std::string_view viewer_script;
extern const std::string_view viewer_style;

}  // namespace polder
