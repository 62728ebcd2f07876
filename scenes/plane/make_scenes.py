#!/usr/bin/env python3
"""Writes the plane scenes beside this file: lamps, room, city, logo, bounce, sun, glass, mirror, marble, fog, screen, and a normal map of cobbles. The
same bytes on every machine."""
import math
import pathlib
import struct
import zlib

FOLDER = pathlib.Path(__file__).parent


class Random:
    """splitmix64: the same numbers in every version of Python."""

    def __init__(self, seed):
        self.state = seed

    def uniform(self, low=0.0, high=1.0):
        mask = (1 << 64) - 1
        self.state = (self.state + 0x9E3779B97F4A7C15) & mask
        x = self.state
        x = ((x ^ (x >> 30)) * 0xBF58476D1CE4E5B9) & mask
        x = ((x ^ (x >> 27)) * 0x94D049BB133111EB) & mask
        return low + (high - low) * ((x ^ (x >> 31)) >> 11) * 2.0**-53


def write(name, title, width, height, body, more=""):
    text = (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}"{more}>\n'
        f"<!-- Made by make_scenes.py. SPDX-License-Identifier: CC0-1.0 -->\n<title>{title}</title>\n{body}</svg>\n"
    )
    (FOLDER / name).write_text(text)


def polygon(points):
    return " ".join(f"{x:.2f},{y:.2f}" for x, y in points)


def turned_box(x, y, half_x, half_y, angle):
    c, s = math.cos(angle), math.sin(angle)
    return [(x + c * u - s * v, y + s * u + c * v) for u, v in
            ((-half_x, -half_y), (half_x, -half_y), (half_x, half_y), (-half_x, half_y))]


def lamps():
    rng = Random(4)
    out = '<g class="light">\n'
    out += '<circle cx="130" cy="120" r="22" fill="#ffd9a0" data-intensity="2.2"/>\n'
    out += '<rect x="500" y="70" width="60" height="16" fill="#9cc8ff" data-intensity="2.6" transform="rotate(25 530 78)"/>\n'
    out += '<ellipse cx="330" cy="330" rx="34" ry="12" fill="#ff7f9f" data-intensity="1.6"/>\n'
    out += '<line x1="70" y1="330" x2="120" y2="300" stroke="#b8ffb0" stroke-width="10" stroke-linecap="round" data-intensity="1.6"/>\n</g>\n<g class="occluder">\n'
    taken = [(130, 120, 60), (530, 78, 70), (330, 330, 70), (95, 315, 60)]
    while len(taken) < 24:
        x, y, r = rng.uniform(20, 620), rng.uniform(20, 380), rng.uniform(9, 19)
        if any(math.hypot(x - a, y - b) < r + s + 4 for a, b, s in taken):
            continue
        taken.append((x, y, r))
        kind = len(taken) % 3
        if kind == 0:
            out += f'<circle cx="{x:.2f}" cy="{y:.2f}" r="{r:.2f}"/>\n'
        else:
            n = 4 if kind == 1 else 6
            turn = rng.uniform(0, 6.28)
            points = [(x + r * math.cos(turn + 2 * math.pi * k / n), y + r * math.sin(turn + 2 * math.pi * k / n)) for k in range(n)]
            out += f'<polygon points="{polygon(points)}"/>\n'
    write("lamps.svg", "Lamps among convex bodies", 640, 400, out + "</g>\n")


def room():
    # A lamp in a niche of the left wall, one half in the upper wall, one flush with the right wall.
    body = """<path d="M10 10H630V390H10Z M30 30V150H18V230H30V370H300V300H312V370H610V30Z" fill-rule="evenodd" fill="#444"/>
<circle id="niche" class="light" cx="22" cy="190" r="4" fill="#ffb46b" data-intensity="26"/>
<circle id="embedded" class="light" cx="330" cy="30" r="12" fill="#fff1d0" data-intensity="7"/>
<rect id="flush" class="light" x="610" y="220" width="12" height="60" fill="#86b6ff" data-intensity="5"/>
<g class="occluder"><rect x="120" y="230" width="90" height="12"/><rect x="124" y="242" width="6" height="60"/><rect x="200" y="242" width="6" height="60"/>
<rect x="430" y="120" width="70" height="70" rx="16"/><path d="M420 300 l60 -24 l8 20 l-60 24 z"/>
<polyline points="250,90 290,130 270,180" fill="none" stroke="#444"/><circle cx="540" cy="320" r="18"/>
<line x1="90" y1="90" x2="160" y2="120" stroke="#444" stroke-width="8" stroke-linecap="round"/></g>
"""
    write("room.svg", "A room with lamps in its walls", 640, 400, body)


def city():
    rng = Random(11)
    boxes, blocks = [], '<g class="occluder">\n'
    for row in range(12):
        for column in range(20):
            x, y = 48 + column * 48 + rng.uniform(-7, 7), 45 + row * 46 + rng.uniform(-7, 7)
            if rng.uniform() < 0.12:
                continue
            hx, hy, a = rng.uniform(6, 14), rng.uniform(6, 14), rng.uniform(-0.25, 0.25)
            boxes.append((x, y, math.hypot(hx, hy)))
            blocks += f'<polygon points="{polygon(turned_box(x, y, hx, hy, a))}"/>\n'
    lights, colors, count = '<g class="light" data-range="170">\n', ("#ffcf87", "#ffe9c4", "#8fb8ff", "#ff9d6e"), 0
    while count < 48:
        x, y = rng.uniform(10, 1014), rng.uniform(10, 566)
        if any(math.hypot(x - a, y - b) < r + 4 for a, b, r in boxes):
            continue
        lights += f'<circle cx="{x:.2f}" cy="{y:.2f}" r="4" fill="{colors[count % 4]}" data-intensity="5"/>\n'
        count += 1
    write("city.svg", "A city by night", 1024, 576, blocks + "</g>\n" + lights + "</g>\n")


def logo():
    rays = ""
    for k in range(16):
        a = 2 * math.pi * k / 16
        x, y = 320 + 168 * math.cos(a), 200 + 168 * math.sin(a)
        rays += f'<polygon points="{polygon(turned_box(x, y, 10, 3, a))}"/>\n'
    body = f"""<defs><linearGradient id="sun" x1="0" y1="0" x2="1" y2="1"><stop offset="0" stop-color="#ffe08a"/><stop offset="0.55" stop-color="#ff6a3d"/>
<stop offset="1" stop-color="#c81d77"/></linearGradient>
<linearGradient id="sea" gradientUnits="userSpaceOnUse" x1="60" y1="0" x2="580" y2="0"><stop offset="0" stop-color="#39d0ff"/><stop offset="1" stop-color="#6a5cff"/></linearGradient></defs>
<path id="ring" class="light" fill="url(#sun)" data-intensity="1.5" fill-rule="evenodd"
 d="M320 110 A90 90 0 1 1 319.9 110 Z M320 140 C353 140 380 167 380 200 S353 260 320 260 S260 233 260 200 S287 140 320 140 Z"/>
<path id="wave" class="light" fill="url(#sea)" data-intensity="1.6" d="M60 352 C140 322 200 382 320 352 S500 322 580 352 L580 360 C500 330 440 390 320 360 S140 330 60 360 Z"/>
<path class="occluder" d="M300 180 q20 -26 40 0 q26 20 0 40 q-20 26 -40 0 q-26 -20 0 -40 z"/>
<g class="occluder">
{rays}</g>
"""
    write("logo.svg", "A ring with a gradient and holes", 640, 400, body)


def bounce():
    # One lamp behind a screen in the left room; the right one has what walls send through the door.
    body = """<path d="M0 0H640V400H0Z M20 20V380H620V20Z" fill-rule="evenodd" fill="#e8e2d6" data-albedo="0.8"/>
<rect x="20" y="20" width="8" height="360" fill="#d8452e" data-albedo="0.75 0.12 0.08"/>
<rect x="612" y="20" width="8" height="360" fill="#3a9a4a" data-albedo="0.1 0.6 0.15"/>
<rect x="270" y="20" width="14" height="230" fill="#e8e2d6" data-albedo="0.8"/>
<polyline points="120,150 150,190 200,190 230,150" fill="none" stroke="#e8e2d6" data-albedo="0.8"/>
<g data-albedo="0.7"><rect x="70" y="290" width="50" height="50" transform="rotate(20 95 315)" fill="#d8d0c0"/>
<circle cx="420" cy="130" r="34" fill="#d8d0c0"/><rect x="500" y="250" width="70" height="26" rx="13" fill="#d8d0c0"/>
<rect x="352" y="290" width="44" height="44" transform="rotate(-25 374 312)" fill="#3d6bd8" data-albedo="0.12 0.25 0.8"/></g>
<circle class="light" cx="175" cy="150" r="9" fill="#fff3dc" data-intensity="9"/>
"""
    write("bounce.svg", "Two rooms, one lamp, and what their walls send on", 640, 400, body)


def sun():
    # A low sun, soft by one degree, and a sky; trees, a house with a yard.
    rng = Random(21)
    body = """<g data-steradian="sun"><circle r="1" fill="#ffd9a0" data-intensity="26" data-sun-direction="-28 1"/>
<circle r="1" fill="#9cc4ff" data-intensity="0.55" data-sun-direction="-90 90"/></g>
<path d="M380 120H560V290H380V260H530V150H410V200H380Z" fill="#a06a4a"/>
<rect x="440" y="190" width="40" height="30" fill="#8a5a40"/>
<g fill="#3f6b3a">
"""
    for _ in range(13):
        x, y = rng.uniform(20, 330), rng.uniform(20, 380)
        body += f'<circle cx="{x:.2f}" cy="{y:.2f}" r="{rng.uniform(5, 15):.2f}"/>\n'
    body += "</g>\n"
    for k in range(9):
        body += f'<rect x="{372 + 24 * k}" y="340" width="4" height="4" fill="#705040"/>\n'
    write("sun.svg", "A low sun and the sky", 640, 400, body)


def glass():
    body = """<circle class="light" cx="320" cy="200" r="9" fill="#fff4e0" data-intensity="14"/>
<g transform="translate(320 200)">
"""
    tints = (("1 0.12 0.08", "#ff6a60"), ("1 0.7 0.05", "#ffd860"), ("0.1 0.85 0.2", "#60f080"), ("0.05 0.6 1", "#60d0ff"), ("0.35 0.12 1", "#a070ff"))
    for k in range(10):
        tint, fill = tints[k % 5]
        body += f'<rect x="62" y="-13" width="6" height="26" fill="{fill}" data-transmittance="{tint}" transform="rotate({36 * k})"/>\n'
    body += """</g>
<rect x="470" y="60" width="70" height="70" rx="20" fill="#8090ff" data-transmittance="0.3 0.4 1"/>
<rect x="500" y="90" width="80" height="80" fill="#ff9080" data-transmittance="1 0.45 0.3" transform="rotate(20 540 130)"/>
<circle cx="110" cy="110" r="34" fill="#90ffb0" data-transmittance="0.4 1 0.5"/><circle cx="120" cy="290" r="14" fill="#333"/>
<circle cx="215" cy="345" r="10" fill="#333"/><polygon points="520,290 560,300 530,335" fill="#333"/><rect x="300" y="40" width="50" height="8" fill="#333"/>
"""
    write("glass.svg", "A lamp among panes of coloured glass", 640, 400, body)


def mirror():
    body = """<circle class="light" cx="150" cy="120" r="10" fill="#ffe2b0" data-intensity="9"/>
<circle class="light" cx="520" cy="330" r="7" fill="#8fb8ff" data-intensity="9"/>
<g data-mirror="0.95 0.95 0.95" fill="#cfd8e0"><rect x="60" y="376" width="360" height="8"/><rect x="-60" y="-4" width="120" height="8" transform="translate(420 90) rotate(35)"/>
<rect x="-45" y="-4" width="90" height="8" transform="translate(590 190) rotate(100)"/></g>
<line x1="250" y1="230" x2="310" y2="190" stroke="#cfd8e0" data-mirror="1 0.75 0.35"/>
<g fill="#444"><rect x="120" y="220" width="24" height="24"/><circle cx="220" cy="300" r="13"/><rect x="330" y="290" width="60" height="10" transform="rotate(-20 360 295)"/>
<circle cx="480" cy="200" r="16"/></g>
"""
    write("mirror.svg", "Two lamps and four mirrors", 640, 400, body)


def marble():
    body = """<circle class="light" cx="330" cy="190" r="9" fill="#fff0d8" data-intensity="10"/><circle class="light" cx="560" cy="60" r="8" fill="#7fb0ff" data-intensity="9"/>
<g data-light-depth="22"><circle cx="180" cy="130" r="62" fill="#ffd8c8"/>
<path d="M380 260L540 230L600 330L470 372Z" fill="#bfe8d0"/>
<path d="M60 250H240V370H60Z M110 300V340H190V300Z" fill-rule="evenodd" fill="#f4f0ff"/></g>
<g fill="#333"><rect x="255" y="200" width="16" height="16"/><circle cx="420" cy="120" r="14"/></g>
<circle class="light" cx="150" cy="320" r="5" fill="#ff7a50" data-intensity="12"/>
"""
    write("marble.svg", "Stones that light enters", 640, 400, body)


def fog():
    rng = Random(33)
    body = '<g class="light" data-intensity="30">\n'
    for k in range(7):
        body += f'<circle cx="{60 + 87 * k}" cy="{200 + 18 * (-1) ** k}" r="5" fill="{("#ffdf9f", "#ffb070", "#9fc8ff")[k % 3]}"/>\n'
    body += '</g>\n<g fill="#222">\n'
    for _ in range(26):
        x, y = rng.uniform(10, 630), rng.uniform(10, 390)
        if abs(y - 200) > 45:
            body += f'<polygon points="{polygon(turned_box(x, y, rng.uniform(4, 13), rng.uniform(4, 13), rng.uniform(0, 3)))}"/>\n'
    write("fog.svg", "Street lamps in fog", 640, 400, body + "</g>\n", ' data-fog-density="0.022"')


def screen():
    # A sign of forty pixels, and a strip around a corner.
    colors = []
    for k in range(40):
        on = (k * 7) % 10 < 6
        colors.append(f"hsl({9 * k},100%,{55 if on else 6}%)")
    body = f"""<line class="light" x1="120" y1="60" x2="520" y2="60" stroke="#fff" data-intensity="1.6" data-texture="{';'.join(colors)}"/>
<polyline class="light" points="40,140 40,360 240,360" fill="none" stroke="#fff" data-intensity="1.3" data-texture="#102040; #40a0ff; #ff40c0; #ffe080; #201000"/>
<g fill="#444"><circle cx="200" cy="150" r="14"/><circle cx="320" cy="150" r="14"/><circle cx="440" cy="150" r="14"/><rect x="380" y="250" width="60" height="60" transform="rotate(30 410 280)"/>
<rect x="120" y="250" width="12" height="60"/><rect x="540" y="200" width="14" height="120"/></g>
"""
    write("screen.svg", "A sign and a strip with colours along them", 640, 400, body)


def curves():
    # Lights of curves without a range, among bodies of curves: what a drawing program makes.
    body = """<circle class="light" cx="90" cy="70" r="18" fill="#ffd9a0" data-intensity="2"/>
<path class="light" fill="#ff4060" data-intensity="2" d="M320 150 C300 110 240 120 250 165 C256 195 300 215 320 235 C340 215 384 195 390 165 C400 120 340 110 320 150 Z"/>
<path class="light" fill="none" stroke="#60c0ff" stroke-width="5" stroke-linecap="round" data-intensity="2" d="M60 300 C120 250 160 340 220 300 S300 250 340 300"/>
<path class="light" fill="none" stroke="#80ffb0" stroke-width="4" data-intensity="2" d="M450 80 q40 -50 80 0 t80 0"/>
<ellipse class="light" cx="540" cy="280" rx="30" ry="12" fill="#ffe080" data-intensity="2"/>
<g class="occluder" fill="#333">
<path d="M180 100 q20 -26 40 0 q26 20 0 40 q-20 26 -40 0 q-26 -20 0 -40 z"/>
<path d="M440 170 C460 150 500 160 490 190 S450 230 440 210 Z"/>
<circle cx="150" cy="200" r="14"/><circle cx="420" cy="300" r="18"/>
<rect x="560" y="150" width="40" height="40" rx="10"/><rect x="30" y="150" width="40" height="20"/>
<path d="M380 60 l30 -10 l10 30 l-24 14 z"/>
<path fill="none" stroke="#333" stroke-width="6" stroke-linecap="round" d="M100 20 Q140 60 200 40"/>
</g>
"""
    write("curves.svg", "A heart, two strokes and two disks", 640, 360, body)


def cobbles():
    # A normal map, green upwards, and clear between the stones: domes in rows that are shifted against each other.
    width, height, step = 320, 200, 32
    rows = b""
    for y in range(height):
        rows += b"\0"
        for x in range(width):
            row = y // step
            u = ((x + (step // 2) * (row % 2)) % step + 0.5) / step * 2 - 1
            v = (y % step + 0.5) / step * 2 - 1
            r2 = u * u * u * u + v * v * v * v  # between a disk and a square
            nx, ny = 0.8 * u * abs(u), 0.8 * v * abs(v)
            nz = math.sqrt(max(1 - nx * nx - ny * ny, 0.05))
            rows += bytes(round(127.5 * (c + 1)) for c in (nx, -ny, nz)) + (b"\xff" if r2 < 0.75 else b"\0")

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)
    png = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")
    (FOLDER / "cobbles_normal.png").write_bytes(png)


for scene in (lamps, room, city, logo, bounce, sun, glass, mirror, marble, fog, screen, curves, cobbles):
    scene()
