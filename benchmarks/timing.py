"""Timed runs of a scene, for the benchmarks in the folders beside this file: without output, on one thread.

    arguments = timing.parser(__doc__).parse_args()
    summary = timing.median_run("bar/small", {"Time/Steps": 100}, arguments)
    seconds = timing.seconds_a_step(summary)
"""

import argparse
import csv
import json
import os
import pathlib
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
SILENT = {"Output/Frames": "none", "Output/History": "false",
          "Probes/Points": "", "Probes/Boundaries": "", "Probes/Regions": ""}
# One thread for BLAS, and no network for MPI, which starts quicker without.
ENVIRONMENT = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "OMPI_MCA_pml": "ob1"}


def parser(documentation):
    """The options that all benchmarks have."""
    options = argparse.ArgumentParser(description=documentation.splitlines()[0])
    options.add_argument("--repeat", type=int, default=3, help="runs of which the median is taken")
    options.add_argument("--program", type=pathlib.Path, default=ROOT / "build" / "supple", help="another build")
    return options


def run(scene, settings, program, launcher=(), table=None):
    """summary.json of one run of parameters/SCENE.prm, with the peak memory of the program in MB as "peak_memory", and
    the rows of one of its CSV files as "table"."""
    with tempfile.TemporaryDirectory() as folder:
        command = [*launcher, program, ROOT / "parameters" / f"{scene}.prm", "--quiet", "--output", folder]
        for entry, value in {**SILENT, **settings}.items():
            command += ["--set", f"{entry}={value}"]
        try:
            process = subprocess.Popen(command, env={**os.environ, **ENVIRONMENT})
        except OSError as error:
            raise SystemExit(f"{command[0]} can't be run: {error.strerror}. Build it by scripts/run.sh --version, "
                             "or name another by --program.") from None
        _, status, usage = os.wait4(process.pid, 0)
        if status != 0:
            raise SystemExit(f"failed: {' '.join(map(str, command))}")
        summary = json.loads((pathlib.Path(folder) / "summary.json").read_text())
        if table:
            with open(pathlib.Path(folder) / table) as file:
                summary["table"] = list(csv.DictReader(file))
        return {**summary, "peak_memory": usage.ru_maxrss / 1024}


def seconds_a_step(summary):
    """Without the setup: mesh, body, first matrix pattern."""
    return summary["seconds"]["run"] / summary["steps"]


def median_run(scene, settings, arguments, launcher=()):
    """That of several runs with the median time a step."""
    runs = [run(scene, settings, arguments.program, launcher) for _ in range(arguments.repeat)]
    return sorted(runs, key=seconds_a_step)[len(runs) // 2]
