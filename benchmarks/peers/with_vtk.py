"""VTK, off the screen."""

from __future__ import annotations

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy

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


class Renderer:
    """VTK's OpenGL renderer; four samples are its multisampling."""

    def __init__(self, samples: int, threads: int) -> None:
        self._renderer = vtk.vtkRenderer()
        self._renderer.SetBackground(*BACKGROUND)
        self._renderer.AutomaticLightCreationOff()
        light = vtk.vtkLight()
        light.SetPosition(*(100.0 * LIGHT))
        light.SetFocalPoint(0.0, 0.0, 0.0)
        self._renderer.AddLight(light)
        camera = self._renderer.GetActiveCamera()
        camera.SetPosition(*EYE)
        camera.SetFocalPoint(0.0, 0.0, 0.0)
        camera.SetViewUp(0.0, 1.0, 0.0)
        camera.SetViewAngle(FOV_DEG)
        camera.SetClippingRange(NEAR_M, FAR_M)
        self._window = window = vtk.vtkRenderWindow()
        window.SetOffScreenRendering(1)
        window.SetMultiSamples(samples if samples > 1 else 0)
        window.SetSize(SIDE_PX, SIDE_PX)
        window.AddRenderer(self._renderer)
        window.Render()
        driver = next((line for line in window.ReportCapabilities().splitlines() if "renderer string" in line), ":")
        self.name = f"VTK {vtk.vtkVersion.GetVTKVersion()}, {driver.split(':', 1)[1].strip()}"
        self._pixels = vtk.vtkUnsignedCharArray()

    def load(self, form: Form) -> None:
        """Arrays of VTK's own that NumPy sees as well."""
        self._frames, self._normals = form.points, form.normals
        count = len(form.triangles)
        self._points, normals = vtk.vtkPoints(), numpy_to_vtk(form.normals[0], deep=True)
        self._points.SetData(numpy_to_vtk(form.points[0], deep=True))
        cells = vtk.vtkCellArray()
        cells.SetData(
            numpy_to_vtkIdTypeArray(np.arange(count + 1, dtype=np.int64) * 3, deep=True),
            numpy_to_vtkIdTypeArray(form.triangles.ravel().astype(np.int64), deep=True),
        )
        self._data = vtk.vtkPolyData()
        self._data.SetPoints(self._points)
        self._data.SetPolys(cells)
        self._data.GetPointData().SetNormals(normals)
        self._data.GetPointData().SetScalars(numpy_to_vtk(np.rint(form.colors * 255).astype(np.uint8), deep=True))
        mapper = vtk.vtkPolyDataMapper()
        mapper.SetInputData(self._data)
        mapper.StaticOn()
        actor = vtk.vtkActor()
        actor.SetMapper(mapper)
        surface = actor.GetProperty()
        surface.SetInterpolationToGouraud()
        surface.SetAmbient(AMBIENT)
        surface.SetDiffuse(DIFFUSE)
        surface.SetSpecular(SPECULAR)
        surface.SetSpecularPower(POWER)
        surface.BackfaceCullingOn()
        self._renderer.RemoveAllViewProps()
        self._renderer.AddActor(actor)
        self._into_points, self._into_normals = vtk_to_numpy(self._points.GetData()), vtk_to_numpy(normals)
        self._vtk_normals = normals

    def draw(self, frame: int) -> Bytes:
        """(H W, 4) RGBA, last row first."""
        np.copyto(self._into_points, self._frames[frame])
        np.copyto(self._into_normals, self._normals[frame])
        self._points.Modified()
        self._vtk_normals.Modified()
        self._data.Modified()
        self._window.Render()
        self._window.GetRGBACharPixelData(0, 0, SIDE_PX - 1, SIDE_PX - 1, 0, self._pixels)
        return vtk_to_numpy(self._pixels)

    def upright(self, picture: Bytes) -> Bytes:
        """Turned over."""
        return picture.reshape(SIDE_PX, SIDE_PX, 4)[::-1, :, :3]
