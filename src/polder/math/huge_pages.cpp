#include "polder/math/huge_pages.hpp"

#include <malloc.h>
#include <sys/mman.h>

#include <cstdint>
#include <fstream>
#include <string>

namespace polder {

void keep_arrays_together() {
  // asked for when a program begins, before it has threads
  mallopt(M_MMAP_THRESHOLD, 32 << 20);   // NOLINT(concurrency-mt-unsafe)
  mallopt(M_TRIM_THRESHOLD, 512 << 20);  // NOLINT(concurrency-mt-unsafe): sorting frees and takes an array at a time
}

void use_huge_pages() {
  constexpr std::uintptr_t huge = std::uintptr_t{2} << 20;
  constexpr int collapse = 25;  // MADV_COLLAPSE, of Linux 6.1; unknown to older headers
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    if (!line.ends_with("[heap]")) continue;
    const std::size_t dash = line.find('-');
    const std::uintptr_t begin = std::stoull(line.substr(0, dash), nullptr, 16);
    const std::uintptr_t end = std::stoull(line.substr(dash + 1), nullptr, 16);
    const std::uintptr_t first = (begin + huge - 1) / huge * huge, last = end / huge * huge;
    if (first >= last) continue;
    void* const from = reinterpret_cast<void*>(first);  // NOLINT(performance-no-int-to-ptr): an address, read as one
    if (madvise(from, last - first, MADV_HUGEPAGE) == 0) madvise(from, last - first, collapse);
  }
}

}  // namespace polder
