"""Tiny scenes with entries changed, run whole: whatever a scene says, a run ends soon, with exit status 0, 1 or 2, one clear
message where it is not 0, and a folder that is whole, or as it was before where the input is wrong.

fuzz_runs.py SUPPLE [--driver SUPPLE_COMMANDS] [--count N | --seconds N] [--seed N] [--only N] [--keep FOLDER]
             [--messages FILE]

The same seed gives the same scenes; --only N repeats one. The driver is quicker, for it starts once. Of what fails the folder
is kept, and the command is printed.
"""

import math
import os
import pathlib
import random
import re
import resource
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner
import command_driver
from entry_values import EntryValues, kinds
from mutations import RAW, REPORT
from run_folder import RunFolder, Wrong, numbers, require

SCENES = runner.DATA / "runs"
MEMORY = pathlib.Path("/dev/shm")
# Of computing: first a run is asked to stop, then it is stopped.
SECONDS, SECONDS_TO_STOP = 10 * runner.PATIENCE, 50 * runner.PATIENCE
LONGEST_MESSAGE = 2500
MOST_STEPS = 30
# Of each shape the entries whose product is a number of cells, and how large it may be.
SIZES = {"box": (["Mesh/Box cubes"], 33), "rectangle": (["Mesh/Rectangle squares"], 100),
         "hollow cylinder": (["Mesh/Cylinder layers", "Mesh/Cylinder rings", "Mesh/Cylinder sectors"], 40)}
# What counts for one shape alone.
OF_SHAPE = {"box": ["Box "], "hollow cylinder": ["Cylinder "], "rectangle": ["Rectangle "], "file": ["File", "Scale"]}
# What the study sets in its scene.
STUDY = {"Time/Steps": "8", "Checkpoint/Every": "0"}
MARK = "SUPPLE_FUZZ_RUN"


def entries_of(scene):
    """{"Section/Entry": value} of a parameter file."""
    found, section = {}, ""
    for line in scene.read_text().splitlines():
        if match := re.match(r"subsection (.*)", line):
            section = match[1]
        elif match := re.match(r"\s*set (.*?)\s*= *([^#]*)", line):
            found[f"{section}/{match[1]}"] = match[2].strip()
    return found


def whole(text):
    return int(text) if re.fullmatch(r"\s*[+]?\d+\s*", text) else None


class Mutant:
    """A scene, what is changed in it, and how it is run."""

    def __init__(self, scenes, known, seed, number):
        self.chance = chance = random.Random(f"runs {seed} {number}")
        self.scene = chance.choice(sorted(scenes))
        self.entries = scenes[self.scene]
        self.is_study = "Study/Scene" in self.entries
        if self.is_study:
            self.entries = {**scenes[self.entries["Study/Scene"].removesuffix(".prm")], **STUDY}
        self.known = known
        used = {}
        for entries in scenes.values():
            for entry, value in entries.items():
                used.setdefault(entry, []).append(value)
        self.values = EntryValues(chance, known, used)
        self.ranks = 2 if chance.random() < 0.05 else 1
        self.resumes = chance.random() < 0.1
        self.changes = {}
        for _ in range(chance.choice([1, 1, 2, 2, 3, 4])):
            entry = self.entry()
            self.changes[entry] = self.values.value(entry, self.changes.get(entry, self.entries.get(entry, "")))
        if self.resumes:
            self.changes["Checkpoint/Every"] = "3"
        self.bound()

    def entry(self):
        """One that the scene sets, or any that may count in it."""
        if self.chance.random() < 0.6:
            return self.chance.choice(sorted(self.entries))
        shape = self.changes.get("Mesh/Shape", self.entries.get("Mesh/Shape", "box"))
        others = tuple(name for other, names in OF_SHAPE.items() if other != shape for name in names)
        elsewhere = {"Study", "Identification"} | (set() if shape in ("rectangle", "file") else {"Plane"})
        section = self.chance.choice(sorted({entry.split("/")[0] for entry in self.known} - elsewhere))
        return self.chance.choice([entry for entry in self.known if entry.startswith(section + "/") and entry != "Output/Folder"
                                   and not entry.removeprefix("Mesh/").startswith(others)])

    def set(self, entry):
        return self.changes.get(entry, self.entries.get(entry, self.known[entry][0]))

    def bound(self):
        """Runs stay short."""
        steps = whole(self.set("Time/Steps"))
        if steps and steps > MOST_STEPS:
            self.changes["Time/Steps"] = str(self.chance.randint(1, MOST_STEPS))
        names, most = SIZES.get(self.set("Mesh/Shape"), ([], 0))
        counts = [whole(part) or 1 for name in names for part in self.set(name).split(",")]
        if math.prod(counts) > most:
            for name in names:
                self.changes[name] = "3" if "Cylinder" in name else "2, 3, 2" if "Box" in name else "4, 3"

    def arguments(self):
        if self.is_study:
            changes = " | ".join(f"{entry}={value}" for entry, value in {**STUDY, **self.changes}.items())
            return ["--set", f"Study/Overrides={changes}"]
        return runner.overrides(self.changes)


class Outcome:
    """How a run of the program ended."""

    def __init__(self, command, status, output, error, is_left):
        self.command, self.status = command, status
        self.output, self.error = (text.decode(errors="replace") for text in (output, error))
        self.left = [process.name for process in pathlib.Path("/proc").iterdir() if process.name.isdigit() and is_left(process)]

    def check(self):
        """The status, the message, and that no process is left."""
        require(not REPORT.search(self.error), "report of a sanitizer")
        require(self.status not in (-signal.SIGKILL, -signal.SIGXCPU), f"no end in {SECONDS + SECONDS_TO_STOP} s of computing")
        require(self.status in (0, 1, 2), f"exit status {self.status}")
        messages = re.findall(r"(?m)^supple: .*", self.error)
        if self.status == 0:
            require(not self.error.strip(), "exit status 0 with a message")
        else:
            require(len(messages) == 1 and len(messages[0]) > 10, f"exit status {self.status} with {len(messages)} messages")
            require(not RAW.search(messages[0]), "the message is not in words")
            require(len(messages[0]) < LONGEST_MESSAGE, f"the message has {len(messages[0])} letters")
        require(not re.search(r"(?<![\w.])-?(nan|inf)(?![\w.])", self.output), "the screen shows a number that is not finite")
        require(not self.left, f"processes are left: {self.left}")


class Program:
    """Runs supple in a folder, with bounds on its computing: by the driver, or by itself where it needs several processes."""

    def __init__(self, folder, temporary, driver):
        self.folder = folder
        self.environment = dict(runner.ENVIRONMENT, TMPDIR=str(temporary))
        self.driver = driver and command_driver.CommandDriver(driver, temporary.parent, self.environment, SECONDS, SECONDS_TO_STOP)

    @staticmethod
    def limit():
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        resource.setrlimit(resource.RLIMIT_CPU, (int(SECONDS), int(SECONDS + SECONDS_TO_STOP)))

    def run(self, arguments, ranks=1):
        command = [runner.SUPPLE, *arguments]
        if ranks == 1 and self.driver:
            leader, *result = self.driver.run(self.folder, arguments)
            return Outcome(command, *result, lambda process: group_of(process) == leader)
        if ranks > 1:
            command = ["mpirun", "--oversubscribe", "-np", str(ranks), *command]
        mark = f"{MARK}={time.monotonic_ns()}"
        environment = dict(self.environment, **dict([mark.split("=")]))
        done = subprocess.run(command, cwd=self.folder, env=environment, capture_output=True, stdin=subprocess.DEVNULL,
                              preexec_fn=self.limit, check=False)
        return Outcome(command, done.returncode, done.stdout, done.stderr, lambda process: mark in environment_of(process))


def group_of(process):
    try:
        return int((process / "stat").read_text().rsplit(")", 1)[1].split()[2])
    except OSError:
        return 0


def environment_of(process):
    try:
        return (process / "environ").read_text(errors="replace").split("\0")
    except OSError:
        return []


def contents(folder):
    return {path.relative_to(folder): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


class Fuzzer:
    """Runs mutants, in a copy of the scenes."""

    def __init__(self, seed, driver):
        # Runs bring their files to the disk, which takes longer than they compute.
        memory = MEMORY if MEMORY.is_dir() and shutil.disk_usage(MEMORY).free > 2**30 else None
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="supple-fuzz-runs-", dir=memory))
        self.out = self.folder / "out"
        self.temporary = self.folder / "temporary"
        self.temporary.mkdir()
        shutil.copytree(SCENES, self.folder / "runs")
        shutil.copytree(runner.DATA / "meshes", self.folder / "meshes")
        self.program = Program(self.folder / "runs", self.temporary, driver)
        self.seed = seed
        self.known = kinds()
        self.scenes = {path.stem: entries_of(path) for path in SCENES.glob("*.prm")}
        self.statuses = {}
        self.slow = 0
        self.messages = []

    def run(self, mutant, name):
        outcome = self.program.run([f"{mutant.scene}.prm", "--output", str(self.folder / name), *mutant.arguments()], mutant.ranks)
        self.statuses[outcome.status] = self.statuses.get(outcome.status, 0) + 1
        self.messages.append(outcome.error)
        return outcome

    def earlier(self, scene):
        """The results of the scene as it is, with a file of somebody else."""
        folder = self.folder / "earlier" / scene
        if not folder.exists():
            outcome = self.program.run([f"{scene}.prm", "--output", str(folder)])
            runner.check(outcome.status == 0, f"{scene}: {outcome.error}")
            (folder / "notes.txt").write_text("mine\n")
        return folder

    def try_one(self, number):
        """What is wrong with a mutant, and the command that shows it; nothing where all is right."""
        mutant = Mutant(self.scenes, self.known, self.seed, number)
        shutil.rmtree(self.out, ignore_errors=True)
        shutil.copytree(self.earlier(mutant.scene), self.out)
        outcome = self.run(mutant, "out")
        try:
            outcome.check()
            self.check_surroundings()
            self.check_folder(mutant, outcome)
            if mutant.resumes and outcome.status == 0 and not mutant.is_study:
                self.check_resumed(mutant)
        except (Wrong, OSError, ValueError, KeyError, SyntaxError, TypeError) as fault:
            command = shlex.join(outcome.command).replace(str(self.folder), "/tmp")
            return f"{type(fault).__name__}: {fault}\n  cd {SCENES} && {command}\n  {outcome.error[:1000]}"
        return None

    def check_surroundings(self):
        left = [path.name for path in self.temporary.iterdir() if not path.name.startswith(("ompi", "pmix"))]
        require(not left, f"temporary files are left: {left}")
        require(set(os.listdir(self.folder / "runs")) == set(os.listdir(SCENES)), "files are left beside the scene")

    def check_folder(self, mutant, outcome):
        before = contents(self.earlier(mutant.scene))
        after = contents(self.out)
        require(after.get(pathlib.Path("notes.txt")) == b"mine\n", "a file of somebody else is gone")
        if outcome.status == 1:
            changed = [str(path) for path in before.keys() | after.keys() if before.get(path) != after.get(path)]
            require(not changed, f"exit status 1, but the results of the run before are changed: {changed[:5]}")
        elif after == before:
            require(outcome.status == 2 and not mutant.is_study, "nothing was written")
        elif mutant.is_study:
            self.check_study(outcome.status)
        else:
            (self.out / "notes.txt").unlink()
            folder = RunFolder(self.out, outcome.status)
            self.slow += folder.summary["status"] == "interrupted"
            require(folder.summary["status"] != "interrupted" or folder.summary["steps"] > 0, f"no step in {SECONDS} s of computing")
            folder.check()

    def check_study(self, status):
        table = self.out / "study.csv"
        require(table.exists() and (self.out / "study.md").exists(), "the study has no table")
        header, *rows = [line.split(",") for line in table.read_text().splitlines()]
        verdicts = [row[header.index("verdict")] for row in rows]
        require((status == 0) == ("right" in verdicts or "warned" in verdicts), f"exit status {status} of runs that are {verdicts}")
        for folder in (self.out / "runs").iterdir():
            if (folder / "history.csv").exists():
                for line in (folder / "history.csv").read_text().splitlines()[1:]:
                    told = filter(None, line.split(",")) # the error in space is told of rows with a frame
                    numbers(map(float, told), f"history.csv of {folder.name}")

    def check_resumed(self, mutant):
        """Half of the run, and the rest from its checkpoint, leave what the whole run leaves."""
        steps = int(mutant.set("Time/Steps"))
        dynamic = mutant.set("Time/Problem") == "dynamic"
        shutil.rmtree(self.folder / "parts", ignore_errors=True)
        for end in ([max(1, steps // 2), steps] if dynamic else [steps, steps]):
            mutant.changes.update({"Checkpoint/Resume": "auto", "Time/Steps": str(end)})
            outcome = self.run(mutant, "parts")
            outcome.check()
            require(outcome.status == 0, f"in parts: exit status {outcome.status}, {outcome.error}")
        parts = RunFolder(self.folder / "parts", 0)
        parts.check()
        whole_run = RunFolder(self.out, 0)
        whole_run.check()
        follows = mutant.set("Time/Variable steps") == "true" or mutant.set("Time/Method") == "ida"
        if whole_run.history and parts.history and not follows:    # else the last step before an end is another one
            compare(whole_run.history, parts.history)


def compare(first, second):
    """Histories, where they are determined: steps, times and the sums of energies."""
    require(len(first) == len(second), f"in parts: {len(second)} instead of {len(first)} rows")
    for column in ("time", "kinetic", "elastic", "total", "work"):
        size = max(max(abs(row[column]), abs(row["kinetic"]) + abs(row["elastic"])) for row in first)
        difference = max(abs(a[column] - b[column]) for a, b in zip(first, second))
        require(difference <= 1e-6 * size, f"in parts: {column} differs by {difference} of {size}")


def main():
    parser = command_driver.parser()
    parser.add_argument("--seconds", type=float)
    options = parser.parse_args()

    fuzzer = Fuzzer(options.seed, options.driver)
    kept = options.keep or pathlib.Path(tempfile.mkdtemp(prefix="supple-fuzz-runs-failed-"))
    started, failed, number = time.monotonic(), 0, options.only or 0
    while True:
        wrong = fuzzer.try_one(number)
        if wrong:
            failed += 1
            shutil.copytree(fuzzer.out, kept / f"{options.seed}-{number}", dirs_exist_ok=True)
            print(f"seed {options.seed}, number {number}: {wrong}", flush=True)
        number += 1
        if options.seconds and number % 100 == 0:
            print(f"{number} scenes in {time.monotonic() - started:.0f} s", flush=True)
        enough = time.monotonic() - started > options.seconds if options.seconds else number >= options.count
        if enough or options.only is not None:
            break
    if options.messages:
        options.messages.write_text("".join(fuzzer.messages))
    statuses = ", ".join(f"{count} with status {status}" for status, count in sorted(fuzzer.statuses.items()))
    print(f"{time.monotonic() - started:.0f} s: {statuses}; {fuzzer.slow} stopped for their time; {failed} failed")
    shutil.rmtree(fuzzer.folder)
    sys.exit(failed > 0)


main()
