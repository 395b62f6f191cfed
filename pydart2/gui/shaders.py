"""The GLSL programs. Colours are squared to be about linear in light, and their root is what is shown."""

from __future__ import annotations

from typing import Any

import numpy as np
from OpenGL import GL

from pydart2.gui.context import ContextError

#: Attribute locations, the same in all programs.
POSITION, NORMAL, COORDINATES, COLOR = 0, 1, 2, 3
INSTANCE = 4  # three rows of the transform, colour, [specular, skeleton id, body id, grid]

_HEAD = "#version 330 compatibility\n"

_INSTANCE = """
layout(location = 0) in vec3 a_position;
layout(location = 1) in vec3 a_normal;
layout(location = 2) in vec2 a_coordinates;
layout(location = 3) in vec4 a_color;
layout(location = 4) in vec4 i_row0;
layout(location = 5) in vec4 i_row1;
layout(location = 6) in vec4 i_row2;
layout(location = 7) in vec4 i_color;
layout(location = 8) in vec4 i_extra;

vec3 to_world(vec3 p) {
    vec4 point = vec4(p, 1.0);
    return vec3(dot(i_row0, point), dot(i_row1, point), dot(i_row2, point));
}

// By the inverse transpose; the transform is a rotation after a scaling.
vec3 normal_to_world(vec3 n) {
    vec3 x = vec3(i_row0.x, i_row1.x, i_row2.x);
    vec3 y = vec3(i_row0.y, i_row1.y, i_row2.y);
    vec3 z = vec3(i_row0.z, i_row1.z, i_row2.z);
    return x * (n.x / dot(x, x)) + y * (n.y / dot(y, y)) + z * (n.z / dot(z, z));
}
"""

_LIT_VERTEX = """
uniform mat4 u_view_projection;
uniform mat4 u_shadow;
uniform vec3 u_eye;
uniform float u_shadow_push;
invariant gl_Position; // floors are drawn in two parts
out vec3 v_to_eye;
out vec3 v_normal;
flat out vec4 v_color; // with the strength of highlights, if no alpha is needed
#ifdef BLEND
flat out float v_specular;
#endif
#ifdef SHADOW
out vec3 v_shadow;
#endif
#ifdef RICH
out vec2 v_coordinates;
out vec4 v_tint;
#endif
#ifdef GRID
out vec3 v_world;
flat out float v_cell;
#endif

void emit(vec3 world, vec3 normal, vec4 color, float specular) {
    gl_Position = u_view_projection * vec4(world, 1.0);
    v_to_eye = u_eye - world;
    v_normal = normal;
#ifdef BLEND
    v_color = vec4(color.rgb * color.rgb, color.a);
    v_specular = specular;
#else
    v_color = vec4(color.rgb * color.rgb, specular);
#endif
#ifdef SHADOW
    v_shadow = (u_shadow * vec4(world + u_shadow_push * normalize(normal), 1.0)).xyz;
#endif
}
"""

_WORLD_MAIN = """
void main() {
    vec3 world = to_world(a_position);
    emit(world, normal_to_world(a_normal), i_color, i_extra.x);
#ifdef RICH
    v_coordinates = a_coordinates;
    v_tint = a_color * a_color;
#endif
#ifdef GRID
    v_world = world;
    v_cell = i_extra.w;
#endif
}
"""

# For what user code draws: OpenGL's own matrices and colour.
_FIXED_MAIN = """
uniform mat4 u_eye_to_world;
void main() {
    vec4 point = vec4(a_position, 1.0);
    vec3 world = (u_eye_to_world * (gl_ModelViewMatrix * point)).xyz;
    emit(world, mat3(u_eye_to_world) * (gl_NormalMatrix * a_normal), gl_Color, 0.2);
    gl_Position = gl_ModelViewProjectionMatrix * point;
}
"""

_LIT_FRAGMENT = """
uniform vec3 u_up;
uniform vec3 u_light;        // towards the light
uniform vec3 u_key;          // its colour
uniform vec3 u_sky;          // light from above and below
uniform vec3 u_floor;
uniform vec3 u_fill;         // from the eye
uniform sampler2DShadow u_shadow_map;
uniform float u_shadow_size; // of one texel; 0 without shadows
in vec3 v_to_eye;
in vec3 v_normal;
flat in vec4 v_color;
#ifdef BLEND
flat in float v_specular;
#endif
#ifdef SHADOW
in vec3 v_shadow;
#endif
#ifdef RICH
uniform sampler2D u_texture;
in vec2 v_coordinates;
in vec4 v_tint;
#endif
#ifdef GRID
in vec3 v_world;
flat in float v_cell;
#endif
layout(location = 0) out vec4 color;

float lit_part() {
#if defined SOFT
    // Four taps that the hardware blurs each over two by two texels: an edge a few texels wide.
    float t = u_shadow_size;
    return 0.25 * (texture(u_shadow_map, v_shadow + vec3(-0.4, -1.2, 0.0) * t)
        + texture(u_shadow_map, v_shadow + vec3(1.2, -0.4, 0.0) * t)
        + texture(u_shadow_map, v_shadow + vec3(0.4, 1.2, 0.0) * t)
        + texture(u_shadow_map, v_shadow + vec3(-1.2, 0.4, 0.0) * t));
#elif defined SHADOW
    return texture(u_shadow_map, v_shadow);
#else
    return 1.0;
#endif
}

#ifdef GRID
// A chessboard of cells, and the mean of its colours where cells are smaller than pixels.
vec3 grid(vec3 albedo) {
    vec3 east = abs(u_up.y) > 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
    vec3 right = normalize(cross(u_up, east));
    vec2 p = vec2(dot(v_world, right), dot(v_world, cross(right, u_up))) / v_cell;
    vec2 width = max(fwidth(p), 1e-6);
    // The mean of a square wave over the pixel, along each axis.
    vec2 i = (abs(fract((p - 0.5 * width) / 2.0) - 0.5) - abs(fract((p + 0.5 * width) / 2.0) - 0.5)) * 2.0 / width;
    i = mix(i, vec2(0.0), clamp(width - 0.75, 0.0, 1.0));
    vec2 line = 1.0 - smoothstep(0.5 * width, 1.5 * width, abs(fract(p - 0.5) - 0.5));
    float lines = max(line.x, line.y) * clamp(1.5 - 4.0 * max(width.x, width.y), 0.0, 1.0);
    return albedo * (1.0 - 0.07 * (0.5 - 0.5 * i.x * i.y) - 0.14 * lines);
}
#endif

void main() {
    vec3 albedo = v_color.rgb;
#ifdef BLEND
    float alpha = v_color.a, specular = v_specular;
#else
    float alpha = 1.0, specular = v_color.a;
#endif
#ifdef RICH
    vec4 texel = texture(u_texture, v_coordinates);
    albedo *= v_tint.rgb * texel.rgb * texel.rgb;
    alpha *= v_tint.a * texel.a;
#endif
#ifdef GRID
    if (dot(v_normal, u_up) > 0.7 * length(v_normal)) albedo = grid(albedo);
#endif
    vec3 normal = normalize(v_normal);
    vec3 to_eye = normalize(v_to_eye);
    float facing = dot(normal, to_eye);
#ifndef CLOSED
    if (facing < 0.0) { normal = -normal; facing = -facing; }
#endif
    float towards = dot(normal, u_light);
    float key = clamp(towards, 0.0, 1.0) * lit_part();
    vec3 light = mix(u_floor, u_sky, 0.5 + 0.5 * dot(normal, u_up)) + u_fill * max(facing, 0.0) + u_key * key;
    float shine = max(dot(normal, normalize(u_light + to_eye)), 0.0);
    shine *= shine; shine *= shine; shine *= shine; shine *= shine; shine *= shine;
    vec3 shown = albedo * light + u_key * (specular * shine * min(4.0 * key, 1.0));
    color = vec4(sqrt(shown), alpha);
}
"""

_SHADOW_VERTEX = """
uniform mat4 u_view_projection;
void main() { gl_Position = u_view_projection * vec4(to_world(a_position), 1.0); }
"""

_SHADOW_FRAGMENT = "void main() {}\n"

_BODIES_VERTEX = """
uniform mat4 u_view_projection;
uniform vec4 u_depth_row;
out float v_depth;
flat out ivec2 v_ids;
void main() {
    vec3 world = to_world(a_position);
    gl_Position = u_view_projection * vec4(world, 1.0);
    v_depth = dot(u_depth_row, vec4(world, 1.0));
    v_ids = ivec2(i_extra.yz);
}
"""

_BODIES_FRAGMENT = """
in float v_depth;
flat in ivec2 v_ids;
layout(location = 0) out ivec2 ids;
layout(location = 1) out float depth;
void main() { ids = v_ids; depth = v_depth; }
"""

_SKY_VERTEX = """
out float v_height;
void main() {
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    v_height = corner.y;
    gl_Position = vec4(2.0 * corner - 1.0, 1.0, 1.0);
}
"""

_SKY_FRAGMENT = """
uniform vec3 u_top;
uniform vec3 u_bottom;
in float v_height;
layout(location = 0) out vec4 color;
void main() { color = vec4(mix(u_bottom, u_top, v_height), 1.0); }
"""


class Program:
    """A linked program and the places of its uniforms."""

    def __init__(self, vertex: str, fragment: str) -> None:
        self.id = GL.glCreateProgram()
        for kind, source in ((GL.GL_VERTEX_SHADER, vertex), (GL.GL_FRAGMENT_SHADER, fragment)):
            shader = GL.glCreateShader(kind)
            GL.glShaderSource(shader, source)
            GL.glCompileShader(shader)
            if not GL.glGetShaderiv(shader, GL.GL_COMPILE_STATUS):
                raise ContextError(f"this OpenGL refuses a shader: {_text(GL.glGetShaderInfoLog(shader))}")
            GL.glAttachShader(self.id, shader)
            GL.glDeleteShader(shader)
        GL.glLinkProgram(self.id)
        if not GL.glGetProgramiv(self.id, GL.GL_LINK_STATUS):
            raise ContextError(f"this OpenGL refuses a program: {_text(GL.glGetProgramInfoLog(self.id))}")
        self._places: dict[str, int] = {}
        self._values: dict[str, object] = {}  # as OpenGL has them

    def use(self) -> None:
        """Make it current."""
        GL.glUseProgram(self.id)

    def place(self, name: str) -> int:
        """Of a uniform; -1, which is ignored, if the program does not use it."""
        if name not in self._places:
            self._places[name] = GL.glGetUniformLocation(self.id, name)
        return self._places[name]

    def set(self, **uniforms: Any) -> None:
        """Set uniforms of the current program: floats, vectors (3,), (4,), matrices (4, 4); ints are texture units."""
        for name, value in uniforms.items():
            place = self.place(f"u_{name}")
            known = value.tobytes() if isinstance(value, np.ndarray) else value
            if place < 0 or self._values.get(name) == known:
                continue
            self._values[name] = known
            if isinstance(value, int):
                GL.glUniform1i(place, value)
            elif isinstance(value, float):
                GL.glUniform1f(place, value)
            elif len(value) == 3:
                GL.glUniform3f(place, *value)
            elif value.shape == (4,):
                GL.glUniform4f(place, *value)
            else:
                GL.glUniformMatrix4fv(place, 1, GL.GL_TRUE, value.astype("f4"))


def lit(*features: str) -> Program:
    """Draws in light: instances of meshes or, with FIXED, a mesh with OpenGL's own matrices and colour.

    RICH has textures and vertex colours, GRID a grid on top, CLOSED no back sides, SHADOW shadows,
    with SOFT blurred ones, BLEND an alpha.
    """
    head = _HEAD + "".join(f"#define {feature}\n" for feature in features)
    main = _FIXED_MAIN if "FIXED" in features else _WORLD_MAIN
    return Program(head + _INSTANCE + _LIT_VERTEX + main, head + _LIT_FRAGMENT)


def shadow() -> Program:
    """Draws instances into the shadow map."""
    return Program(_HEAD + _INSTANCE + _SHADOW_VERTEX, _HEAD + _SHADOW_FRAGMENT)


def bodies() -> Program:
    """Draws the ids of bodies, and the depth."""
    return Program(_HEAD + _INSTANCE + _BODIES_VERTEX, _HEAD + _BODIES_FRAGMENT)


def sky() -> Program:
    """Fills the picture from top to bottom."""
    return Program(_HEAD + _SKY_VERTEX, _HEAD + _SKY_FRAGMENT)


def _text(log: bytes | str) -> str:
    return log.decode(errors="replace") if isinstance(log, bytes) else log
