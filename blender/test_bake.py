"""The button that bakes, over a stand-in for Blender and for the program. Blender itself is not needed.

    test_bake.py
"""
import importlib
import sys
import types
from pathlib import Path


def stub(name, **members):
    module = types.ModuleType(name)
    module.__dict__.update(members)
    sys.modules[name] = module
    return module


prop = lambda **keys: keys.get("default")
bpy = stub("bpy", props=types.SimpleNamespace(StringProperty=prop, FloatProperty=prop, EnumProperty=prop),
           types=types.SimpleNamespace(Operator=object), path=types.SimpleNamespace(abspath=lambda p: p.replace("//", "/folder/")),
           app=types.SimpleNamespace(background=False))
package = stub("steradian_render")
package.__path__ = [str(Path(__file__).resolve().parent / "steradian")]
exported = []
stub("steradian_render.export", export=exported.append)
package.world = stub("steradian_render.world", write=lambda *_: False)
program = importlib.import_module("steradian_render.program")
bake = importlib.import_module("steradian_render.bake")


class Manager:
    """Blender's window manager."""

    def __init__(self):
        self.shares, self.timers, self.ended = [], 0, 0

    def progress_begin(self, low, high):
        assert (low, high) == (0, 1)

    def progress_update(self, share):
        self.shares.append(share)

    def progress_end(self):
        self.ended += 1

    def event_timer_add(self, seconds, window):
        self.timers += 1
        return self

    def event_timer_remove(self, timer):
        self.timers -= 1

    def modal_handler_add(self, operator):
        pass


def started(command):
    """An operator whose program is `command`, and its context."""
    commands, said, status = [], [], []
    program.path = lambda: "steradian"
    original = program.bake_command
    bake.program.bake_command = lambda *arguments: commands.append(original(*arguments)) or command
    operator = bake.BakeOperator()
    operator.filepath, operator.texels, operator.bounces, operator.target = "//baked.glb", 16, "all", "texture"  # as Blender sets them
    operator.report = lambda kind, text: said.append((*kind, text))
    context = types.SimpleNamespace(window_manager=Manager(), window=None, workspace=types.SimpleNamespace(status_text_set=status.append),
                                    scene=types.SimpleNamespace(world=None, steradian=types.SimpleNamespace(environment="world", quality="normal", shadows="on")))
    result = operator.execute(context)
    bake.program.bake_command = original
    return operator, context, result, commands, said, status


def until_done(operator, context):
    """The answers of modal, until one is an end."""
    while True:
        operator.run.reader.join(0.05)
        answer = operator.modal(context, types.SimpleNamespace(type="TIMER"))
        if answer != {"RUNNING_MODAL"}:
            return answer


# A run to its end.
operator, context, result, commands, said, status = started(["sh", "-c", "echo 'bake    40.0 %  1 s, 2 s left'; echo 'warning: w'; sleep 0.3"])
assert result == {"RUNNING_MODAL"} and context.window_manager.timers == 1
assert commands[0][:2] == ["steradian", "bake"] and "/folder/baked.glb" in commands[0] and len(exported) == 1, commands
assert operator.modal(context, types.SimpleNamespace(type="MOUSEMOVE")) == {"PASS_THROUGH"}
assert until_done(operator, context) == {"FINISHED"}
assert said[0] == ("WARNING", "w") and said[-1][0] == "INFO", said
assert context.window_manager.shares[-1] == 0.4 and status[0].startswith("baking") and status[-1] is None, (context.window_manager.shares, status)
assert context.window_manager.timers == 0 and context.window_manager.ended == 1

# A program that fails, one that is stopped, and none.
operator, context, result, _, said, _ = started(["sh", "-c", "echo 'no light'; exit 1"])
assert until_done(operator, context) == {"CANCELLED"} and said == [("ERROR", "no light")], said
operator, context, result, _, said, _ = started(["sleep", "60"])
assert operator.modal(context, types.SimpleNamespace(type="ESC")) == {"CANCELLED"} and not operator.run.is_running()
program.path = lambda: ""
operator = bake.BakeOperator()
operator.report = lambda kind, text: said.append((*kind, text))
assert operator.execute(context) == {"CANCELLED"} and "preferences" in said[-1][1]
print("the button runs, tells, stops and fails as it says")
