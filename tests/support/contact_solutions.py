"""Exact solutions of parameters/contact, and what is measured against them."""

import math

RADIUS = 0.1                                                                       # of the contact of hertz.prm and mindlin.prm [m]
HERTZ_PRESSURE = 2 * 1e5 / (1 - 0.3**2) * RADIUS / (4 * math.pi)                   # 2 E* a/(pi R) of hertz.prm, in the middle [Pa]
NU, MU = 0.45, 0.3                                                                 # of mindlin.prm
MINDLIN_LIMIT = MU * 4 / 3 * 1e5 / (1 - NU**2) * 2 * 0.0025**1.5                    # mu P [N]
MINDLIN_SHIFT = 3 * MINDLIN_LIMIT * (2 - NU) / (16 * RADIUS) * 2 * (1 + NU) / 1e5  # of the sphere when all slides [m]


def mindlin_load(factor):
    """Q/(mu P) of mindlin.prm at a load factor."""
    return 0.9 * max(0, 1.2 * factor - 0.2)


def stick_radius(frame, pressed, factor):
    """The radius over a that parts best what has slipped since it was pressed, by more than half a per cent of MINDLIN_SHIFT, from what has
    not: the middle between two radii of nodes."""
    shift = MINDLIN_SHIFT * (1 - (1 - mindlin_load(factor)) ** (2 / 3))
    slips = []
    for place, u, before in zip(frame.points, frame.of_points["displacement"], pressed.of_points["displacement"]):
        r = math.hypot(place[0] - u[0], place[1] - u[1]) / RADIUS
        if r < 0.999 and abs(place[2] - u[2]) < 1e-9:
            slips.append((r, math.hypot(u[0] - before[0] - shift, u[1] - before[1]) > 0.005 * MINDLIN_SHIFT))
    radii = [0, *sorted(r for r, _ in slips), 1]
    middles = [(one + other) / 2 for one, other in zip(radii, radii[1:]) if other > one]
    return min(middles, key=lambda c: sum(slipped != (r > c) for r, slipped in slips))


def variation(forces, n_period):
    """Of a force: largest less least over its mean, as it is and without its mean over n_period values around."""
    mean = sum(forces) / len(forces)
    half = n_period // 2
    rest = [forces[k] - (sum(forces[k - half:k + half + 1]) - 0.5 * (forces[k - half] + forces[k + half])) / (2 * half)
            for k in range(half, len(forces) - half)]
    return [abs((max(values) - min(values)) / mean) for values in (forces, rest)]


def errors_of_pressure(frame):
    """Of hertz.prm, in the middle and the largest within 0.8 a, both over HERTZ_PRESSURE."""
    middle, worst = None, 0
    for place, u, pressure in zip(frame.points, frame.of_points["displacement"], frame.of_points["contact_pressure"]):
        r = math.hypot(place[0] - u[0], place[1] - u[1]) / RADIUS
        if abs(place[2] - u[2]) > 1e-9 or r > 0.8:
            continue
        error = pressure / HERTZ_PRESSURE - math.sqrt(1 - r**2)
        worst = max(worst, abs(error))
        if r < 1e-6:
            middle = error
    return middle, worst
