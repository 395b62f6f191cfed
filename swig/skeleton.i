%{
#include "skeleton.hpp"
%}

%ignore pydart2::SkeletonHandle::SkeletonHandle; // handles come from their world
%include "skeleton.hpp"
