%{
#include "loading/model_source.hpp"
%}

%ignore pydart2::ModelSource::texts;
%ignore pydart2::ModelSource::prefixes;
%ignore pydart2::unpack_source;
%ignore pydart2::make_retriever;
%include "loading/model_source.hpp"
