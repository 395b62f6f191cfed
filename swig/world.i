%{
#include "handles/world.hpp"
%}

%ignore pydart2::WorldHandle::claim;
%ignore pydart2::WorldHandle::ref;
%include "handles/world.hpp"
