%{
#include "mesh.hpp"
%}

%ignore pydart2::MeshHandle::MeshHandle; // from ShapeHandle::mesh
%include "mesh.hpp"
