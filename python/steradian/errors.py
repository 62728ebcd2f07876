"""What the library throws, with the place in the user's input, the problem, and a hint."""


class Error(Exception):
    """Bad input or a missing device.

    place    file, place in the file, key or argument ("light.vertices[2]"); may be empty
    problem  what is wrong there
    hint     what to do about it; may be empty
    """

    def __init__(self, place: str, problem: str, hint: str = ""):
        super().__init__((f"{place}: " if place else "") + problem + (f" ({hint})" if hint else ""))
        self.place = place
        self.problem = problem
        self.hint = hint

    def __reduce__(self):
        return type(self), (self.place, self.problem, self.hint)


class UsageError(Error):
    """What was asked for cannot be: an option or a method that does not fit."""
