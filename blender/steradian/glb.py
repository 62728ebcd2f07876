"""The JSON of a .glb, changed."""

import json
import struct


def edit(data, change):
    """The file with what change(gltf) has done to its JSON."""
    length, = struct.unpack_from("<I", data, 12)
    gltf = json.loads(data[20:20 + length])
    change(gltf)
    text = json.dumps(gltf).encode()
    text += b" " * (-len(text) % 4)
    rest = data[20 + length:]
    return struct.pack("<4sIIII", b"glTF", 2, 20 + len(text) + len(rest), len(text), 0x4E4F534A) + text + rest
