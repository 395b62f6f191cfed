%{
#include "batch.hpp"
%}

%include "batch.hpp"
