%{
#include "dof.hpp"
%}

%ignore pydart2::DofHandle::DofHandle; // handles come from their skeleton
%include "dof.hpp"
