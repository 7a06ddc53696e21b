"""A run of a scene and its numbers: for errors.py and refinement.py, not called."""

import csv
import json
import subprocess


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
        with open(folder / "probes.csv") as file:
            probes = {name: float(text) for name, text in list(csv.DictReader(file))[-1].items()}
    return summary, probes
