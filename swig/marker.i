%{
#include "handles/marker.hpp"
%}

%ignore pydart2::MarkerHandle::MarkerHandle; // handles come from their skeleton
%include "handles/marker.hpp"
