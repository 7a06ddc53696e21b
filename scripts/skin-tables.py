"""Tables 3.3 to 3.8 of the 2005 thesis beside what supple computes: writes doc/skin-tables.md.

    python3 scripts/skin-tables.py build/supple
"""

import csv
import pathlib
import sys
import tempfile

import scene_run

ROOT = pathlib.Path(__file__).resolve().parent.parent
SCENES = {"3.3": ("tables-3.3.prm", 6), "3.4": ("tables-3.4.prm", 6), "3.5": ("tables-3.4.prm", 6),
          "3.6": ("tables-3.6.prm", 12), "3.7": ("tables-3.7.prm", 12), "3.8": ("tables-3.7.prm", 12)}


def compute(supple, scene):
    """Rows of identification.csv."""
    with tempfile.TemporaryDirectory() as folder:
        return scene_run.identify(supple, ROOT / "parameters" / "skin" / scene, pathlib.Path(folder))


def read_printed():
    """{(table, set): {(rows of squares in the upper layer, ratio): error as printed}}"""
    printed = {}
    with open(ROOT / "tests" / "data" / "skin_tables.csv") as file:
        for row in csv.DictReader(file):
            printed.setdefault((row["table"], int(row["set"])), {})[int(row["rows"]), float(row["ratio"])] = row["error"]
    return printed


def markdown(printed, computed):
    """A table with the printed number above the computed one in each field."""
    ratios = sorted({ratio for _, ratio in printed})
    lines = ["| layers | " + " | ".join(f"{ratio:g}" for ratio in ratios) + " |", "|---" * (len(ratios) + 1) + "|"]
    for layers in sorted({layers for layers, _ in printed}):
        fields = []
        for ratio in ratios:
            text = printed[layers, ratio]
            fields.append(f"{text}<br>{computed[layers, ratio]:.{len(text.partition('.')[2])}f}")
        lines.append(f"| {layers} | " + " | ".join(fields) + " |")
    return "\n".join(lines)


def main():
    supple = str(pathlib.Path(sys.argv[1]).resolve())
    results = {scene: compute(supple, scene) for scene, _ in set(SCENES.values())}
    tables, summary = [], []
    for (table, number), printed in sorted(read_printed().items()):
        scene, n_rows = SCENES[table]
        computed = {(round(row["thickness"] * n_rows / 4.5), row["ratio"]): row[f"error_{number}"] for row in results[scene]}
        deviations = {pair: abs(computed[pair] - float(text)) for pair, text in printed.items()}
        units = max(deviations[pair] * 10 ** len(text.partition(".")[2]) for pair, text in printed.items())
        summary.append(f"| {table} | {number} | {len(printed)} | {max(deviations.values()):.2e} | {units:.3f} |")
        tables.append(f"## Table {table}, set {number}\n\n{markdown(printed, computed)}\n")
    text = ("# The tables of the 2005 thesis, printed and computed\n\n"
            "Errors sqrt(sum e^2)/n [mm] by number of layers of squares that are hard (down) and elasticity ratio (across): "
            "printed above computed, with as many digits. [skin.md](skin.md) says how they come about and what they are worth. "
            "`python3 scripts/skin-tables.py build/supple` makes this page.\n\n"
            "| table | set | pairs | largest deviation [mm] | in units of the last printed digit |\n|---|---|---|---|---|\n"
            + "\n".join(summary) + "\n\n" + "\n".join(tables))
    (ROOT / "doc" / "skin-tables.md").write_text(text)


main()
