"""The types that every part of mien speaks. NumPy only."""

from .cues import SILENCE, Cue
from .drawing import Drawing, Path, Region
from .errors import LoadError, MienError, RangeError, UnknownNameError
from .exaggeration import caricature, exaggerate
from .face import Face, Preset
from .mesh import Material, Mesh, Part, Topology, build_topology
from .parameters import Parameter, ParameterTable, Pose, both_sides, color
from .rig import Joint, Motion, Rig, Rigged
from .scene import Light, Scene, fill_rows
from .sound import Sound
from .sound_store import SoundStore
from .subdivision import subdivide
from .variety import mix_people, random_person

__all__ = [
    "SILENCE",
    "Cue",
    "Drawing",
    "Face",
    "Joint",
    "Light",
    "LoadError",
    "Material",
    "Mesh",
    "MienError",
    "Motion",
    "Parameter",
    "ParameterTable",
    "Part",
    "Path",
    "Pose",
    "Preset",
    "RangeError",
    "Region",
    "Rig",
    "Rigged",
    "Scene",
    "Sound",
    "SoundStore",
    "Topology",
    "UnknownNameError",
    "both_sides",
    "build_topology",
    "caricature",
    "color",
    "exaggerate",
    "fill_rows",
    "mix_people",
    "random_person",
    "subdivide",
]
