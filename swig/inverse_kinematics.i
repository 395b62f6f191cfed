%{
#include "handles/inverse_kinematics.hpp"
%}

%ignore pydart2::InverseKinematicsHandle::InverseKinematicsHandle; // from SkeletonHandle::inverse_kinematics
%ignore pydart2::InverseKinematicsHandle::claim;
%include "handles/inverse_kinematics.hpp"
