"""What Blender's glTF exporter leaves of a Principled BSDF: anisotropy, sheen, and what Specular 0 means."""

import math

# The roughness and the factor that bring the albedos of Disney's sheen (1 - l.h)^5 and of glTF's Charlie lobe together: 9 % rms over the
# views, weighted by their cosine (docs/blender-conversion.md).
SHEEN_ROUGHNESS, SHEEN_FACTOR = 0.38, 0.122
# Blender's coat is a quarter of glTF's.
COAT_FACTOR = 0.25


def principled(material):
    """The material's Principled BSDF, if it has one."""
    tree = material.node_tree if material.use_nodes else None
    return next((n for n in tree.nodes if n.type == "BSDF_PRINCIPLED" and not n.mute), None) if tree else None


def number(node, name):
    """An input that is a number; None where nodes make it."""
    socket = node.inputs.get(name)
    return None if socket is None or socket.is_linked else socket.default_value


def tinted(base, tint):
    """White, or by the share `tint` the base colour at luminance 1."""
    if base is None or not tint:
        return [1, 1, 1]
    luminance = 0.2126 * base[0] + 0.7152 * base[1] + 0.0722 * base[2]
    return [1 - tint + tint * (c / luminance if luminance > 0 else 1) for c in base[:3]]


class Completion:
    """Adds to the exporter's materials. all_of_blender: of the engine, also where glTF's and Blender's numbers mean different things."""

    def __init__(self, extension, all_of_blender):
        self.extension, self.all_of_blender = extension, all_of_blender

    def put(self, material, name, values):
        """An extension of a material."""
        material.extensions = material.extensions or {}
        material.extensions[name] = self.extension(name=name, extension=values, required=False)

    def add(self, material, blender_material):
        """For one material."""
        extensions = material.extensions or {}
        specular = extensions.get("KHR_materials_specular")
        if specular is not None and list(specular.extension.get("specularColorFactor", [1])) == [0, 0, 0]:
            specular.extension["specularFactor"] = 0  # no reflection at all; the exporter leaves the one at grazing angles
        node = principled(blender_material)
        if node is None:
            return
        self.add_anisotropy(material, node)
        self.add_sheen(material, node)
        if self.all_of_blender:
            self.put_reflections_on_top(material, node)

    def add_anisotropy(self, material, node):
        """Blender's widths are r^2 / a along the tangent and r^2 a across it, a^2 = 1 - 0.9 anisotropic; glTF's are
        alpha + (1 - alpha) strength^2 and alpha."""
        anisotropic, roughness = number(node, "Anisotropic"), number(node, "Roughness")
        if not anisotropic or material.pbr_metallic_roughness is None:
            return
        if roughness is None:
            print("steradian: anisotropy under a texture of roughness is not exported")
            return
        aspect = math.sqrt(1 - 0.9 * anisotropic)
        across = max(roughness**2 * aspect, 1e-4)
        along = min(roughness**2 / aspect, 1)
        if across >= 1:
            return
        material.pbr_metallic_roughness.roughness_factor = math.sqrt(across)
        self.put(material, "KHR_materials_anisotropy", {"anisotropyStrength": math.sqrt(max(along - across, 0) / (1 - across)),
                                                       "anisotropyRotation": 2 * math.pi * (number(node, "Anisotropic Rotation") or 0)})

    def put_reflections_on_top(self, material, node):
        """Blender adds reflections to the diffuse light, glTF takes from that what they reflect: where they are numbers, lobes in their place."""
        metallic, roughness, specular = (number(node, name) for name in ("Metallic", "Roughness", "Specular"))
        base, tint = number(node, "Base Color"), number(node, "Specular Tint")
        coat, coat_roughness = number(node, "Clearcoat"), number(node, "Clearcoat Roughness")
        extensions = material.extensions or {}
        if coat is None and "KHR_materials_clearcoat" in extensions:  # 1 times its texture
            extensions["KHR_materials_clearcoat"].extension["clearcoatFactor"] = COAT_FACTOR
        if None in (metallic, roughness, specular, tint, coat, coat_roughness) or number(node, "Transmission") != 0:
            return
        if number(node, "Anisotropic") != 0 or (base is None and (metallic > 0 or tint != 0)) or (metallic == 1 and coat == 0):
            return
        f0 = [0.08 * specular * c for c in tinted(base, tint)]
        if metallic > 0:
            f0 = [(1 - metallic) * a + metallic * b for a, b in zip(f0, base)]
        lobes = [{"brdf": "ggx", "roughness": roughness, "f0": f0}] if max(f0) > 0 else []
        if coat > 0:
            lobes.append({"brdf": "ggx", "roughness": coat_roughness, "f0": COAT_FACTOR * coat * 0.04, "f90": COAT_FACTOR * coat})
        if not lobes:
            return
        extensions.pop("KHR_materials_clearcoat", None)
        self.put(material, "KHR_materials_specular", {"specularFactor": 0})
        material.extras = {**(material.extras or {}), "steradian": lobes}

    def add_sheen(self, material, node):
        """Of a colour that is white, or by Sheen Tint the base colour at luminance 1."""
        sheen, tint, base = number(node, "Sheen"), number(node, "Sheen Tint"), number(node, "Base Color")
        if not sheen:
            return
        color = tinted(base, tint)
        weight = sheen * SHEEN_FACTOR * (1 - (number(node, "Metallic") or 0))
        self.put(material, "KHR_materials_sheen", {"sheenColorFactor": [weight * c for c in color], "sheenRoughnessFactor": SHEEN_ROUGHNESS})
