"""wgpu; on a machine without GPU that is Mesa's lavapipe."""

from __future__ import annotations

from importlib.metadata import version

import numpy as np
import wgpu

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

SHADER = f"""
struct Setting {{ camera: mat4x4f, eye: vec4f, light: vec4f }}
@group(0) @binding(0) var<uniform> setting: Setting;
struct Lit {{ @builtin(position) place: vec4f, @location(0) color: vec3f }}

@vertex fn light(@location(0) point: vec3f, @location(1) normal: vec3f, @location(2) color: vec3f) -> Lit {{
    let across = normalize(normalize(setting.eye.xyz - point) + setting.light.xyz);
    let cosine = dot(normal, setting.light.xyz);
    let shine = select(0.0, pow(max(dot(normal, across), 0.0), {POWER:.1f}), cosine > 0.0);
    let lit = color * ({AMBIENT} + {DIFFUSE} * max(cosine, 0.0)) + {SPECULAR} * shine;
    return Lit(setting.camera * vec4f(point, 1.0), lit);
}}

@fragment fn paint(lit: Lit) -> @location(0) vec4f {{ return vec4f(lit.color, 1.0); }}
"""

COLOR, DEPTH = "rgba8unorm", "depth32float"


class Renderer:
    """wgpu; four samples are resolved by the driver."""

    def __init__(self, samples: int, threads: int) -> None:
        adapter = wgpu.gpu.request_adapter_sync()
        self.name = f"wgpu {version('wgpu')}, {adapter.info['device']} ({adapter.info['backend_type']})"
        self._device = device = adapter.request_device_sync()
        size = (SIDE_PX, SIDE_PX, 1)
        usage = wgpu.TextureUsage.RENDER_ATTACHMENT
        self._picture = device.create_texture(size=size, format=COLOR, usage=usage | wgpu.TextureUsage.COPY_SRC)
        many = device.create_texture(size=size, format=COLOR, usage=usage, sample_count=samples)
        depth = device.create_texture(size=size, format=DEPTH, usage=usage, sample_count=samples)
        self._back = device.create_buffer(
            size=SIDE_PX * SIDE_PX * 4, usage=wgpu.BufferUsage.COPY_DST | wgpu.BufferUsage.MAP_READ
        )
        matrix = projection_matrix(zero_to_one=True) @ view_matrix()
        setting = np.concatenate([matrix.T.ravel(), EYE, [0.0], LIGHT, [0.0]]).astype(np.float32)
        uniform = device.create_buffer_with_data(data=setting, usage=wgpu.BufferUsage.UNIFORM)
        shader = device.create_shader_module(code=SHADER)
        self._pipeline = device.create_render_pipeline(
            layout="auto",
            vertex={"module": shader, "entry_point": "light", "buffers": [_columns(0, 2), _columns(2, 1)]},
            fragment={"module": shader, "entry_point": "paint", "targets": [{"format": COLOR}]},
            primitive={"topology": "triangle-list", "front_face": "ccw", "cull_mode": "back"},
            depth_stencil={"format": DEPTH, "depth_write_enabled": True, "depth_compare": "less"},
            multisample={"count": samples},
        )
        self._group = device.create_bind_group(
            layout=self._pipeline.get_bind_group_layout(0),
            entries=[{"binding": 0, "resource": {"buffer": uniform, "offset": 0, "size": setting.nbytes}}],
        )
        single = self._picture.create_view()
        self._targets = {
            "color_attachments": [
                {
                    "view": single if samples == 1 else many.create_view(),
                    "resolve_target": None if samples == 1 else single,
                    "clear_value": (*BACKGROUND, 1.0),
                    "load_op": "clear",
                    "store_op": "store" if samples == 1 else "discard",
                }
            ],
            "depth_stencil_attachment": {
                "view": depth.create_view(),
                "depth_clear_value": 1.0,
                "depth_load_op": "clear",
                "depth_store_op": "discard",
            },
        }

    def load(self, form: Form) -> None:
        """Points and normals side by side, ready to be sent."""
        device, usage = self._device, wgpu.BufferUsage
        self._frames = np.concatenate([form.points, form.normals], axis=2)
        self._vertices = device.create_buffer(size=self._frames[0].nbytes, usage=usage.VERTEX | usage.COPY_DST)
        self._colors = device.create_buffer_with_data(data=form.colors, usage=usage.VERTEX)
        self._triangles = device.create_buffer_with_data(data=form.triangles.astype(np.uint32), usage=usage.INDEX)
        self._corner_count = form.triangles.size

    def draw(self, frame: int) -> Bytes:
        """(H, W, 4) RGBA."""
        queue, encoder = self._device.queue, self._device.create_command_encoder()
        queue.write_buffer(self._vertices, 0, self._frames[frame])
        drawing = encoder.begin_render_pass(**self._targets)
        drawing.set_pipeline(self._pipeline)
        drawing.set_bind_group(0, self._group)
        drawing.set_vertex_buffer(0, self._vertices)
        drawing.set_vertex_buffer(1, self._colors)
        drawing.set_index_buffer(self._triangles, "uint32")
        drawing.draw_indexed(self._corner_count)
        drawing.end()
        rows = {"bytes_per_row": SIDE_PX * 4, "rows_per_image": SIDE_PX}
        encoder.copy_texture_to_buffer(
            {"texture": self._picture}, {"buffer": self._back, **rows}, (SIDE_PX, SIDE_PX, 1)
        )
        queue.submit([encoder.finish()])
        self._back.map_sync("READ")
        picture = np.frombuffer(self._back.read_mapped(), dtype=np.uint8).reshape(SIDE_PX, SIDE_PX, 4)
        self._back.unmap()
        return picture

    def upright(self, picture: Bytes) -> Bytes:
        """Its colours."""
        return picture[:, :, :3]


def _columns(first: int, count: int) -> dict[str, object]:
    rows = [{"format": "float32x3", "offset": 12 * k, "shader_location": first + k} for k in range(count)]
    return {"array_stride": 12 * count, "step_mode": "vertex", "attributes": rows}
