#version 450 core
layout(location = 0) out uint id;

void main() { id = uint(gl_PrimitiveID); }
