"""VTK's first picture as a whole process: ``python -m peers.start_vtk FORM.npz [OUT.png]``."""

from __future__ import annotations

import sys
from pathlib import Path

import vtk

from .setting import Form
from .with_vtk import Renderer


def main() -> None:
    """Draw one frame; write it if there is a name to write it to."""
    renderer = Renderer(1, 1)
    renderer.load(Form.read(Path(sys.argv[1])))
    renderer.draw(0)
    if len(sys.argv) > 2:
        source = vtk.vtkWindowToImageFilter()
        source.SetInput(renderer._window)
        source.ReadFrontBufferOff()
        writer = vtk.vtkPNGWriter()
        writer.SetFileName(sys.argv[2])
        writer.SetInputConnection(source.GetOutputPort())
        writer.Write()


if __name__ == "__main__":
    main()
