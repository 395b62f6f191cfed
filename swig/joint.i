%{
#include "handles/joint.hpp"
%}

%ignore pydart2::JointHandle::JointHandle; // handles come from their skeleton
%include "handles/joint.hpp"
