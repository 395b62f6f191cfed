%{
#include "batch.hpp"
%}

%ignore pydart2::BatchHandle::claim;
%include "batch.hpp"
