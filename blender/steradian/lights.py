"""Lights in Blender's glTF export: EXT_lights_area for area lights, which it leaves out; in the engine's own exports also what
KHR_lights_punctual cannot say: the size of a point, and how a spot of Blender falls off.

An area light of power P [W] and area A shines with the radiance P / (4 A) in Blender, whatever its shape (docs/lights.md).
"""

import base64
import math

AREA, PROFILE, PUNCTUAL = "EXT_lights_area", "EXT_lights_ies", "KHR_lights_punctual"


def emission(light):
    """Colour and power: of the light, times those of a node tree that is an emission and no more."""
    color, power = list(light.color), light.energy
    if light.use_nodes and light.node_tree:
        for node in light.node_tree.nodes:
            if node.type == "EMISSION":
                if node.inputs["Color"].is_linked or node.inputs["Strength"].is_linked:
                    print(f"steradian: {light.name}: only numbers are read of its node tree")
                color = [a * b for a, b in zip(color, node.inputs["Color"].default_value[:3])]
                power *= node.inputs["Strength"].default_value
                break
    return color, power


def area_light(light, scale):
    """The extension's light for a node of this scale in the world; None where it has no area.

    The draft scales by the largest of the three: what is uneven goes into the aspect. A disk's is an extra of ours.
    """
    width = abs(light.size * scale[0])
    height = abs((light.size_y if light.shape in ("RECTANGLE", "ELLIPSE") else light.size) * scale[1])
    kind = "disk" if light.shape in ("DISK", "ELLIPSE") else "rect"
    area = width * height * (math.pi / 4 if kind == "disk" else 1)
    if area == 0:
        return None
    color, power = emission(light)
    definition = {"name": light.name, "type": kind, "color": color, "size": height / max(abs(s) for s in scale), "intensity": power / (4 * area)}
    aspect = width / height
    if kind == "rect":
        definition["rect"] = {"aspect": aspect}
    elif abs(aspect - 1) > 1e-6:
        definition["extras"] = {"steradian": {"aspect": aspect}}
    return definition


def ball(light, scale):
    """A point light with a radius as a sphere, an addition of ours to the extension. The radius is not scaled in Blender, nor here."""
    radius = light.shadow_soft_size
    color, power = emission(light)
    return {"name": light.name, "type": "disk", "color": color, "size": 2 * radius / max(abs(s) for s in scale),
            "intensity": power / (math.pi * 4 * math.pi * radius**2), "extras": {"steradian": {"type": "sphere"}}}


def spot_profile(light, steps=512):
    """How a spot falls off, as an IES file of shares of the middle: c s((c - C) / ((1 - C) b)) of the cosine c, the rim's C, the blend b."""
    rim, blend = math.cos(light.spot_size / 2), light.spot_blend
    angles, shares = [], []
    for i in range(steps + 1):
        angle = light.spot_size / 2 * i / steps
        c = math.cos(angle)
        t = 1 if blend == 0 else min(max((c - rim) / ((1 - rim) * blend), 0), 1)
        angles.append(f"{math.degrees(angle):.7f}")
        shares.append(f"{c * t * t * (3 - 2 * t):.7f}")
    return "\n".join(["IES:LM-63-2019", "TILT=NONE", f"1 -1 1 {len(angles)} 1 1 2 0 0 0", "1 1 0", *angles, "0", *shares]) + "\n"


class NodeLights:
    """Puts lights on the exporter's nodes. all_of_blender: of the engine, whose reader knows the additions of ours."""

    def __init__(self, extension, child_of_root, all_of_blender):
        self.extension, self.child_of_root, self.all_of_blender = extension, child_of_root, all_of_blender

    def put(self, node, name, definition, **use):
        """A light of an extension, in its list at the root and on the node."""
        if self.all_of_blender and name == AREA:  # Cycles shows no lamps
            extras = definition.setdefault("extras", {}).setdefault("steradian", {})
            extras["seen"] = False
        root = self.child_of_root(path=["lights"], name=name, extension=definition, required=False)
        node.extensions = {k: v for k, v in (node.extensions or {}).items() if k != PUNCTUAL}
        node.extensions[name] = self.extension(name=name, extension={"light": root, **use}, required=False)

    def add(self, node, blender_object):
        """For one object of Blender."""
        light = blender_object.data
        scale = blender_object.matrix_world.to_scale()
        if light.type == "AREA":
            definition = area_light(light, scale)
            if definition is None:
                print(f"steradian: {blender_object.name}: a light without area is not exported")
            else:
                self.put(node, AREA, definition)
        elif self.all_of_blender and light.type == "POINT" and light.shadow_soft_size > 0 and max(abs(s) for s in scale) > 0:
            self.put(node, AREA, ball(light, scale))
        elif self.all_of_blender and light.type == "SPOT":
            color, power = emission(light)
            text = base64.b64encode(spot_profile(light).encode()).decode()
            self.put(node, PROFILE, {"name": light.name, "uri": "data:application/x-ies-lm-63;base64," + text},
                     color=color, multiplier=power / (4 * math.pi))
