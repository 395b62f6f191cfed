%{
#include "handles/inverse_kinematics.hpp"
%}

%ignore pydart2::InverseKinematicsHandle::InverseKinematicsHandle; // from SkeletonHandle::inverse_kinematics
%include "handles/inverse_kinematics.hpp"
