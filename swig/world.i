%{
#include "world.hpp"
%}

%ignore pydart2::WorldHandle::claim;
%ignore pydart2::WorldHandle::ref;
%include "world.hpp"
