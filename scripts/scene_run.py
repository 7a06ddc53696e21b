"""A run of a scene and its numbers: for errors.py, refinement.py and thesis_*.py, not called."""

import csv
import json
import subprocess

MODELS = {"linear": "none", "corotational": "polar"}    # Corotation/Rotation of each


def run(supple, scene, folder, settings):
    """@return (summary, {column: number in the last row of probes.csv}), of a run without frames and report. @raise RuntimeError
    with the message of a scene that is refused"""
    everything = {"Output/Frames": "none", "Output/Report": "false", **settings}
    words = [word for entry, value in everything.items() for word in ("--set", f"{entry}={value}")]
    done = subprocess.run([str(supple), str(scene), "--quiet", "--output", str(folder), *words], capture_output=True, text=True, check=False)
    if done.returncode == 1:
        raise RuntimeError(done.stderr.strip())
    summary = json.loads((folder / "summary.json").read_text())
    probes = {}
    if (folder / "probes.csv").exists():
        probes = last_row(folder / "probes.csv")
    return summary, probes


def rows(table):
    """{column: number} of each row of a CSV file."""
    with open(table) as file:
        return [{name: float(text) for name, text in row.items()} for row in csv.DictReader(file)]


def last_row(table):
    return rows(table)[-1]
