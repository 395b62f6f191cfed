#pragma once

#include <initializer_list>

namespace pydart2 {

/// Lets the calls of a function that other libraries import go to `target`, in all loaded libraries whose file names
/// begin with one of `prefixes`. Nothing else in the process changes. How many libraries import it.
int redirect(std::initializer_list<const char*> prefixes, const char* name, void* target);

} // namespace pydart2
