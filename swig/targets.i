%{
#include "handles/targets.hpp"
%}

%ignore pydart2::TargetsHandle::TargetsHandle; // from SkeletonHandle::targets
%include "handles/targets.hpp"
