%{
#include "handles/engine_info.hpp"
%}

%include "handles/engine_info.hpp"
