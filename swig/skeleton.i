%{
#include "handles/skeleton.hpp"
%}

%ignore pydart2::SkeletonHandle::SkeletonHandle; // handles come from their world
%include "handles/skeleton.hpp"
