%{
#include "handles/dynamics.hpp"
%}

%ignore pydart2::DynamicsHandle::DynamicsHandle; // from SkeletonHandle::dynamics
%include "handles/dynamics.hpp"
