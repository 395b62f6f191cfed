%{
#include "world.hpp"
%}

%include "world.hpp"
