%{
#include "handles/queries.hpp"
%}

%include "handles/queries.hpp"
