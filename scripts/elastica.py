"""The elastica: exact tip of a cantilever under a dead force at its end, and a picture of a run beside exact centre lines.

    /usr/bin/python3 scripts/elastica.py [OUTPUT_FOLDER PICTURE.png]

Reissner's beam (1972) of length 1, EI = 1 and height h, with E = 2 G and shear factor 5/6, is shot from the clamp so that
its end bears no moment; h = 0 is the inextensible elastica of Bisshopp and Drucker (1945). The folder is of a run of
parameters/validation/elastica.prm with the profiles upper and lower (scripts/validation.sh elastica).
"""

import csv
import math
import pathlib
import sys

LOADS = {0.1: 1, 0.2: 2, 0.5: 5, 1.0: 10}  # P L^2 / (E I) at the load factors of the scene
POINTS = 400


def shoot(load, height, curvature):
    """Turning, curvature, x and depth along the beam, by the Runge-Kutta method, from the curvature at the clamp."""
    stretch, shear = height**2 / 12, height**2 / 5  # 1/EA, 1/(5/6 GA)

    def slope(state):
        angle, bend = state[:2]
        along, across = load * math.sin(angle), load * math.cos(angle)
        e, g = 1 + stretch * along, shear * across
        return (bend, along * g - across * e, e * math.cos(angle) - g * math.sin(angle),
                e * math.sin(angle) + g * math.cos(angle))

    def moved(state, by, rate):
        return tuple(value + by * part for value, part in zip(state, rate))

    states, step = [(0.0, curvature, 0.0, 0.0)], 1 / POINTS
    for _ in range(POINTS):
        here = states[-1]
        a = slope(here)
        b = slope(moved(here, step / 2, a))
        c = slope(moved(here, step / 2, b))
        d = slope(moved(here, step, c))
        states.append(tuple(value + step / 6 * (p + 2 * q + 2 * r + s) for value, p, q, r, s in zip(here, a, b, c, d)))
    return states


def beam(load, height):
    """The states along the beam whose end is free of moment."""
    low, high = 0.0, min(load, 2 * math.sqrt(load) + 0.01)
    for _ in range(50):
        middle = (low + high) / 2
        low, high = (low, middle) if shoot(load, height, middle)[-1][1] > 0 else (middle, high)
    return shoot(load, height, low)


def edge(folder, name, factor):
    """Places of the vertices of a profile at a load factor, in the order of the rest position."""
    with open(pathlib.Path(folder) / f"profile_{name}.csv") as file:
        rows = [row for row in csv.DictReader(file) if abs(float(row["time"]) - factor) < 1e-9]
    places = sorted((float(row["x"]) - float(row["ux"]), float(row["x"]), float(row["y"])) for row in rows)
    return [place[1:] for place in places]


def draw(folder, picture):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot

    height = 0.05
    figure, axes = pyplot.subplots(figsize=(7.5, 6))
    for factor, colour in zip([0.0, *LOADS], ["#b0b0b0", "#9ecae1", "#6baed6", "#3182bd", "#08519c"]):
        outline = edge(folder, "upper", factor) + edge(folder, "lower", factor)[::-1]
        load = LOADS.get(factor, 0)
        axes.fill(*zip(*outline), color=colour, alpha=0.75, linewidth=0.5, label=f"PL²/EI = {load}")
    for factor, load in LOADS.items():
        exact = beam(load, 0)
        axes.plot([state[2] for state in exact], [height / 2 - state[3] for state in exact], "k--", linewidth=1,
                  label="exact centre line" if factor == 1 else None)
    axes.set_aspect("equal")
    axes.set_xlabel("x in m")
    axes.set_ylabel("y in m")
    axes.grid(alpha=0.3)
    axes.legend(loc="lower left")
    figure.tight_layout()
    figure.savefig(picture, dpi=110)


if __name__ == "__main__":
    print("PL^2/EI  h/L    w/L      u/L")
    for h in (0, 0.05, 0.025):
        for p in LOADS.values():
            end = beam(p, h)[-1]
            print(f"{p:7d}  {h:5g}  {end[3]:.5f}  {1 - end[2]:.5f}")
    if len(sys.argv) == 3:
        draw(*sys.argv[1:])
