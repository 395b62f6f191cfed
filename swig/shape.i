%{
#include "handles/shape.hpp"
%}

%ignore pydart2::ShapeHandle::ShapeHandle; // from ShapeNodeHandle::shape
%ignore pydart2::ShapeHandle::Node;
%ignore pydart2::ShapeNodeHandle::ShapeNodeHandle; // from BodyNodeHandle::shapenode
%include "handles/shape.hpp"
