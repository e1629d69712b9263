"""moderngl without a window, by EGL; on a machine without GPU that is Mesa's llvmpipe."""

from __future__ import annotations

from importlib.metadata import version

import moderngl
import numpy as np

from .setting import (
    AMBIENT,
    BACKGROUND,
    DIFFUSE,
    EYE,
    LIGHT,
    POWER,
    SIDE_PX,
    SPECULAR,
    Bytes,
    Form,
    projection_matrix,
    view_matrix,
)

VERTEX = f"""
#version 330
uniform mat4 camera;
uniform vec3 eye, light;
in vec3 point, normal, color;
out vec3 lit;
void main() {{
    vec3 across = normalize(normalize(eye - point) + light);
    float cosine = dot(normal, light);
    float shine = cosine > 0.0 ? pow(max(dot(normal, across), 0.0), {POWER:.1f}) : 0.0;
    lit = color * ({AMBIENT} + {DIFFUSE} * max(cosine, 0.0)) + {SPECULAR} * shine;
    gl_Position = camera * vec4(point, 1.0);
}}
"""

FRAGMENT = """
#version 330
in vec3 lit;
out vec4 pixel;
void main() { pixel = vec4(lit, 1.0); }
"""


class Renderer:
    """moderngl; four samples are resolved by the driver."""

    def __init__(self, samples: int, threads: int) -> None:
        self._context = context = moderngl.create_context(standalone=True, backend="egl")
        self.name = f"moderngl {version('moderngl')}, {context.info['GL_RENDERER']}"
        size = (SIDE_PX, SIDE_PX)
        self._single = context.framebuffer([context.renderbuffer(size)], context.depth_renderbuffer(size))
        self._target = self._single
        if samples > 1:
            self._target = context.framebuffer(
                [context.renderbuffer(size, samples=samples)], context.depth_renderbuffer(size, samples=samples)
            )
        context.enable(moderngl.DEPTH_TEST | moderngl.CULL_FACE)
        self._program = context.program(vertex_shader=VERTEX, fragment_shader=FRAGMENT)
        matrix = projection_matrix() @ view_matrix()
        self._program["camera"].write(np.ascontiguousarray(matrix.T).tobytes())
        self._program["eye"].value, self._program["light"].value = tuple(EYE), tuple(LIGHT)
        self._picture = np.empty((SIDE_PX, SIDE_PX, 4), dtype=np.uint8)

    def load(self, form: Form) -> None:
        """Points and normals side by side, ready to be sent."""
        self._frames = np.concatenate([form.points, form.normals], axis=2)
        self._vertices = self._context.buffer(reserve=self._frames[0].nbytes, dynamic=True)
        self._form = self._context.vertex_array(
            self._program,
            [
                (self._vertices, "3f 3f", "point", "normal"),
                (self._context.buffer(form.colors.tobytes()), "3f", "color"),
            ],
            self._context.buffer(form.triangles.tobytes()),
        )

    def draw(self, frame: int) -> Bytes:
        """(H, W, 4) RGBA, last row first."""
        self._vertices.write(self._frames[frame])
        self._target.use()
        self._target.clear(*BACKGROUND, 1.0)
        self._form.render()
        if self._target is not self._single:
            self._context.copy_framebuffer(self._single, self._target)
        self._single.read_into(self._picture, components=4)
        return self._picture

    def upright(self, picture: Bytes) -> Bytes:
        """Turned over."""
        return picture[::-1, :, :3]
