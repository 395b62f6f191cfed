%{
#include "handles/dof.hpp"
%}

%ignore pydart2::DofHandle::DofHandle; // handles come from their skeleton
%include "handles/dof.hpp"
