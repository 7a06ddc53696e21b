"""Damaged parameter files, meshes and measurements: supple --check ends with exit status 0 or 1, with a message, soon.

fuzz.py SUPPLE [--driver SUPPLE_COMMANDS] [--part parameters|meshes|measurements] [--count N | --minutes N] [--seed N]
        [--only N] [--keep FOLDER] [--messages FILE]

The same seed gives the same mutants; --only N repeats one. The driver is quicker, for it starts once. What fails is kept
in the folder, or else in a temporary one.
"""

import os
import pathlib
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner
import command_driver
from mutations import RAW, REPORT, ParameterText, Text, entries

# Of computing: on a busy machine the clock says little. A check takes .3 s, with sanitizers some seconds.
SECONDS = 30
SECONDS_SANITIZED = 300
MEMORY = 8 * 2**30
LONGEST_MESSAGE = 6000
PARTS = ("parameters", "meshes", "measurements")

# These studies look through many or large scenes.
SLOW = {"cantilever-bending", "elastica", "lame-cylinder", "lame-sphere", "bar-large", "bar-small", "vein", "fit-3d", "soft-bar",
        "order", "stiff-bar", "needle"}

class Binary(Text):
    """Changes of the numbers in a binary file."""

    def overwrite(self, data):
        size = self.chance.choice([4, 8])
        if len(data) < size:
            return data
        place = self.chance.randrange(len(data) - size + 1)
        number = self.chance.choice([0, 1, 2**31 - 1, 2**31, 2**32 - 1, 2**63, 2**64 - 1, 0x7ff0000000000000, 0x7ff8000000000000, 0x7f7fffff,
                                     self.chance.randrange(2**20)])
        return data[:place] + (number % 2**(8 * size)).to_bytes(size, self.chance.choice(["little", "big"])) + data[place + size:]


class Corpus:
    """Copies of the scenes with their meshes, in which mutants are put beside what they name."""

    def __init__(self, folder):
        self.folder = folder
        shutil.copytree(runner.ROOT / "parameters", folder / "parameters")
        self.scenes = [path for path in sorted((folder / "parameters").rglob("*.prm")) if path.stem not in SLOW]
        self.meshes = sorted((runner.DATA / "meshes").iterdir())
        self.known = entries()
        self.values = {}
        for path in self.scenes:
            for match in re.finditer(r"set ([^=\n]*?)\s*= *([^#\n]*)", path.read_text()):
                self.values.setdefault(match[1], []).append(match[2])

    def mutant(self, part, seed, number):
        """Writes a mutant; gives the scene to check and the file that is damaged."""
        chance = random.Random(f"{part} {seed} {number}")
        if part == "parameters":
            source = chance.choice(self.scenes)
            target = scene = source.with_name("mutant.prm")
            data = ParameterText(chance, self.known, self.values).mutate_all(source.read_bytes())
        elif part == "meshes":
            source = chance.choice(self.meshes)
            target = self.folder / ("mutant" + source.suffix)
            text = Binary(chance)
            overwrites = [text.overwrite] * (16 if "binary" in source.name else 1)
            data = text.mutate(source.read_bytes(), text.anywhere() + overwrites)
            scene = self.folder / "scene.prm"
            scene.write_text(f"subsection Mesh\n set Shape = file\n set File = {target.name}\nend\n"
                             "subsection Constraints\n set Clamped region = x < 0.1\nend\n")
        else:
            skin = self.folder / "parameters" / "skin"
            target, scene = skin / "mutant.csv", skin / "scene.prm"
            text = Text(chance)
            data = text.mutate((skin / "fingertip.csv").read_bytes(), text.anywhere())
            scene.write_text((skin / "fit-plane-strain.prm").read_text().replace("fingertip.csv", "mutant.csv"))
        target.write_bytes(data)
        return scene, target


class Checker:
    """Runs supple --check: the program itself, or its driver, which starts once."""

    def __init__(self, driver, folder, messages):
        self.sanitized = b"__asan_init" in pathlib.Path(runner.SUPPLE).read_bytes()
        self.seconds = SECONDS_SANITIZED if self.sanitized else SECONDS
        self.driver = driver
        self.folder = folder
        self.server = None
        self.messages = open(messages or os.devnull, "w")
        self.refused = 0

    def limit_memory(self):
        if not self.sanitized:    # these take terabytes of addresses for themselves
            resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))

    def limit(self):
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        resource.setrlimit(resource.RLIMIT_CPU, (self.seconds, self.seconds))
        self.limit_memory()

    def by_program(self, scene):
        """Exit status, or the negative signal, and standard error."""
        done = subprocess.run([runner.SUPPLE, "--check", scene.name], cwd=scene.parent, env=runner.ENVIRONMENT, capture_output=True,
                              stdin=subprocess.DEVNULL, preexec_fn=self.limit)
        return done.returncode, done.stderr

    def by_driver(self, scene):
        if not self.server:
            self.server = command_driver.CommandDriver(self.driver, self.folder, runner.ENVIRONMENT, self.seconds, prepare=self.limit_memory)
        _, status, _, error = self.server.run(scene.parent, ["--check", scene.name])
        return status, error

    def complaint(self, scene):
        """What is wrong with what supple says of this scene, or nothing."""
        status, error = self.by_driver(scene) if self.driver else self.by_program(scene)
        error = error.decode(errors="replace")
        self.messages.write(error)
        self.refused += status == 1
        if REPORT.search(error):
            return "report of a sanitizer\n" + error[:4000]
        if status in (-signal.SIGKILL, -signal.SIGXCPU):
            return f"no end in {self.seconds} s of computing"
        if status not in (0, 1):
            return f"exit status {status}\n{error[:2000]}"
        if status == 1 and not re.match(r"supple: \S", error):
            return "exit status 1 without a message\n" + error[:2000]
        if status == 1 and RAW.search(error):
            return "the message is not in words\n" + error[:2000]
        if status == 1 and len(error) > LONGEST_MESSAGE:
            return f"the message has {len(error)} letters\n{error[:300]}"
        return None


def main():
    parser = command_driver.parser()
    parser.add_argument("--part", choices=PARTS)
    parser.add_argument("--minutes", type=float)
    options = parser.parse_args()

    corpus = Corpus(pathlib.Path(tempfile.mkdtemp(prefix="supple-fuzz-")))
    checker = Checker(options.driver, corpus.folder, options.messages)
    kept = options.keep or pathlib.Path(tempfile.mkdtemp(prefix="supple-fuzz-failed-"))
    kept.mkdir(parents=True, exist_ok=True)
    parts = [options.part] if options.part else list(PARTS)
    started, tried, failed = time.monotonic(), 0, 0
    number = options.only or 0
    while True:
        for part in parts:
            scene, target = corpus.mutant(part, options.seed, number)
            wrong = checker.complaint(scene)
            tried += 1
            if wrong:
                failed += 1
                copy = kept / f"{part}-{options.seed}-{number}{target.suffix}"
                shutil.copy(target, copy)
                copy.with_name(copy.name + ".txt").write_text(f"{target.parent.name}\n{wrong}\n")
                print(f"{part}, seed {options.seed}, number {number} ({target.parent.name}, kept as {copy}): {wrong}", flush=True)
        number += 1
        if options.minutes and number % 1000 == 0:
            print(f"{tried} mutants in {time.monotonic() - started:.0f} s", flush=True)
        enough = time.monotonic() - started > 60 * options.minutes if options.minutes else number >= options.count
        if enough or options.only is not None:
            break
    print(f"{tried} mutants in {time.monotonic() - started:.0f} s: {checker.refused} refused, {failed} failed")
    shutil.rmtree(corpus.folder)
    sys.exit(failed > 0)


main()
