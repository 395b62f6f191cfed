%{
#include "handles/bodynode.hpp"
%}

%ignore pydart2::BodyNodeHandle::BodyNodeHandle; // handles come from their skeleton
%ignore pydart2::BodyNodeHandle::body;
%include "handles/bodynode.hpp"
