"""Lights in Blender's glTF export: EXT_lights_area for area lights, which it leaves out; in the engine's own exports also what
KHR_lights_punctual cannot say: the size of a point, a spot and a sun, how a spot of Blender falls off, and the spread of an area light.

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


def file_of_profile(share_at, widest, steps=512):
    """An IES file, as a URI: the intensity at angles from the axis [rad] up to the widest, as shares of the middle's."""
    angles = [widest * i / steps for i in range(steps + 1)]
    text = "\n".join(["IES:LM-63-2019", "TILT=NONE", f"1 -1 1 {len(angles)} 1 1 2 0 0 0", "1 1 0", *(f"{math.degrees(a):.7f}" for a in angles), "0",
                      *(f"{share_at(a):.7f}" for a in angles)]) + "\n"
    return "data:application/x-ies-lm-63;base64," + base64.b64encode(text.encode()).decode()


def spot_profile(light):
    """How a spot falls off: c s((c - C) / ((1 - C) b)) of the cosine c, the rim's C, the blend b."""
    rim, blend = math.cos(light.spot_size / 2), light.spot_blend

    def share(angle):
        c = math.cos(angle)
        t = 1 if blend == 0 else min(max((c - rim) / ((1 - rim) * blend), 0), 1)
        return c * t * t * (3 - 2 * t)

    return file_of_profile(share, light.spot_size / 2)


LEAST_SPREAD = math.radians(1)  # Cycles' own


def spread_profile(light):
    """How an area light of a spread falls off, and its intensity straight ahead over that without a spread.

    Cycles has slats before it: of its radiance 1 - tan(angle) / tan(h) is left, h half of the spread, times what keeps the power.
    """
    h = max(light.spread, LEAST_SPREAD) / 2
    return file_of_profile(lambda angle: max(math.cos(angle) - math.sin(angle) / math.tan(h), 0), h), 1 / (1 - h / math.tan(h))


def far_disk(light, matrix, middle, reach):
    """A sun of an angle as a disk so far from the scene's middle that its direction is the same everywhere in it: the light, and its place.

    Its irradiance is that of Cycles: the strength times 2 (1 / cos a - 1) / tan(a)^2, a half of the angle. Cycles' disk is brighter at its rim.
    """
    color, strength = emission(light)
    half = min(light.angle, math.radians(179)) / 2
    distance, tangent = 1e4 * max(reach, 1e-3), math.tan(half)
    radiance = strength * 2 * (1 / math.cos(half) - 1) / tangent**2 / (math.pi * math.sin(half)**2)
    definition = {"name": light.name, "type": "disk", "color": color, "size": 2 * distance * tangent, "intensity": radiance}
    place = matrix.to_quaternion().to_matrix().to_4x4()
    place.translation = middle + distance * place.col[2].to_3d()
    return definition, place


class NodeLights:
    """Puts lights on the exporter's nodes. engine: the export of the engine, whose reader knows the additions of ours; else None."""

    def __init__(self, extension, child_of_root, engine):
        self.extension, self.child_of_root, self.engine = extension, child_of_root, engine

    def put(self, node, name, definition, **use):
        """A light of an extension, in its list at the root and on the node, in place of the exporter's own."""
        root = self.child_of_root(path=["lights"], name=name, extension=definition, required=False)
        self.take_away(node)
        node.extensions[name] = self.extension(name=name, extension={"light": root, **use}, required=False)

    @staticmethod
    def take_away(node):
        """The exporter's own light."""
        node.extensions = {k: v for k, v in (node.extensions or {}).items() if k != PUNCTUAL}

    def add(self, node, blender_object):
        """For one object of Blender."""
        light, matrix = blender_object.data, blender_object.matrix_world
        scale = matrix.to_scale()
        if light.type == "AREA":
            definition = area_light(light, scale)
            if definition is None:
                print(f"steradian: {blender_object.name}: a light without area is not exported")
                return
            if self.engine and light.spread < math.pi:
                uri, gain = spread_profile(light)
                width, height = (definition["size"] * max(abs(s) for s in scale) * a for a in (aspect_of(definition), 1))
                area = width * height * (math.pi / 4 if definition["type"] == "disk" else 1)
                shine_by(definition, uri, definition["intensity"] * area * gain)
            elif light.spread < math.pi:
                print(f"steradian: {blender_object.name}: its spread is not exported: glTF's area lights have none")
            self.put(node, AREA, unseen(definition) if self.engine else definition)
        elif not self.engine or max(abs(s) for s in scale) == 0:
            return
        elif light.type == "POINT" and light.shadow_soft_size > 0:
            self.put(node, AREA, unseen(ball(light, scale)))
        elif light.type == "SPOT":
            color, power = emission(light)
            uri, candela = spot_profile(light), power / (4 * math.pi)
            if light.shadow_soft_size > 0:
                definition = {"name": light.name, "type": "disk", "color": color, "size": 2 * light.shadow_soft_size / max(abs(s) for s in scale)}
                shine_by(definition, uri, candela)
                self.put(node, AREA, unseen(definition))
            else:
                self.put(node, PROFILE, {"name": light.name, "uri": uri}, color=color, multiplier=candela)
        elif light.type == "SUN" and light.angle > 0:
            self.take_away(node)
            definition, place = far_disk(light, matrix, *self.engine.extent())
            self.engine.added.append((unseen(definition), place))


def ours(definition):
    """What the light's extra of ours holds."""
    return definition.setdefault("extras", {}).setdefault("steradian", {})


def unseen(definition):
    """Cycles shows no lamps."""
    ours(definition)["seen"] = False
    return definition


def aspect_of(definition):
    """Width over height."""
    return definition["rect"]["aspect"] if definition["type"] == "rect" else ours(definition).get("aspect", 1)


def shine_by(definition, uri, candela):
    """Has a flat light shine by a profile; finish() gives it its place in the file."""
    ours(definition)["profile"] = {"uri": uri, "multiplier": candela}


def finish(gltf, added, to_gltf):
    """Completes an export of the engine: lights that hang on no node of Blender's, and the profiles that lights name."""
    scene = gltf["scenes"][gltf.get("scene", 0)]
    for definition, place in added:
        area = gltf.setdefault("extensions", {}).setdefault(AREA, {"lights": []})["lights"]
        area.append(definition)
        matrix = (to_gltf @ place).transposed()  # a light shines along its own -z in both
        scene.setdefault("nodes", []).append(len(gltf.setdefault("nodes", [])))
        gltf["nodes"].append({"name": definition["name"], "matrix": [x for column in matrix for x in column],
                              "extensions": {AREA: {"light": len(area) - 1}}})
    extensions = gltf.get("extensions", {})
    for definition in extensions.get(AREA, {"lights": []})["lights"]:
        profile = definition.get("extras", {}).get("steradian", {}).get("profile")
        if profile:
            lights = extensions.setdefault(PROFILE, {"lights": []})["lights"]
            profile["light"] = len(lights)
            lights.append({"uri": profile.pop("uri")})
    gltf["extensionsUsed"] = sorted({*gltf.get("extensionsUsed", []), *extensions})
