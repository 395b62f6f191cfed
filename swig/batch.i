%{
#include "handles/batch.hpp"
%}

%ignore pydart2::BatchHandle::claim;
%include "handles/batch.hpp"
