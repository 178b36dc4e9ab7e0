#pragma once
// What comes and goes with stages.
#include <cstddef>

namespace polder {

/// Whether a wall or a well is there in stage number `stage`: from the beginning of `from_stage` to that of
/// `until_stage`; −1: from the start, to the end.
template <class Item>
bool in_stage(const Item& item, std::size_t stage) {
  return (item.from_stage < 0 || stage >= static_cast<std::size_t>(item.from_stage)) &&
         (item.until_stage < 0 || stage < static_cast<std::size_t>(item.until_stage));
}

}  // namespace polder
