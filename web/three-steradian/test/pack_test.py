#!/usr/bin/env python3
"""pack_test.py SCRATCH: the package as `npm pack` makes it, installed into an empty project with three, lights pictures in headless Chromium.

The first example of the README draws, and a picture agrees with the library's within the bounds of three_test.py. Exit 77 (skipped) as there.
"""
import functools
import http.server
import json
import sys
import threading
from pathlib import Path

import three_test as common
from three_test import BOUNDS, PACKAGE, browser, np

sys.path.insert(0, str(PACKAGE.parent))
import npm_project  # noqa: E402

USE = """
import * as THREE from 'three';
import { AreaLightSet, DiskAreaLight } from 'three-steradian';
import * as tables from 'three-steradian/tables';
const disk = new DiskAreaLight( 0xffffff, 8, 0.5 );
disk.position.set( 0, 3, 4 );
disk.lookAt( 0, 0, 0 );
const down = new THREE.Vector3( 0, 0, - 1 ).applyQuaternion( disk.quaternion );
console.log( JSON.stringify( { set: typeof new AreaLightSet( [ disk ] ), down: down.toArray(), tables: Object.keys( tables ) } ) );
"""


class Installed(common.Files):
    """The pages of three_test.py, with the package and three as the project has them."""

    def __init__(self, *arguments, project, **keys):
        self.project = project
        super().__init__(*arguments, three=project / "node_modules" / "three", **keys)

    def translate_path(self, path):
        self.roots["package"] = self.project / "node_modules" / "three-steradian"
        return super().translate_path(path)


def main():
    chromium = browser.find()
    if chromium is None:
        common.skip("there is no Chromium here (apt-get install chromium)")
    scratch = Path(sys.argv[1])
    common.three_from_npm(scratch)  # fetches three into npm's cache, or skips
    tarball, files = npm_project.pack(PACKAGE, scratch / "packed")
    project = scratch / "project"
    npm_project.install(project, tarball, common.THREE)
    npm_project.check_exports(project / "node_modules" / "three-steradian", files)
    print(f"{tarball.name}: {len(files)} files, {tarball.stat().st_size / 1000:.0f} KB")

    used = json.loads(npm_project.module(project, USE))
    assert used["set"] == "object" and used["tables"] and max(abs(a - b) for a, b in zip(used["down"], (0, -0.6, -0.8))) < 1e-6, used

    pieces = common.snippets()
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Installed, project=project, snippets=pieces))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    port = server.server_address[1]
    assert common.page_words(chromium, f"http://127.0.0.1:{port}/snippet/0.html") == "snippet"
    name, lights, material, roughness = common.CASES[0]
    case, want = common.case_of(name, lights, material, roughness, ["compact"], [0, 1.6, 2.6])
    (got,) = common.browser_pixels(chromium, port, case)
    off = np.quantile(np.abs(got - want).max(axis=-1) / np.quantile(want, 0.999), 0.995)
    mean = got.mean() / want.mean()
    print(f"from the tarball: {name}, compact: mean ratio {mean:.4f}, 99.5 % of the pixels within {off:.4f} of white")
    sys.exit(not (abs(mean - 1) < BOUNDS["compact"][0] and off < BOUNDS["compact"][1]))


if __name__ == "__main__":
    main()
