%{
#include "engine_info.hpp"
%}

%include "engine_info.hpp"
