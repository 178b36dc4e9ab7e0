#pragma once
// Huge pages for the arrays. A kernel walks along some twenty arrays of points and ten fields of the grid at once: more
// small pages than the processor keeps the addresses of, and in 3d that costs a tenth of the step.

namespace polder {

/// Lets arrays of up to 32 MB lie side by side in the heap instead of in mappings of their own, most of which are
/// smaller than a huge page or begin in the midst of one. To be called first in a program.
void keep_arrays_together();

/// Asks the system to put what is in the heap now on huge pages. A wish: where they cannot be had, nothing changes.
void use_huge_pages();

}  // namespace polder
