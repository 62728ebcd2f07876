"""What other programs' light numbers mean here: docs/lights.md."""
from . import _core

__all__ = ["ev100_of_camera", "intensity_from_power", "is_photometric", "light_factor", "lumens_from_watts", "power_from_intensity",
           "power_from_radiance", "radiance_from_power", "stops_from_ev100", "watts_from_lumens"]


def light_factor(system: str, kind: str, area: float = 1.0) -> float:
    """Our number for a number of 1 in another program, which is linear in it.

    system  "gltf", "blender", "usd", "three", "mitsuba" or "pbrt"
    kind    "area" and "sphere": gives radiance; "point" and "spot": intensity; "directional": irradiance
    area    of the light's surface [m2], 4 pi r^2 of a sphere: only Blender's numbers depend on it
    """
    return _core.light_factor(system, kind, area)


def is_photometric(system: str) -> bool:
    """Whether a program counts in lumens (nits, candela, lux), not in watts."""
    return _core.is_photometric(system)


def radiance_from_power(power: float, area: float) -> float:
    """Radiance of a light of this area [m2] that sends this power [W or lumens] evenly from one side of its surface."""
    return _core.radiance_from_power(power, area)


def power_from_radiance(radiance: float, area: float) -> float:
    """The inverse."""
    return _core.power_from_radiance(radiance, area)


def intensity_from_power(power: float) -> float:
    """Intensity [W/sr or candela] of a point that sends this power evenly to all sides."""
    return _core.intensity_from_power(power)


def power_from_intensity(intensity: float) -> float:
    """The inverse."""
    return _core.power_from_intensity(intensity)


def lumens_from_watts(watts: float, efficacy: float = 683.0) -> float:
    """Lumens of radiant watts, by an efficacy in lm/W: 683 is the lumen's definition, white light has 200 to 350."""
    return _core.lumens_from_watts(watts, efficacy)


def watts_from_lumens(lumens: float, efficacy: float = 683.0) -> float:
    """The inverse."""
    return _core.watts_from_lumens(lumens, efficacy)


def ev100_of_camera(f_number: float, seconds: float, iso: float) -> float:
    """A camera's exposure value at ISO 100."""
    return _core.ev100_of_camera(f_number, seconds, iso)


def stops_from_ev100(ev100: float) -> float:
    """The stops (write_picture's exposure) that show the luminance at which such a camera saturates, 1.2 times 2^EV nits, as 1."""
    return _core.stops_from_ev100(ev100)
