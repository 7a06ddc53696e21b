"""The errors of each scene beside its run time: writes doc/errors.md. Called by scripts/errors.sh.

    python3 scripts/errors.py build/supple [PATTERN]

With a pattern, such as "bar/*", the table of those scenes is printed and nothing is written.
"""

import pathlib
import sys
import tempfile

import scene_run

ROOT = pathlib.Path(__file__).resolve().parent.parent

# Right values of probes at the end of a static scene [m], and where they are from.
RIGHT = {
    "bar/static": ("n28.uz", -0.20637, "quadratic tetrahedra, extrapolated"),
    "validation/thick-cylinder": ("inner.ux", 1.906667e-3, "Lame (1852)"),
    "validation/thick-cylinder-incompressible": ("inner.ux", 1.999967e-3, "Lame (1852)"),
    "validation/sphere": ("inner.ux", 8.0e-4, "Lame (1852)"),
    "validation/sphere-incompressible": ("x.ux", 8.57114e-4, "Lame (1852)"),
    "validation/cook-3d": ("top.uy", 32.26e-3, "quadratic triangles, extrapolated"),
    "validation/l-bar": ("tip.uy", -0.0479334, "quadratic tetrahedra, extrapolated"),
    "validation/cook": ("top.uy", 32.26e-3, "quadratic triangles, extrapolated"),
}


def is_single_run(scene):
    text = scene.read_text()
    return not any(f"subsection {task}" in text for task in ("Study", "Identification"))


def percent(part):
    return f"{100 * part:.2g} %" if part < 0.995 else f"{100 * part:.0f} %"


def in_time(summary):
    estimate = summary["error_estimate"]
    if "step_doubling" not in estimate:
        return ""
    doubling = estimate["step_doubling"]
    if doubling.get("relative") is None:
        return "unknown"
    return ("more than " if doubling.get("at_least") else "") + percent(doubling["relative"])


def in_space(summary):
    space = summary["error_estimate"].get("space", {})
    parts = [f"{name} {percent(abs(value))}" for name, value in space.get("probes", {}).items()
             if isinstance(value, (int, float))][:2]
    if isinstance(space.get("energy"), (int, float)):
        parts.insert(0, f"stress {percent(space['energy'])}")
        if space["of"] == "swing":
            parts.append(f"swing {percent(space['frequency'])}")
        if space["of"] == "forces":
            parts.insert(1, f"forces {percent(-space['forces'])}" if "forces" in space else "forces more than 50 %")
    elif "more_than" in space:
        parts.insert(0, f"work more than {percent(space['more_than'])}")
    return ", ".join(parts) or space.get("unknown", "no number")


def row_of(supple, scene):
    name = scene.relative_to(ROOT / "parameters").with_suffix("").as_posix()
    static = "Problem = static" in " ".join(scene.read_text().split())
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder)
        summary, probes = scene_run.run(supple, scene, path / "run", {} if static else {"Time/Estimate error": "true"})
    true = ""
    if name in RIGHT:
        probe, right, source = RIGHT[name]
        true = f"{probe} {percent(abs(probes[probe] / right - 1))} ({source})"
    seconds = summary["seconds"]["run"]
    return [f"[{name}](../parameters/{name}.prm)", summary["cells"], summary["steps"], f"{seconds:.2g}", in_time(summary),
            in_space(summary), true]


def main():
    supple = str(pathlib.Path(sys.argv[1]).resolve())
    pattern = sys.argv[2] if len(sys.argv) > 2 else "*/*"
    scenes = [scene for scene in sorted((ROOT / "parameters").glob(pattern + ".prm")) if is_single_run(scene)]
    heading = ["scene", "cells", "steps", "seconds", "in time", "in space, estimated", "in space, true"]
    lines = ["| " + " | ".join(heading) + " |", "|---" * len(heading) + "|"]
    for scene in scenes:
        lines.append("| " + " | ".join(map(str, row_of(supple, scene))) + " |")
        print(lines[-1], flush=True)
    if len(sys.argv) > 2:
        return
    text = ("# The errors of each scene\n\n"
            "Each scene of parameters/ as it is, without pictures: seconds of its steps, its error in time by a second run at half "
            "the step (part of the largest motion), its error in space by recovery of the stress at the end (of the stress in the "
            "mean square, then of up to two probes by a dual solution, of the forces where displacements are given, or of a swing's frequency). [error.md](error.md) says what "
            "the numbers mean. Made by `scripts/errors.sh`.\n\n")
    (ROOT / "doc" / "errors.md").write_text(text + "\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
