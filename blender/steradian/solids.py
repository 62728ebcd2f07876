"""Glass in Blender's glTF export. Blender bends rays at every face; glTF does so only for materials of a thickness, and Blender's exporter
writes one only for a node group of its own. So closed meshes of glass get a thickness here, and glass on open meshes stays a thin wall.
"""

import copy
import math

TRANSMISSION, VOLUME = "KHR_materials_transmission", "KHR_materials_volume"


def mean_chord(mesh, slots):
    """Four times the volume over the area of the faces in these material slots; None where they are not closed: an edge has not just two."""
    import numpy  # the exporter needs it, too; Debian's Blender does not ask for it

    mesh.calc_loop_triangles()
    count = len(mesh.loop_triangles)
    corners, materials = numpy.empty(3 * count, numpy.int32), numpy.empty(count, numpy.int32)
    mesh.loop_triangles.foreach_get("vertices", corners)
    mesh.loop_triangles.foreach_get("material_index", materials)
    places = numpy.empty(3 * len(mesh.vertices), numpy.float32)
    mesh.vertices.foreach_get("co", places)
    triangles = corners.reshape(-1, 3)[numpy.isin(materials, slots)]
    if len(triangles) == 0:
        return None
    # Files of other programs split the vertices along seams.
    places, vertex_of = numpy.unique(places.reshape(-1, 3), axis=0, return_inverse=True)
    triangles = vertex_of.reshape(-1)[triangles]
    edges = numpy.sort(numpy.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    if (numpy.unique(edges, axis=0, return_counts=True)[1] != 2).any():
        return None
    a, b, c = (places[triangles[:, k]].astype(float) for k in range(3))
    normals = numpy.cross(b - a, c - a)
    area, volume = numpy.linalg.norm(normals, axis=1).sum() / 2, abs((a * normals).sum()) / 6
    return 4 * volume / area if volume > 0 else None


def absorption(material):
    """The extension's values for a Volume Absorption node on the material's output: of the light, exp(-density (1 - color) x) is left after x."""
    outputs = [n for n in material.node_tree.nodes if n.type == "OUTPUT_MATERIAL" and n.is_active_output] if material.use_nodes else []
    links = outputs[0].inputs["Volume"].links if outputs else []
    if not links:
        return {}
    node = links[0].from_node
    color, density = node.inputs.get("Color"), node.inputs.get("Density")
    if node.type != "VOLUME_ABSORPTION" or color.is_linked or density.is_linked:
        print(f"steradian: {material.name}: only a Volume Absorption of numbers is exported")
        return {}
    if density.default_value <= 0:
        return {}
    return {"attenuationDistance": 1 / density.default_value, "attenuationColor": [math.exp(c - 1) for c in color.default_value[:3]]}


class Solids:
    """Gives the exporter's materials of closed meshes their thickness."""

    def __init__(self, extension):
        self.extension = extension
        self.known = {}   # the exporter's material and Blender's, by the former's id
        self.copies = {}  # of a thickness, by id and thickness

    def remember(self, material, blender_material):
        """For one material of the exporter."""
        self.known[id(material)] = material, blender_material

    def add(self, mesh, blender_mesh, materials):
        """For one mesh, and the materials of its slots. They may also be those of other meshes, so one with a thickness is a copy."""
        for primitive in mesh.primitives:
            material, blender_material = self.known.get(id(primitive.material), (None, None))
            extensions = getattr(material, "extensions", None) or {}
            if TRANSMISSION not in extensions or VOLUME in extensions:
                continue
            chord = mean_chord(blender_mesh, [slot for slot, other in enumerate(materials) if other == blender_material])
            if chord is None:
                print(f"steradian: {mesh.name}: glass on a mesh that is not closed is a thin wall, and bends no light")
                continue
            primitive.material = self.of_thickness(material, blender_material, float(f"{chord:.4g}"))

    def of_thickness(self, material, blender_material, thickness):
        """The material with this thickness, in units of its mesh."""
        key = id(material), thickness
        if key not in self.copies:
            solid = copy.copy(material)
            values = {"thicknessFactor": thickness, **absorption(blender_material)}
            solid.extensions = {**material.extensions, VOLUME: self.extension(name=VOLUME, extension=values, required=False)}
            self.copies[key] = solid
        return self.copies[key]
