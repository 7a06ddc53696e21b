"""Runs of scenes and their numbers: for errors.py, refinement.py, skin-tables.py and thesis_*.py, not called."""

import csv
import json
import subprocess

MODELS = {"linear": "none", "corotational": "polar"}    # Corotation/Rotation of each


def run(supple, scene, folder, settings):
    """@return (summary, {column: number in the last row of probes.csv}), of a run without frames and report. Ends with the message of
    a scene that is refused."""
    everything = {"Output/Frames": "none", "Output/Report": "false", **settings}
    words = [word for entry, value in everything.items() for word in ("--set", f"{entry}={value}")]
    record = folder / "summary.json"
    record.unlink(missing_ok=True)    # of an earlier run
    done = subprocess.run([str(supple), str(scene), "--quiet", "--output", str(folder), *words], capture_output=True, text=True, check=False)
    if done.returncode == 1 or not record.exists():
        raise SystemExit(done.stderr.strip() or f"{supple} left no {record}.")
    summary = json.loads(record.read_text())
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


def identify(supple, scene, folder):
    """{column: number} of each pair of parameters that an identification tries."""
    subprocess.run([str(supple), str(scene), "--quiet", "--output", str(folder)], check=True)
    return rows(folder / "identification.csv")
