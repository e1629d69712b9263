"""Voices, phones and the mouth: from text to sound and to what the face does while it is heard."""

from mien.core import SILENCE

from .hearing import Heard, hear
from .phones import CONSONANTS, PHONES, STOPS, VOWELS, stress_of, strip_stress
from .speaking import speak
from .voice import Speech, Utterance, Voice, find_speaker, find_voice, voices

__all__ = [
    "CONSONANTS",
    "PHONES",
    "SILENCE",
    "STOPS",
    "VOWELS",
    "Heard",
    "Speech",
    "Utterance",
    "Voice",
    "find_speaker",
    "find_voice",
    "hear",
    "speak",
    "stress_of",
    "strip_stress",
    "voices",
]
