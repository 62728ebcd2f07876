"""Pictures of the program: OpenEXR in float, without what Blender would keep of an image. Read as it writes it, by lines and packed by zip."""

import struct
import zlib

import numpy


def read_exr(path):
    """The picture as an array of (height, width, 4) from the top: red, green, blue and alpha. Other layers are left out."""
    with open(path, "rb") as file:
        data = file.read()
    at, attributes = 8, {}
    while data[at]:
        name, kind, _ = data[at:at + 512].split(b"\0", 2)
        at += len(name) + len(kind) + 2
        size, = struct.unpack_from("<i", data, at)
        attributes[name.decode()] = data[at + 4:at + 4 + size]
        at += 4 + size
    channels, rest = [], attributes["channels"]
    while rest[0]:
        name, rest = rest.split(b"\0", 1)
        if struct.unpack_from("<i", rest)[0] != 2:
            raise ValueError(f"{path}: the channel {name.decode()} is not float")
        channels.append(name.decode())
        rest = rest[16:]
    x0, y0, x1, y1 = struct.unpack("<4i", attributes["dataWindow"])
    width, height = x1 - x0 + 1, y1 - y0 + 1
    if attributes["compression"] != b"\3":
        raise ValueError(f"{path}: not packed by zip, 16 lines a block")
    blocks = struct.unpack_from(f"<{(height + 15) // 16}Q", data, at + 1)
    picture = numpy.ones((height, width, 4), numpy.float32)
    for block in blocks:
        y, size = struct.unpack_from("<ii", data, block)
        y -= y0
        lines = min(16, height - y)
        packed = data[block + 8:block + 8 + size]
        whole = lines * len(channels) * width * 4
        values = numpy.frombuffer(packed, numpy.uint8) if size == whole else unpacked(packed, whole)
        values = values.view("<f4").reshape(lines, len(channels), width)
        for c, name in enumerate("RGBA"):
            if name in channels:
                picture[y:y + lines, :, c] = values[:, channels.index(name)]
    return picture


def unpacked(packed, size):
    """Bytes of a block: differences, summed up, of the even bytes and then the odd ones."""
    differences = numpy.frombuffer(zlib.decompress(packed), numpy.uint8).astype(numpy.int64)
    differences[1:] -= 128
    halves = numpy.cumsum(differences).astype(numpy.uint8)
    values = numpy.empty(size, numpy.uint8)
    values[0::2], values[1::2] = halves[:(size + 1) // 2], halves[(size + 1) // 2:]
    return values


def write_exr(path, picture):
    """An array of (height, width, 3 or 4) from the top, not packed."""
    height, width, channel_count = picture.shape

    def attribute(name, kind, value):
        return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value

    box = struct.pack("<4i", 0, 0, width - 1, height - 1)
    order = "ABGR"[4 - channel_count:]  # by name
    channels = b"".join(name.encode() + b"\0" + struct.pack("<iiii", 2, 0, 1, 1) for name in order) + b"\0"
    header = struct.pack("<ii", 20000630, 2) + b"".join([
        attribute("channels", "chlist", channels), attribute("compression", "compression", b"\0"), attribute("dataWindow", "box2i", box),
        attribute("displayWindow", "box2i", box), attribute("lineOrder", "lineOrder", b"\0"),
        attribute("pixelAspectRatio", "float", struct.pack("<f", 1)), attribute("screenWindowCenter", "v2f", struct.pack("<ff", 0, 0)),
        attribute("screenWindowWidth", "float", struct.pack("<f", 1))]) + b"\0"
    size = 4 * channel_count * width
    first = len(header) + 8 * height
    with open(path, "wb") as file:
        file.write(header + struct.pack(f"<{height}Q", *(first + (8 + size) * y for y in range(height))))
        for y in range(height):
            file.write(struct.pack("<ii", y, size) + picture[y, :, ::-1].T.astype("<f4").tobytes())
