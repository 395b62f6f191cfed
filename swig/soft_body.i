%{
#include "handles/soft_body.hpp"
%}

%ignore pydart2::SoftBodyHandle::SoftBodyHandle; // from BodyNodeHandle::soft_body
%include "handles/soft_body.hpp"
