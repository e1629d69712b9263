"""Panda3D's software renderer tinydisplay, into a buffer."""

from __future__ import annotations

import numpy as np
from panda3d import core

from .setting import (
    AMBIENT,
    BACKGROUND,
    DIFFUSE,
    EYE,
    FAR_M,
    FOV_DEG,
    LIGHT,
    NEAR_M,
    POWER,
    SIDE_PX,
    SPECULAR,
    Bytes,
    Form,
)

SETTINGS = "audio-library-name null\nsync-video 0\ncoordinate-system yup-right\nnotify-level-display error"


class Renderer:
    """tinydisplay has no anti-aliasing."""

    def __init__(self, samples: int, threads: int) -> None:
        core.load_prc_file_data("", SETTINGS)
        self.name = f"Panda3D {core.PandaSystem.get_version_string()}, tinydisplay"
        self._engine = core.GraphicsEngine.get_global_ptr()
        pipe = core.GraphicsPipeSelection.get_global_ptr().make_pipe("TinyOffscreenGraphicsPipe", "p3tinydisplay")
        layout = core.FrameBufferProperties()
        layout.set_rgba_bits(8, 8, 8, 8)
        layout.set_depth_bits(16)
        size = core.WindowProperties.size(SIDE_PX, SIDE_PX)
        buffer = self._engine.make_output(pipe, "picture", 0, layout, size, core.GraphicsPipe.BF_refuse_window)
        buffer.set_clear_color((*BACKGROUND, 1.0))
        self._picture = core.Texture()
        buffer.add_render_texture(self._picture, core.GraphicsOutput.RTM_copy_ram, core.GraphicsOutput.RTP_color)
        self._root = core.NodePath("root")
        lens = core.PerspectiveLens()
        lens.set_fov(FOV_DEG)
        lens.set_near_far(NEAR_M, FAR_M)
        camera = self._root.attach_new_node(core.Camera("camera", lens))
        camera.set_pos(*EYE)
        camera.look_at((0.0, 0.0, 0.0), (0.0, 1.0, 0.0))
        buffer.make_display_region().set_camera(camera)
        ambient, sun = core.AmbientLight("ambient"), core.DirectionalLight("sun")
        ambient.set_color((AMBIENT, AMBIENT, AMBIENT, 1.0))
        sun.set_color((DIFFUSE, DIFFUSE, DIFFUSE, 1.0))
        sun.set_direction(core.LVector3(*-LIGHT))
        for light in (ambient, sun):
            self._root.set_light(self._root.attach_new_node(light))
        self._form: core.NodePath | None = None

    def load(self, form: Form) -> None:
        """Points and normals in one array of Panda3D's, colours in another."""
        moving, still = core.GeomVertexArrayFormat(), core.GeomVertexArrayFormat()
        moving.add_column("vertex", 3, core.Geom.NT_float32, core.Geom.C_point)
        moving.add_column("normal", 3, core.Geom.NT_float32, core.Geom.C_normal)
        still.add_column("color", 4, core.Geom.NT_uint8, core.Geom.C_color)
        layout = core.GeomVertexFormat()
        layout.add_array(moving)
        layout.add_array(still)
        count = form.points.shape[1]
        vertices = core.GeomVertexData("form", core.GeomVertexFormat.register_format(layout), core.Geom.UH_dynamic)
        vertices.unclean_set_num_rows(count)
        rgba = np.full((count, 4), 255, dtype=np.uint8)
        rgba[:, :3] = np.rint(form.colors * 255)
        vertices.modify_array_handle(1).copy_data_from(rgba)
        self._frames = np.concatenate([form.points, form.normals], axis=2)
        vertices.modify_array_handle(0).copy_data_from(self._frames[0])
        triangles = core.GeomTriangles(core.Geom.UH_static)
        triangles.set_index_type(core.Geom.NT_uint32)
        triangles.modify_vertices().unclean_set_num_rows(form.triangles.size)
        triangles.modify_vertices().modify_handle().copy_data_from(form.triangles.astype(np.uint32))
        geometry = core.Geom(vertices)
        geometry.add_primitive(triangles)
        node = core.GeomNode("form")
        node.add_geom(geometry)
        if self._form is not None:
            self._form.remove_node()
        self._form = self._root.attach_new_node(node)
        surface = core.Material()
        surface.set_ambient((1.0, 1.0, 1.0, 1.0))
        surface.set_diffuse((1.0, 1.0, 1.0, 1.0))
        surface.set_specular((SPECULAR / DIFFUSE,) * 3 + (1.0,))
        surface.set_shininess(POWER)
        self._form.set_material(surface)
        self._node = node

    def draw(self, frame: int) -> Bytes:
        """(H, W, 4) BGRA, last row first."""
        vertices = self._node.modify_geom(0).modify_vertex_data()
        vertices.modify_array_handle(0).copy_data_from(self._frames[frame])
        self._engine.render_frame()
        return np.frombuffer(self._picture.get_ram_image(), dtype=np.uint8).reshape(SIDE_PX, SIDE_PX, 4)

    def upright(self, picture: Bytes) -> Bytes:
        """Turned over, red first."""
        return picture[::-1, :, 2::-1]
