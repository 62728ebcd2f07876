"""Steradian in Blender: a render engine, and area lights in Blender's own glTF export. docs/blender.md is the manual.

Install it as scripts/addons/steradian_render: the Python module of this project is called steradian.

SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
"""

bl_info = {
    "name": "Steradian",
    "author": "The Steradian authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "Render engines; File > Export > glTF 2.0",
    "description": "Direct light of area lights without sampling; area lights in glTF (EXT_lights_area)",
    "category": "Render",
}

from . import engine
from .export import Exporter as glTF2ExportUserExtension  # Blender's exporter looks for a class of this name in enabled add-ons


def register():
    engine.register()


def unregister():
    engine.unregister()
