"""What the test scripts share: running supple and reading what it wrote."""

import atexit
import csv
import functools
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

import command_driver

SUPPLE = os.path.abspath(sys.argv[1])
ROOT = pathlib.Path(__file__).resolve().parents[2]
DATA = ROOT / "tests" / "data"
BAR = ROOT / "parameters" / "bar" / "large.prm"
STATIC = ROOT / "parameters" / "bar" / "static.prm"
PATIENCE = float(os.environ.get("SUPPLE_PATIENCE", 1))    # more than 1 for a build that is slow on purpose
ENVIRONMENT = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                   OMPI_MCA_pml="ob1", OMPI_MCA_btl="^tcp,uct,openib,ofi", OPENBLAS_NUM_THREADS="1")


@functools.lru_cache(None)
def driver():
    """What runs supple without the start of all its libraries each time; None where the test is called without it."""
    program = os.environ.get("SUPPLE_DRIVER")
    if not program:
        return None
    folder = pathlib.Path(tempfile.mkdtemp(prefix="supple-"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return command_driver.CommandDriver(program, folder, ENVIRONMENT, seconds=250 * PATIENCE)


def run(*arguments, ranks=1, path=None):
    """Runs supple, perhaps with another PATH; gives exit status, standard output and standard error."""
    if ranks == 1 and path is None and driver() and not any("\n" in str(word) for word in arguments):
        _, status, output, error = driver().run(os.getcwd(), list(map(str, arguments)))
        return status, output.decode(errors="replace"), error.decode(errors="replace")
    command = [SUPPLE, *map(str, arguments)]
    if ranks > 1:
        command = ["mpirun", "--oversubscribe", "-np", str(ranks), *command]
    environment = ENVIRONMENT if path is None else dict(ENVIRONMENT, PATH=path)
    done = subprocess.run(command, env=environment, capture_output=True, text=True, errors="replace", timeout=250 * PATIENCE,
                          stdin=subprocess.DEVNULL)
    return done.returncode, done.stdout, done.stderr


def overrides(settings):
    """{"Section/Entry": value} as command line."""
    return [word for entry, value in settings.items() for word in ("--set", f"{entry}={value}")]


class Results:
    """An output folder."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)

    def table(self, name):
        """A CSV file as a list of {column: number}."""
        with open(self.folder / name) as file:
            return [{column: float(text) for column, text in row.items()} for row in csv.DictReader(file)]

    def history(self):
        return self.table("history.csv")

    def probes(self):
        return self.table("probes.csv")

    def summary(self):
        return json.loads((self.folder / "summary.json").read_text())

    def frame_times(self):
        text = (self.folder / "solution.pvd").read_text()
        return [float(part.split('"')[0]) for part in text.split('timestep="')[1:]]


def simulate(scene, settings, ranks=1):
    """Runs a scene that must succeed, in a folder of its own."""
    folder = tempfile.mkdtemp(prefix="supple-")
    status, _, error = run(scene, "--quiet", "--output", folder, *overrides(settings), ranks=ranks)
    check(status == 0, f"exit status {status}: {error}")
    return Results(folder)


def check(condition, message):
    """Ends the test where the condition does not hold."""
    if not condition:
        sys.exit("FAILED: " + message)


def accepted(outcome, words, what):
    """The screen of a run() that must succeed and say these words."""
    status, output, error = outcome
    check(status == 0, f"{what}: exit status {status}, {error}")
    for word in words:
        check(word in output, f"{what}: '{word}' is missing in\n{output}")
    return output


def refused(outcome, words, what):
    """The message of a run() that must end with status 1, say these words and nothing else."""
    status, output, error = outcome
    check(status == 1 and output == "", f"{what}: exit status {status}, {output}{error}")
    for word in words:
        check(word in error, f"{what}: '{word}' is missing in {error}")
    return error


def largest_difference(first, second, columns):
    """Of two tables, each column measured by its largest value."""
    check(len(first) == len(second), f"{len(first)} and {len(second)} rows")
    worst = 0.0
    for column in columns:
        size = max(abs(row[column]) for row in first)
        difference = max(abs(a[column] - b[column]) for a, b in zip(first, second))
        worst = max(worst, difference / size if size > 1e-9 else difference)
    return worst
