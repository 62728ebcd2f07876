"""What the add-on hears of the program and tells of it, without Blender.

    test_progress.py PROGRAM SCENE
"""
import importlib.util
import sys
import tempfile
import time
import types
from pathlib import Path

sys.modules["bpy"] = types.ModuleType("bpy")  # program.py asks it for preferences only
spec = importlib.util.spec_from_file_location("program", Path(__file__).resolve().parent / "steradian" / "program.py")
program = importlib.util.module_from_spec(spec)
spec.loader.exec_module(program)


def ended(command):
    """The run, and the shares that it told on its way."""
    run, shares = program.Run(command), []
    while run.is_running():
        time.sleep(0.02)
        if run.share_done() not in (None, *shares[-1:]):
            shares.append(run.share_done())
    run.close()
    return run, shares


def test_render(steradian, scene):
    """A render of some seconds tells its share about once a second, and nothing of that is left among its lines."""
    with tempfile.TemporaryDirectory() as folder:
        run, shares = ended([steradian, "render", scene, "-o", folder + "/x.png", "--size", "640x360", "--aa", "4", "--threads", "1"])
    assert run.process.returncode == 0, run.lines()
    assert shares and shares == sorted(shares) and 0 < shares[0] and shares[-1] <= 1, shares
    assert not any("left" in line for line in run.lines()), run.lines()
    print(f"{len(shares)} shares, {shares[0]} to {shares[-1]}; said {run.lines()}")


def test_other_lines():
    """Lines that are no progress are kept, also of a program that is stopped."""
    run, shares = ended(["sh", "-c", "echo 'warning: x'; echo 'render    5.0 %  1 s, 19 s left' >&2; sleep 0.2; echo; echo 7.0 %; exit 3"])
    assert (run.process.returncode, run.lines(), shares) == (3, ["warning: x", "7.0 %"], [0.05]), (run.lines(), shares)
    run = program.Run(["sh", "-c", "exec sleep 60"])
    run.stop()
    assert run.process.returncode != 0


def test_telling():
    """At most one line a second, whose first comes at once."""
    telling = program.Telling(100.0)
    lines = [telling.line(100 + step / 20, None if step < 30 else step / 100) for step in range(61)]
    told = [line for line in lines if line is not None]
    assert told == ["rendering, 0 s", "rendering, 1 s", "rendering, 2 s, 40 %", "rendering, 3 s, 60 %"], told


def test_settings(steradian, scene):
    """The program takes every terminator and environment of the panel, with and without shadows; the terminator needs them."""
    film = types.SimpleNamespace(film_transparent=False)
    program.bpy.context = types.SimpleNamespace(scene=types.SimpleNamespace(render=film))
    program.path = lambda: steradian
    scene = str(Path(scene).with_name("cornell.glb"))  # small: only the options matter
    commands = []
    with tempfile.TemporaryDirectory() as folder:
        for shadows in ("on", "off"):
            for terminator in ("smooth", "strict"):
                for environment in ("world", "sky", "white", "none"):
                    settings = types.SimpleNamespace(method="auto", quality="draft", shadows=shadows, terminator=terminator, environment=environment,
                                                     indirect="all")
                    command = program.render_command(scene, folder + "/x.exr", 16, 9, settings, 1, None)
                    assert command[command.index("--quality") + 1] == "draft", command
                    assert ("--terminator" in command) == (shadows == "on"), command
                    assert command[command.index("--bounces") + 1] == "all" and "--indirect" not in command, command
                    assert ("--environment" in command) == (environment in ("sky", "white")), command
                    run, _ = ended(command)
                    assert run.process.returncode == 0, (command, run.lines())
                    commands.append(command)
        for indirect in ("off", "ltc", "path"):
            settings.indirect = indirect
            command = program.render_command(scene, folder + "/x.exr", 16, 9, settings, 1, None)
            assert command[command.index("--indirect") + 1] == indirect and "--bounces" not in command, command
        settings.indirect = "all"
        assert "--bounces" not in program.render_command(scene, folder + "/x.exr", 16, 9, settings, 1, None, direct_only=True)
        settings.environment = "world"
        assert "map.exr" in program.render_command(scene, folder + "/x.exr", 16, 9, settings, 1, "map.exr")
    print(f"{len(commands)} commands")


def test_bake(steradian, scene):
    """The program takes what the button asks for, tells its share, and writes the file."""
    program.path = lambda: steradian
    settings = types.SimpleNamespace(quality="normal", shadows="on", environment="none")
    with tempfile.TemporaryDirectory() as folder:
        for target in ("texture", "vertex"):
            baked = folder + f"/{target}.glb"
            run, shares = ended(program.bake_command(scene, baked, settings, 16, "1", target, None))
            assert run.process.returncode == 0, run.lines()
            assert Path(baked).exists() and Path(folder, target + ".exr").exists() == (target == "texture")
            assert shares == sorted(shares) and all(0 < share <= 1 for share in shares), shares
            assert not any("left" in line for line in run.lines()), run.lines()
    assert "map.exr" in program.bake_command(scene, "x.glb", types.SimpleNamespace(quality="normal", shadows="on", environment="world"), 16, "all", "texture", "map.exr")
    assert program.Telling(0, "baking").line(0, 0.5) == "baking, 0 s, 50 %"


test_render(*sys.argv[1:])
test_bake(*sys.argv[1:])
test_settings(*sys.argv[1:])
test_other_lines()
test_telling()
