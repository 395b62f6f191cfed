#pragma once

namespace pydart2 {

/// Has what the heap has grown by moved into pages of 2 MB, once that is much and where the kernel can (Linux 6.1). A step
/// goes through small objects all over the heap: of 256 Atlas it touches so many pages of 4 KB that finding these takes
/// a fifth of its time.
void use_large_pages();

} // namespace pydart2
