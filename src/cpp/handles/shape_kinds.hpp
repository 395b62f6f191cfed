#pragma once

#include <dart/dynamics/Shape.hpp>

#include "base/errors.hpp"

namespace pydart2 {

/// A list of shape classes.
template <class... Kinds>
struct OneOf
{
};

/// Calls `use` with the shape as the first of `Kinds` that it is; TypeError if it is none of them.
template <class Use, class First, class... Rest>
auto with(dart::dynamics::Shape& shape, const char* asked, OneOf<First, Rest...>, Use use)
{
  if (auto* cast = dynamic_cast<First*>(&shape))
    return use(*cast);
  if constexpr (sizeof...(Rest) > 0)
    return with(shape, asked, OneOf<Rest...>{}, use);
  throw Error(Kind::type, "a " + shape.getType() + " has no " + asked);
}

} // namespace pydart2
