%{
#include "handles/mesh.hpp"
%}

%ignore pydart2::MeshHandle::MeshHandle; // from ShapeHandle::mesh
%include "handles/mesh.hpp"
